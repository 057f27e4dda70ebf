// Effects by name, and scenes stripped of those that are not wanted: what `bench effects` and the
// tests of specialisation turn on and off.
#pragma once
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "host/frame/frame_renderer.h"
#include "host/scene/scene.h"

namespace glintmark {

/// What a scene can call for beyond smooth lobes under cone lights, in the order of their names.
enum class Effect : unsigned {
  kGlints,        // 2-D microdetails [ZK16]
  kGrooves,       // 1-D microdetails, [ZK16] Eq. 6
  kColour,        // a colour for each microdetail; needs glints
  kNormals,       // a normal map, as mixtures of Gaussians [TAN05]; under area lights its mean
  kLtc,           // area lights [HDHN16]
  kMultiscale,    // area lights read how the map varies [TAO21]; needs normals and ltc
  kMultiscatter,  // rough diffuse facets [PAT18]
  kCompensation,  // what metals lose to further bounces
  kEnvironment,   // cones cut from an environment map
  kCount
};
inline constexpr std::size_t kEffectCount = static_cast<std::size_t>(Effect::kCount);

class EffectSet {
 public:
  constexpr EffectSet() = default;
  constexpr EffectSet(std::initializer_list<Effect> effects) {
    for (const Effect effect : effects) bits_ |= bit(effect);
  }
  constexpr bool has(Effect effect) const { return (bits_ & bit(effect)) != 0; }
  constexpr bool holds(EffectSet other) const { return (bits_ & other.bits_) == other.bits_; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr EffectSet operator|(EffectSet other) const { return EffectSet(bits_ | other.bits_); }
  constexpr EffectSet without(EffectSet other) const { return EffectSet(bits_ & ~other.bits_); }
  constexpr bool operator==(const EffectSet&) const = default;
  std::vector<Effect> list() const;

 private:
  explicit constexpr EffectSet(unsigned bits) : bits_(bits) {}
  static constexpr unsigned bit(Effect effect) { return 1u << static_cast<unsigned>(effect); }
  unsigned bits_ = 0;
};

std::string_view effectName(Effect effect);
/// "glints+ltc"; "none" for an empty set.
std::string effectSetName(EffectSet set);
/// Effects without which this one does nothing.
EffectSet effectNeeds(Effect effect);

/// What the scene's materials and lights call for.
EffectSet effectsOf(const Scene& scene);
/// The scene without the effects that are not in `kept`; smooth lobes and Lambert's stand in.
Scene withEffects(Scene scene, EffectSet kept);
/// Options under which such a scene shows `kept` and no more.
ShadingOptions withEffects(ShadingOptions options, EffectSet kept);

}  // namespace glintmark
