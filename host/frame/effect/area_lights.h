// Area lights made ready for the kernels: their polygons, their pictures, and the tables of
// linearly transformed cosines.
#pragma once
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "host/core/shared_types.h"
#include "host/filter/mip_chain.h"
#include "host/fit/ltc_table.h"
#include "host/frame/shade_arguments.h"
#include "host/ocl/compute.h"
#include "host/ocl/kernel_config.h"
#include "host/scene/scene.h"

namespace glintmark {

/// Lights relative to `eye`, in double precision before they are rounded, so that precision does
/// not suffer far from the world's origin. Textures are numbered in the order of the lights.
std::vector<AreaLightParams> prepareAreaLights(std::span<const AreaLight> lights,
                                               const glm::dvec3& eye);

/// The picture of a light, ready to be read at any width: level l has half the texels of level l -
/// 1 each way, and is blurred further by a Gaussian of kLightBlur of its texels; both stop at the
/// border, where what lies outside has no weight. Row 0 is at the bottom. Channels: rgb and 1.
MipChain prefilterLightTexture(const Image& texture);
inline constexpr double kLightBlur = 0.8;

/// What the kernels read of a scene's area lights. Makes nothing for a scene that has none.
class AreaLightBuffers {
 public:
  /// `own_table`, if not null, stands for the shipped table of its NDF.
  AreaLightBuffers(Device& device, const Scene& scene, const glm::dvec3& eye,
                   std::shared_ptr<const LtcTable> own_table = nullptr);

  /// Adds the arguments of `config`'s kernel: the lights, the NDF's table and, with LIGHT_TEXTURE,
  /// the layouts and texels of the pictures; none where `config` has no area lights, empty ones
  /// where the scene has none. Loads the shipped table of the NDF when it is first asked for;
  /// throws Error if it is missing or damaged, or if a value does not fit into half precision where
  /// LTC_HALF asks for it.
  void addArguments(const KernelConfig& config, ShadeArguments& arguments);
  /// Sets the counts that the kernels read.
  void describe(const KernelConfig& config, FrameParams& params);
  std::size_t bytes() const;

 private:
  struct Table {
    Buffer values;
    uint size = 0;
  };
  const Table& table(const KernelConfig& config);

  Device& device_;
  uint light_count_ = 0;
  Buffer lights_, layouts_, texels_;
  std::shared_ptr<const LtcTable> own_table_;
  // By "is GGX", "is in half precision", "has that of normals behind it" and "has that of
  // anisotropic lobes behind it".
  std::map<std::tuple<bool, bool, bool, bool>, Table> tables_;
};

}  // namespace glintmark
