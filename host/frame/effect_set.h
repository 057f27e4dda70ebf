// Effects by name, and scenes stripped of those that are not wanted: what `bench effects` and the
// tests of specialisation turn on and off.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "host/frame/shading_options.h"
#include "host/ocl/kernel_config.h"
#include "host/scene/scene.h"

namespace glintmark {

/// What a scene can call for beyond smooth lobes under cone lights: the rows EFFECT and MODULE of
/// host/ocl/switches.inc.
enum class Effect : unsigned {
#define MODULE(enumerator, ...) enumerator,
#include "host/ocl/switches.inc"
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
  static EffectSet all();

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
/// What a program holds.
EffectSet effectsOf(const KernelConfig& config);
/// The scene without the effects that are not in `kept`; smooth lobes and Lambert's stand in.
Scene withEffects(Scene scene, EffectSet kept);
/// Options under which such a scene shows `kept` and no more.
ShadingOptions withEffects(ShadingOptions options, EffectSet kept);

}  // namespace glintmark
