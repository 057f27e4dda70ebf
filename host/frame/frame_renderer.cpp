#include "host/frame/frame_renderer.h"

#include <algorithm>

#include "host/core/error.h"
#include "host/core/trace.h"

namespace glintmark {

FrameRenderer::FrameRenderer(Device& device, const Scene& scene, const View& view,
                             const ShadingOptions& options, int thread_count,
                             std::shared_ptr<NormalTextures> textures)
    : pass_(kShadePass, device, scene, view, options, thread_count, std::move(textures)) {}

FrameTimes FrameRenderer::prepare() {
  return pass_.prepare();
}

FrameTimes FrameRenderer::shade() {
  const TraceScope scope("frame", "shade");
  return pass_.launch();
}

Image FrameRenderer::readRadiance(FrameTimes* times) {
  const TraceScope scope("frame", "read back");
  double readback_ns = 0;
  Image image = readPlanes(pass_, readback_ns);
  if (times) times->readback_ns = readback_ns;
  return image;
}

Image FrameRenderer::readCells() {
  return readCellImage(pass_);
}

CellCounts FrameRenderer::cellCounts() {
  return countCells(pass_);
}

const PixelPlanes& FrameRenderer::planes() const {
  if (pass_.bands().size() != 1)
    throw Error(
        "the planes of this frame do not lie in one piece: call prepare() first, and choose a size "
        "whose planes fit into the device's largest buffer");
  return pass_.bands().front().planes;
}

const Camera& FrameRenderer::camera() const {
  return pass_.camera();
}
const std::vector<KernelConfig>& FrameRenderer::configs() const {
  return pass_.configs();
}
double FrameRenderer::buildNs() const {
  return pass_.buildNs();
}

double FrameRenderer::firstEnqueueNs() const {
  double total = 0;
  for (const FramePass::Band& band : pass_.bands())
    for (const FramePass::Launch& launch : band.launches) total += launch.kernel.firstEnqueueNs();
  return total;
}

std::vector<ProgramBuild> FrameRenderer::builds() const {
  std::vector<ProgramBuild> builds;
  for (const FramePass::Band& band : pass_.bands())
    for (const FramePass::Launch& launch : band.launches) {
      // Programs that were in memory took no time.
      if (std::ranges::find(builds, launch.config, &ProgramBuild::config) != builds.end()) continue;
      builds.push_back({launch.config, launch.program.buildNs(), launch.kernel.firstEnqueueNs(),
                        launch.program.fromDiskCache()});
    }
  return builds;
}

std::size_t FrameRenderer::bufferBytes() const {
  std::size_t bytes = 0;
  for (const FramePass::Band& band : pass_.bands())
    for (const Buffer* buffer : {&band.plane_buffer, &band.results, &band.counts})
      if (!buffer->empty()) bytes += buffer->bytes();
  return bytes;
}

}  // namespace glintmark
