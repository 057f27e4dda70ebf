#include "host/experiment/accuracy/accuracy_effect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.h"
#include "host/experiment/accuracy/accuracy_table.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

template <typename Get>
double geometricMean(std::span<const AccuracyFigures> figures, Get get) {
  double sum = 0;
  for (const AccuracyFigures& one : figures) sum += std::log(get(one));  // log(0): the mean is 0
  return std::exp(sum / static_cast<double>(figures.size()));
}

std::optional<double> geometricMeanOver(std::span<const AccuracyFigures> figures,
                                        std::optional<double> AccuracyFigures::*member) {
  if (std::ranges::any_of(figures, [&](const auto& one) { return !(one.*member); })) return {};
  return geometricMean(figures, [&](const auto& one) { return *(one.*member); });
}

}  // namespace

std::string knobOf(const std::string& setting) {
  const CaseName name = CaseName::parse(setting);
  return name.knobs.empty() ? name.text() : name.knobs.front().name;
}

std::string accuracyCase(const std::string& effect, const std::string& setting) {
  CaseName name = CaseName::parse(setting);
  name.words.insert(name.words.begin(), effect);
  return name.text();
}

AccuracyFigures meanFigures(std::span<const AccuracyFigures> figures) {
  if (figures.empty()) throw Error("no scene to take a mean over");
  AccuracyFigures mean;
  mean.error = geometricMean(figures, [](const auto& one) { return one.error; });
  mean.truth_stderr = geometricMean(figures, [](const auto& one) { return one.truth_stderr; });
  for (const auto member : {&AccuracyFigures::rel_mse, &AccuracyFigures::colour_error,
                            &AccuracyFigures::variance_ratio, &AccuracyFigures::motion_ratio})
    mean.*member = geometricMeanOver(figures, member);
  for (const AccuracyFigures& one : figures) {
    mean.bias += one.bias / static_cast<double>(figures.size());
    if (mean.failure.empty()) mean.failure = one.failure;
  }
  return mean;
}

std::vector<Record> AccuracyEffect::measureCloser(const std::string& case_name) {
  throw Error(fmt::format("no case {}", case_name));
}

std::string AccuracyEffect::closerText(std::span<const Record>) const {
  return "";
}

std::vector<Record> accuracyRecords(const BenchRun& run, const std::string& case_name,
                                    const std::string& role, const AccuracyFigures& figures,
                                    const AccuracyTimes& times, const AccuracyNotes& notes) {
  std::vector<Record> records;
  const auto add = [&](const char* metric, const std::vector<double>& samples,
                       const std::string& note) {
    records.push_back(run.record(accuracySpec(), case_name, metric, samples, note));
    records.back().config["role"] = role;
    if (figures.failure.empty()) return;
    records.back().valid = false;
    records.back().note = "not valid: " + figures.failure;
  };
  add("error", {figures.error}, notes.error);
  add("truth_stderr", {figures.truth_stderr}, "of the truth, in the metric of the error");
  add("time_ratio", times.ratio, notes.time);
  add("time_ms", times.ms, notes.time);
  if (!times.fit_ratio.empty())
    add("fit_ratio", times.fit_ratio,
        "what is fitted before the first frame, over the default's, in turn");
  add("bias", {figures.bias}, "of the mean radiance");
  const auto add_if = [&](const char* metric, const std::optional<double>& value,
                          const std::string& note) {
    if (value) add(metric, {*value}, note);
  };
  add_if("rel_mse", figures.rel_mse, "");
  add_if("colour_error", figures.colour_error, "of display colours");
  add_if("variance_ratio", figures.variance_ratio, "of pixels over the truth's, geometric mean");
  add_if("motion_ratio", figures.motion_ratio,
         "mean change per quarter of a pixel over the truth's, geometric mean");
  return records;
}

}  // namespace glintmark
