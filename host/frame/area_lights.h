// Area lights made ready for the kernels: their polygons, their pictures, and the tables of
// linearly transformed cosines.
#pragma once
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

#include "host/core/shared_types.h"
#include "host/filter/mip_chain.h"
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
  AreaLightBuffers(Device& device, const Scene& scene, const glm::dvec3& eye);

  /// Arguments of `config`'s kernel: the lights, the NDF's table and, with LIGHT_TEXTURE, the
  /// layouts and texels of the pictures; none where `config` has no area lights, empty ones where
  /// the scene has none. Loads the shipped
  /// table of the NDF when it is first asked for; throws Error if it is missing or damaged.
  std::vector<KernelArg> arguments(const KernelConfig& config);
  /// Sets the counts that the kernels read.
  void describe(const KernelConfig& config, FrameParams& params);
  std::size_t bytes() const;

 private:
  struct Table {
    Buffer values;
    uint size = 0;
  };
  const Table& table(bool ggx);

  Device& device_;
  uint light_count_ = 0;
  Buffer lights_, layouts_, texels_;
  std::map<bool, Table> tables_;  // by "is GGX"
};

}  // namespace glintmark
