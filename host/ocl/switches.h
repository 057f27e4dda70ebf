// The table of compile-time switches, host/ocl/switches.inc, for code that runs over it.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/unknown_name.h"
#include "host/ocl/kernel_config.h"

namespace glintmark {

/// A named value of a switch.
struct Choice {
  std::string_view name;      // "toksvig"
  std::string_view constant;  // the kernels' macro of it, "LTC_TAO21"; of a method, its name
};

/// The values of an enumeration of kernel_config.h, that of 0 first.
template <typename T>
std::span<const Choice> choicesOf();
#define CHOICES(type) \
  template <>         \
  std::span<const Choice> choicesOf<type>();
#include "host/ocl/switches.inc"

/// What a switch may be: the whole numbers from `least` to `most`, or only those `listed`.
struct SwitchValues {
  std::string_view noun = "switch";  // what messages call it
  int least = 0, most = 1;
  std::vector<int> listed = {};              // ascending; empty: all of the range
  std::vector<std::string_view> names = {};  // by value; empty: numbers
  std::span<const Choice> choices = {};      // of enumerations
  std::string_view folder = {};              // of methods: that of kernels/ with method_<name>.clh

  bool allow(int value) const;
};

/// The values to which `glintmark accuracy` turns a switch.
struct Sweep {
  enum Kind { kNone, kKnob, kRivals, kByHand };
  Kind kind = kNone;
  std::string_view effect, knob;  // "glints", "ka"
  std::vector<int> values;        // in the order of the cases
};

/// A row of the table.
struct Switch {
  std::string_view macro;  // "LOBES"
  int standard = 0;        // the default
  SwitchValues values;
  Sweep sweep;
  std::string_view meaning, set_by;
  int (*of)(const KernelConfig& config) = nullptr;
  std::uint32_t bit = 0;  // of a BRANCH, in SurfaceMaterial::effects: the kernels' EFFECT_<macro>

  /// "16", "exact", "half".
  std::string nameOf(int value) const;
  /// What -D writes: the number, or the name of a method.
  std::string textOf(int value) const;
};

/// In the order in which buildOptions names them.
const std::vector<Switch>& allSwitches();

/// By its macro; throws Error if there is none.
const Switch& switchNamed(std::string_view macro);

/// Throws Error if a switch has a value that it may not have.
void requireAllowed(const KernelConfig& config);

/// Its value; nothing if no choice goes by that name.
std::optional<int> findChoice(std::span<const Choice> choices, std::string_view name);

/// "zk16" of GlintMethod::kZk16.
template <typename T>
std::string choiceName(T value) {
  return std::string(choicesOf<T>()[static_cast<std::size_t>(value)].name);
}

/// The names of all choices, in order.
std::vector<std::string> namesOf(std::span<const Choice> choices);
template <typename T>
std::vector<std::string> namesOf() {
  return namesOf(choicesOf<T>());
}

/// Throws Error "unknown `what` ..." listing the choices.
[[noreturn]] void throwUnknownChoice(std::span<const Choice> choices, const std::string& name,
                                     const std::string& what);

/// The choice of that name; throws Error listing all of them. `what` as in "unknown method".
template <typename T>
T parseChoice(const std::string& name, const std::string& what) {
  const std::optional<int> value = findChoice(choicesOf<T>(), name);
  if (!value) throwUnknownChoice(choicesOf<T>(), name, what);
  return static_cast<T>(*value);
}

}  // namespace glintmark
