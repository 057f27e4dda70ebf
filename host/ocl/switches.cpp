#include "host/ocl/switches.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "host/core/error.h"
#include "host/core/shared_types.h"

namespace glintmark {

#define CHOICES(type)                         \
  template <>                                 \
  std::span<const Choice> choicesOf<type>() { \
    static constexpr Choice kChoicesOfType[] = {
#define CHOICE(enumerator, name, constant) {name, #constant},
#define CHOICES_END      \
  }                      \
  ;                      \
  return kChoicesOfType; \
  }
#include "host/ocl/switches.inc"

namespace {

// The words of the table.

SwitchValues flag() {
  return {};
}

SwitchValues flag(std::string_view off, std::string_view on) {
  return {.names = {off, on}};
}

SwitchValues range(std::string_view noun, int least, int most) {
  return {.noun = noun, .least = least, .most = most};
}

SwitchValues oneOf(std::string_view noun, const std::vector<int>& listed) {
  return {.noun = noun, .least = listed.front(), .most = listed.back(), .listed = listed};
}

template <typename T>
SwitchValues choices(std::string_view noun) {
  SwitchValues values{.noun = noun};
  values.choices = choicesOf<T>();
  values.most = static_cast<int>(values.choices.size()) - 1;
  for (const Choice& choice : values.choices) values.names.push_back(choice.name);
  return values;
}

template <typename T>
SwitchValues methods(std::string_view noun, std::string_view folder) {
  SwitchValues values = choices<T>(noun);
  values.folder = folder;
  return values;
}

template <typename T>
Sweep sweepOf(Sweep::Kind kind, std::string_view effect, std::string_view name,
              std::initializer_list<T> values) {
  Sweep sweep{kind, effect, name, {}};
  for (const T value : values) sweep.values.push_back(static_cast<int>(value));
  return sweep;
}

template <typename T>
Sweep knob(std::string_view effect, std::string_view name, std::initializer_list<T> values) {
  return sweepOf(Sweep::kKnob, effect, name, values);
}

template <typename T>
Sweep rivals(std::string_view effect, std::string_view name, std::initializer_list<T> values) {
  return sweepOf(Sweep::kRivals, effect, name, values);
}

template <typename T>
Sweep byHand(std::string_view effect, std::string_view name, std::initializer_list<T> values) {
  return sweepOf(Sweep::kByHand, effect, name, values);
}

Sweep unswept() {
  return {};
}

std::vector<Switch> makeSwitches() {
  std::uint32_t next_bit = 1;
  const auto take_bit = [&] { return std::exchange(next_bit, next_bit << 1); };
  return {
#define ROW(macro, member, standard, values, sweep, meaning, set_by, bit) \
  {#macro,                                                                \
   static_cast<int>(standard),                                            \
   values,                                                                \
   sweep,                                                                 \
   meaning,                                                               \
   set_by,                                                                \
   [](const KernelConfig& c) { return static_cast<int>(c.member); },      \
   bit},
#define SWEPT_SWITCH(macro, type, member, standard, values, sweep, meaning, set_by) \
  ROW(macro, member, standard, values, sweep, meaning, set_by, 0)
#define BRANCH(macro, type, member, standard, values, meaning, set_by) \
  ROW(macro, member, standard, values, unswept(), meaning, set_by, take_bit())
#define KNOB_ELSE(macro, type, member, standard, without, values, effect, ...) \
  SWEPT_SWITCH(macro, type, member, standard, values, __VA_ARGS__)
#include "host/ocl/switches.inc"
#undef ROW
  };
}

}  // namespace

bool SwitchValues::allow(int value) const {
  return listed.empty() ? least <= value && value <= most
                        : std::ranges::find(listed, value) != listed.end();
}

std::string Switch::nameOf(int value) const {
  return values.names.empty() ? std::to_string(value)
                              : std::string(values.names.at(static_cast<std::size_t>(value)));
}

std::string Switch::textOf(int value) const {
  return values.folder.empty() ? std::to_string(value) : nameOf(value);
}

const std::vector<Switch>& allSwitches() {
  static const std::vector<Switch> switches = makeSwitches();
  return switches;
}

const Switch& switchNamed(std::string_view macro) {
  const auto found = std::ranges::find(allSwitches(), macro, &Switch::macro);
  if (found == allSwitches().end()) throw Error(fmt::format("no switch is called {}", macro));
  return *found;
}

void requireAllowed(const KernelConfig& config) {
  for (const Switch& row : allSwitches()) {
    const int value = row.of(config);
    if (row.values.allow(value)) continue;
    std::vector<std::string> allowed;
    if (!row.values.names.empty()) {
      for (int i = row.values.least; i <= row.values.most; ++i)
        allowed.push_back(fmt::format("{} ({})", i, row.nameOf(i)));
      throw Error(fmt::format("{} {} is unknown; it must be {}", row.values.noun, value,
                              listOf(allowed, "or")));
    }
    for (const int listed : row.values.listed) allowed.push_back(std::to_string(listed));
    if (!allowed.empty())
      throw Error(
          fmt::format("{} {} is not one of {}", row.values.noun, value, listOf(allowed, "and")));
    throw Error(fmt::format("{} {} is out of range; it must be {} to {}", row.values.noun, value,
                            row.values.least, row.values.most));
  }
}

std::optional<int> findChoice(std::span<const Choice> choices, std::string_view name) {
  const auto found = std::ranges::find(choices, name, &Choice::name);
  if (found == choices.end()) return std::nullopt;
  return static_cast<int>(found - choices.begin());
}

std::vector<std::string> namesOf(std::span<const Choice> choices) {
  std::vector<std::string> names;
  for (const Choice& choice : choices) names.emplace_back(choice.name);
  return names;
}

void throwUnknownChoice(std::span<const Choice> choices, const std::string& name,
                        const std::string& what) {
  throw Error(unknownName(what, name, namesOf(choices)));
}

}  // namespace glintmark
