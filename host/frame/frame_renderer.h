// Shades one view of a scene: rasterizes, uploads, runs the specialised kernels, reads back.
#pragma once
#include <memory>
#include <vector>

#include "host/core/image.h"
#include "host/frame/frame_pass.h"
#include "host/frame/frame_readback.h"

namespace glintmark {

class FrameRenderer {
 public:
  /// `textures` may be shared with other renderers of the device.
  FrameRenderer(Device& device, const Scene& scene, const View& view, const ShadingOptions& options,
                int thread_count = 0, std::shared_ptr<NormalTextures> textures = nullptr);

  /// Rasterizes and uploads; must come before shade(). Returns raster and upload times.
  FrameTimes prepare();
  /// Builds what is not built (once), launches every material's kernel and waits.
  FrameTimes shade();
  /// Radiance as an RGBA image (alpha 1 where covered, background 0), linear, scene units.
  Image readRadiance(FrameTimes* times = nullptr);
  /// Cells per pixel as a one-channel image, -1 where no glint material covers; needs count_cells.
  Image readCells();
  CellCounts cellCounts();

  /// The rasterized planes. Throws Error before prepare(), and for frames so large that they were
  /// cut into bands of rows to fit the device's largest buffer.
  const PixelPlanes& planes() const;
  const Camera& camera() const;
  /// Configurations in use, each once.
  const std::vector<KernelConfig>& configs() const;
  /// Time spent in clBuildProgram and in each kernel's first enqueue, so far [ns].
  double buildNs() const;
  double firstEnqueueNs() const;
  /// What it took to build each program in use, each once.
  std::vector<ProgramBuild> builds() const;
  /// Bytes of device buffers held: planes, radiance, counts.
  std::size_t bufferBytes() const;

 private:
  FramePass pass_;
};

}  // namespace glintmark
