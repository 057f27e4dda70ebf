#include "host/report/record/case_name.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "host/core/error.h"

namespace glintmark {

CaseName CaseName::parse(std::string_view text) {
  CaseName name;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('/', begin), text.size());
    const std::string_view part = text.substr(begin, end - begin);
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos)
      name.words.emplace_back(part);
    else
      name.knobs.emplace_back(std::string(part.substr(0, equals)),
                              std::string(part.substr(equals + 1)));
    begin = end + 1;
  }
  return name;
}

std::string CaseName::text() const {
  std::vector<std::string> parts = words;
  for (const CaseKnob& knob : knobs) parts.push_back(knob.name + "=" + knob.value);
  return fmt::format("{}", fmt::join(parts, "/"));
}

std::string CaseName::fileStem() const {
  std::string stem = text();
  std::ranges::replace_if(
      stem, [](char c) { return c == '/' || c == '='; }, '_');
  return stem;
}

const std::string& CaseName::word(std::size_t index) const {
  static const std::string none;
  return index < words.size() ? words[index] : none;
}

CaseName CaseName::rest() const {
  CaseName rest = *this;
  if (!rest.words.empty()) rest.words.erase(rest.words.begin());
  return rest;
}

std::optional<std::string> CaseName::value(std::string_view knob) const {
  const auto found = std::ranges::find(knobs, knob, &CaseKnob::name);
  return found == knobs.end() ? std::nullopt : std::optional(found->value);
}

double CaseName::number(std::string_view knob) const {
  const std::optional<std::string> found = value(knob);
  if (!found) throw Error(fmt::format("no {} in case {}", knob, text()));
  const std::optional<double> number = numberOf(*found);
  if (!number) throw Error(fmt::format("{}={} in case {} is not a number", knob, *found, text()));
  return *number;
}

std::optional<double> numberOf(std::string_view text) {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && stop == text.data() + text.size() ? std::optional(value)
                                                                   : std::nullopt;
}

}  // namespace glintmark
