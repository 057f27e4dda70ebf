// Shades one view of a scene: rasterizes, uploads, runs the specialised kernels, reads back.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "host/core/image.h"
#include "host/core/planes.h"
#include "host/frame/effect/normal_maps.h"
#include "host/frame/shading_options.h"
#include "host/ocl/device.h"
#include "host/raster/rasterizer.h"
#include "host/scene/scene.h"

namespace glintmark {

/// Times of one frame [ns]. Shading is the sum over the launches of all materials.
struct FrameTimes {
  double raster_ns = 0;
  double upload_ns = 0;
  double shading_event_ns = 0;            // by the kernels' events
  double shading_wall_ns = 0;             // enqueue to finish on the host's clock
  std::vector<double> launch_event_ns{};  // by launch: a band's pixel lists, then the next band's
  double readback_ns = 0;
};

/// Times of one program [ns].
struct ProgramBuild {
  KernelConfig config;
  double build_ns = 0;          // clBuildProgram
  double first_enqueue_ns = 0;  // first launches, in which PoCL compiles
  bool from_disk_cache = false;
};

/// Cells visited, over the covered pixels of glint materials.
struct CellCounts {
  std::uint32_t min = 0, max = 0;
  double mean = 0;
  std::size_t glint_px = 0;    // pixels that ran the glint loop
  std::size_t guard_hits = 0;  // pixels whose walk a limit cut short
};

class FrameRenderer {
 public:
  /// `textures` may be shared with other renderers of the device.
  FrameRenderer(Device& device, const Scene& scene, const View& view, const ShadingOptions& options,
                int thread_count = 0, std::shared_ptr<NormalTextures> textures = nullptr);
  ~FrameRenderer();

  /// Rasterizes and uploads; must come before shade(). Returns raster and upload times.
  FrameTimes prepare();
  /// Builds what is not built (once), launches every material's kernel and waits.
  FrameTimes shade();
  /// Adds samples of the ground truth; needs ShadingOptions::truth. prepare() begins anew.
  FrameTimes addTruthSamples(std::uint32_t sample_begin, std::uint32_t sample_count);
  /// Radiance as an RGBA image (alpha 1 where covered, background 0), linear, scene units.
  /// Of the ground truth it is the sum over the samples.
  Image readRadiance(FrameTimes* times = nullptr);
  /// Sums of the squares of the ground truth's samples, laid out like readRadiance().
  Image readSquares();
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
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace glintmark
