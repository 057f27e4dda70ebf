// The name of a case, as records keep it: "disk/near/gmm", "area_glass/middle/exact/roughness=0.1".
#pragma once
#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace glintmark {

/// A knob and its value, "roughness=0.1".
struct CaseKnob {
  std::string name, value;

  CaseKnob(std::string knob_name, std::string knob_value)
      : name(std::move(knob_name)), value(std::move(knob_value)) {}
  /// A number with as few digits as give it back.
  template <typename Number>
  requires std::is_arithmetic_v<Number> CaseKnob(std::string knob_name, Number number)
      : CaseKnob(std::move(knob_name), fmt::format("{}", number)) {}

  bool operator==(const CaseKnob&) const = default;
};

/// Words and then knobs, joined by slashes. What a word means is the table's: a scene, a view, a
/// method, an effect.
struct CaseName {
  std::vector<std::string> words{};
  std::vector<CaseKnob> knobs{};

  /// The inverse of text(). A part with '=' is a knob, its value all behind the first '='; knobs
  /// before words come back behind them.
  static CaseName parse(std::string_view text);
  std::string text() const;
  /// The same as part of a file's name: '/' and '=' become '_'.
  std::string fileStem() const;

  /// Empty if there are not so many words.
  const std::string& word(std::size_t index) const;
  /// All but the first word.
  CaseName rest() const;
  /// Nothing if there is no such knob.
  std::optional<std::string> value(std::string_view knob) const;
  /// A knob's value as a number. Throws Error if there is no such knob, or if it is no number.
  double number(std::string_view knob) const;

  bool operator==(const CaseName&) const = default;
};

/// All of `text` as a number; nothing if it is none.
std::optional<double> numberOf(std::string_view text);

}  // namespace glintmark
