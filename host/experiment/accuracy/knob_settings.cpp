#include "host/experiment/accuracy/knob_settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/error.h"
#include "host/experiment/accuracy/accuracy_table.h"
#include "host/ocl/switches.h"

namespace glintmark {
namespace {

AccuracySetting settingOf(const Switch& row, int value) {
  const char* role = row.sweep.kind == Sweep::kRivals ? kAccuracyRival
                     : value == row.standard          ? kAccuracyDefault
                                                      : kAccuracyKnob;
  return {fmt::format("{}={}", row.sweep.knob, row.nameOf(value)),
          [macro = row.macro, value](ShadingOptions& o) { turnKnob(o, macro, value); }, role};
}

}  // namespace

KnobSettings::KnobSettings(std::string_view effect) {
  for (const Sweep::Kind kind : {Sweep::kKnob, Sweep::kRivals})
    for (const Switch& row : allSwitches())
      if (row.sweep.kind == kind && row.sweep.effect == effect)
        for (const int value : row.sweep.values) settings_.push_back(settingOf(row, value));
}

void KnobSettings::moveTo(std::vector<AccuracySetting>& all,
                          std::initializer_list<std::string_view> knobs) {
  for (const std::string_view knob : knobs) {
    const auto rest =
        std::stable_partition(settings_.begin(), settings_.end(),
                              [&](const AccuracySetting& one) { return knobOf(one.name) != knob; });
    if (rest == settings_.end())
      throw Error(fmt::format("the table of switches has no knob {}", knob));
    std::move(rest, settings_.end(), std::back_inserter(all));
    settings_.erase(rest, settings_.end());
  }
}

void KnobSettings::moveRestTo(std::vector<AccuracySetting>& all) {
  std::ranges::move(settings_, std::back_inserter(all));
  settings_.clear();
}

}  // namespace glintmark
