// Normal maps on the device, in the form that the chosen method reads.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "host/mixture/normal_mixture.h"
#include "host/ocl/compute.h"
#include "host/ocl/kernel_config.h"
#include "host/scene/scene.h"

namespace glintmark {

/// A texture of kernels/normals/texture.clh on the device.
struct NormalTexture {
  Buffer layout;  // one MipTexture
  Buffer texels;
  std::size_t texel_bytes = 0;
};

/// What making a texture takes [bytes]: the buffer that stays, and the most that is held on the
/// host meanwhile, on processors that buffer included; the map itself comes to it.
struct TextureNeed {
  std::uint64_t buffer_bytes = 0, host_bytes = 0;
};
TextureNeed textureNeed(int width_px, int height_px, const KernelConfig& config);

/// What eight float4 of method anisotropic hold.
inline constexpr int kMostAnisotropicLobes = 5;
/// Why a table goes without it in a scene of more lobes.
std::string withoutAnisotropicNote(const std::string& scene);

/// Does a method read a mixture of normals, of as many lobes as the material has?
bool readsMixture(NormalMethod method);

/// Does `method` take as many lobes as the materials of `scene` have?
bool takesLobesOf(NormalMethod method, const Scene& scene);

/// How the mixtures of those methods are fitted; `iterations` 0: the fit's default.
MixtureOptions mixtureOptions(int lobes, MixtureOrder order, int iterations);

/// Makes textures when they are first asked for and keeps them: nothing is fitted or uploaded that
/// no kernel reads. Several renderers of one device may share one.
class NormalTextures {
 public:
  explicit NormalTextures(Device& device) : device_(device) {}

  /// What `config`'s kernel reads of `map`. `order` says how mixtures are aligned, `iterations` how
  /// many EM steps a texel takes in the fit (0: its default).
  const NormalTexture& get(const std::shared_ptr<const NormalMap>& map, const KernelConfig& config,
                           MixtureOrder order = MixtureOrder::kColours, int iterations = 0);
  /// The finest level alone: what the ground truth and method fixed read.
  const NormalTexture& finest(const std::shared_ptr<const NormalMap>& map);
  /// Bytes of all textures held.
  std::size_t bytes() const;

 private:
  using Key = std::tuple<std::shared_ptr<const NormalMap>, NormalMethod, int, bool, MixtureOrder,
                         int, bool>;
  Device& device_;
  std::map<Key, NormalTexture> textures_;
};

}  // namespace glintmark
