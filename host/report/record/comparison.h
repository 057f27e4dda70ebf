// Two results files, record by record: what changed beyond the noise of its measurement.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/report/record/records.h"
#include "host/report/record/table_spec.h"

namespace glintmark {

enum class Change {
  kSame,       // equal, or apart by less than the threshold
  kNoise,      // apart by more than the threshold, but within the spread of the repetitions
  kBetter,     // beyond both
  kWorse,      // beyond both: a regression
  kDifferent,  // beyond both, in a figure that is neither good nor bad
  kBusy,       // worse, but a machine was busy
  kUndecided,  // one of the two was measured once, so that its spread is not known
};

/// "same", "noise", "better", "WORSE", "different", "busy", "undecided".
std::string changeName(Change change);

struct Comparison {
  std::string table, case_, metric, unit;
  double old_value = 0, new_value = 0;  // medians
  std::optional<double> p_value{};      // of the test below, where there are spreads
  Change change = Change::kSame;
  std::size_t old_index = 0;  // of its record in the old results
};

struct ComparisonReport {
  std::vector<Comparison> comparisons;     // in the order of the new file
  std::size_t only_old = 0, only_new = 0;  // records without a partner
  std::vector<std::string> newly_invalid;  // "table case metric": valid before, not any more
  std::string old_busy{}, new_busy{};      // why a machine was busy
  std::size_t other_timers = 0;            // times that the other run took by another clock

  bool hasRegression() const;
};

/// Two-sided significance level below which a difference is taken for a change.
inline constexpr double kChangeLevel = 0.01;

/// Compares the records of both that share table, case, metric and configuration (the kernels'
/// build options, lanes, how often it was timed and by which clock left aside). The test is Welch's
/// t on the medians: the standard error of a median is sqrt(pi / 2) stddev / sqrt(n), as for normal
/// samples. Figures that are not times and have no spread are exact, so any difference beyond
/// `threshold` (a fraction, 0.05 for 5 %) is a change; `tables` say which ratios are wanted small.
/// The test knows nothing of drift between the two runs: where one of them says that its machine
/// was busy, times that got worse are called busy.
ComparisonReport compareResults(const Results& old_results, const Results& new_results,
                                std::span<const TableSpec> tables, double threshold);

/// Changes (all comparisons if `all`) as a table, then the totals in a sentence.
std::string comparisonText(const ComparisonReport& report, bool all);

/// The same as JSON, schema "glintmark.comparison/1".
std::string comparisonJson(const ComparisonReport& report, double threshold);

}  // namespace glintmark
