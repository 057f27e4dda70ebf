// A rasterized view on the device, and the launches over its pixel lists: what frames and their
// ground truth share.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/planes.h"
#include "host/frame/frame_resources.h"
#include "host/frame/frame_times.h"
#include "host/frame/shade_arguments.h"
#include "host/frame/shading_options.h"
#include "host/ocl/compute.h"
#include "host/raster/rasterizer.h"
#include "host/scene/scene.h"

namespace glintmark {

/// The kernel that a pass runs.
struct PassKernel {
  const char *file, *name;
  const char* result;  // its name for the planes that it writes
  std::size_t result_planes;
  bool truth;
  std::span<const char* const> numbers = {};  // its last arguments, which setNumber() gives
};
inline constexpr PassKernel kShadePass = {"shade.cl", "shade", "radiance", 3, false};
/// Sums of radiance.
inline constexpr const char* kTruthNumbers[] = {"replicate", "sample_begin", "sample_count"};
inline constexpr PassKernel kTruthPass = {"truth.cl", "truth", "sums", 3, true, kTruthNumbers};

/// In results that no launch has written: a NaN that no arithmetic makes.
inline constexpr std::uint32_t kUnwrittenWord = 0x7fc5a5a5u;

class FramePass {
 public:
  /// One material's share of a band.
  struct Launch {
    PixelList list;
    KernelConfig config;
    Program program;
    Kernel kernel;
    ShadeArguments arguments;
  };

  /// Rows of the frame that fit into the device's largest buffer; as a rule there is one band.
  struct Band {
    Camera camera;
    int top_px = 0;
    PixelPlanes planes;
    std::vector<Launch> launches;
    Buffer plane_buffer, results, counts;
    Buffer owners;  // material of every entry, for programs that serve all materials
  };

  /// `device` and `scene` must outlive this; `textures` may be shared with other passes of the
  /// device, or null.
  FramePass(const PassKernel& kernel, Device& device, const Scene& scene, const View& view,
            const ShadingOptions& options, int thread_count,
            std::shared_ptr<NormalTextures> textures);
  FramePass(const FramePass&) = delete;
  FramePass& operator=(const FramePass&) = delete;

  /// Rasterizes and uploads, clears results that are summed up, builds what is not built. Returns
  /// raster and upload times. Throws Error if the view covers no pixel and the options do not allow
  /// that: there would be nothing to measure.
  FrameTimes prepare();
  /// Gives one of PassKernel::numbers, 0 after prepare(), to the launches to come. Throws Error if
  /// the kernel has none of that name.
  void setNumber(std::string_view name, std::uint32_t value);
  /// Clears results that are summed up, as prepare() does.
  void clearResults();
  /// Launches every material's kernel and waits.
  FrameTimes launch();

  const std::vector<Band>& bands() const { return bands_; }
  const Camera& camera() const { return camera_; }
  const ShadingOptions& options() const { return options_; }
  /// Configurations in use, each once.
  const std::vector<KernelConfig>& configs() const { return configs_; }
  double buildNs() const { return build_ns_; }
  const char* kernelName() const { return kernel_.name; }
  const std::string& deviceName() const { return device_.info().name; }

 private:
  void makeBands();
  void makeLights();
  void makeBuffers(Band& band, FrameTimes& times);
  void rasterize(Band& band);
  void makeLaunches(Band& band);
  Launch makeLaunch(const Band& band, const PixelList& list);
  KernelConfig configOf(const Material& material) const;
  Buffer materialBuffer(const Material& material, const KernelConfig& config);
  Buffer frameParams(const Band& band, const PixelList& list, const KernelConfig& config);
  ShadeArguments argumentsOf(const Band& band, const PixelList& list, const KernelConfig& config);
  PlaneMask planes() const;

  void requirePixels() const;

  PassKernel kernel_;
  std::string view_name_;
  Device& device_;
  const Scene& scene_;
  ShadingOptions options_;
  ProgramCache cache_;
  std::shared_ptr<NormalTextures> textures_;
  Rasterizer rasterizer_;
  Camera camera_;
  int lanes_;
  FrameResources resources_;

  std::vector<Band> bands_;
  std::vector<KernelConfig> configs_;
  Buffer lights_;
  uint light_count_ = 0;
  double build_ns_ = 0;
};

}  // namespace glintmark
