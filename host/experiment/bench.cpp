#include "host/experiment/bench.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/core/trace.h"
#include "host/core/unknown_name.h"
#include "host/experiment/all_tables.h"
#include "host/experiment/interrupt.h"
#include "host/experiment/survival.h"
#include "host/parallel/ranks.h"
#include "host/report/record/score.h"
#include "host/report/record/trace_file.h"

namespace glintmark {
namespace {

// Those that are not measured by a command of their own.
std::vector<BenchTable> benchTables() {
  std::vector<BenchTable> tables = allTables();
  std::erase_if(tables, [](const BenchTable& table) { return table.measure == nullptr; });
  return tables;
}

std::vector<std::string> namesOf(const std::vector<BenchTable>& tables) {
  std::vector<std::string> names;
  names.reserve(tables.size());
  for (const BenchTable& table : tables) names.push_back(table.spec.name);
  return names;
}

// Throws Error if some chosen name is none of the known ones.
void requireKnown(const char* what, const std::vector<std::string>& chosen,
                  const std::vector<std::string>& known) {
  for (const std::string& name : chosen) requireKnownName(what, name, known);
}

// Appends those of `names` that are not there yet.
void addNew(const std::vector<std::string>& names, std::vector<std::string>& all) {
  for (const std::string& name : names)
    if (std::ranges::find(all, name) == all.end()) all.push_back(name);
}

// Does the table have any of the chosen names?
bool offersAny(const std::vector<std::string>& known, const std::vector<std::string>& chosen) {
  return chosen.empty() || !selectNames(known, chosen).empty();
}

std::vector<BenchTable> chooseTables(const std::vector<std::string>& names,
                                     const BenchOptions& options) {
  std::vector<BenchTable> tables = benchTables();
  requireKnown("table", names, namesOf(tables));
  if (!names.empty())
    std::erase_if(tables, [&](const BenchTable& table) {
      return std::ranges::find(names, table.spec.name) == names.end();
    });
  std::vector<std::string> scenes, views;
  for (const BenchTable& table : tables) {
    addNew(table.scenes, scenes);
    addNew(table.views, views);
  }
  requireKnown("scene", options.scenes, scenes);
  requireKnown("view", options.views, views);
  std::erase_if(tables, [&](const BenchTable& table) {
    return !offersAny(table.scenes, options.scenes) || !offersAny(table.views, options.views);
  });
  return tables;
}

}  // namespace

std::vector<std::string> benchTableNames() {
  return namesOf(benchTables());
}

namespace {

int measureTables(const Session& session, const std::vector<BenchTable>& tables,
                  const BenchOptions& options) {
  const InterruptGuard guard;
  const bool traces = !options.trace.empty() && allRanks().isFirst();
  if (traces) {
    announceOutputs({{"--trace", options.trace}});
    startTrace();
  }
  BenchRun run(session, options);
  try {
    for (std::size_t i = 0; i < tables.size(); ++i) {
      run.shareTime(tables.size() - i);
      tables[i].measure(run);
    }
  } catch (const Interrupted&) {
    if (traces) writeTrace(options.trace, run.info());
    throw;
  }
  if (!allRanks().isFirst()) return kExitDone;
  requireMeasured(run.records().size());
  std::vector<std::string> texts;
  texts.reserve(tables.size());
  for (const BenchTable& table : tables) texts.push_back(table.text(run));
  if (traces) writeTrace(options.trace, run.info());
  std::string scores;
  for (const BenchTable& table : tables) scores += scoreLine(table.spec, run.records());
  return run.finish(
      fmt::format("{}{}{}", fmt::join(texts, "\n"), scores.empty() ? "" : "\n", scores));
}

}  // namespace

int runBench(const Session& session, const std::vector<std::string>& names,
             const BenchOptions& options) {
  const std::vector<BenchTable> tables = chooseTables(names, options);
  return runSurviving(session.common.quiet, [&](bool first) {
    BenchOptions own = options;
    own.resume = options.resume || !first;
    return measureTables(session, tables, own);
  });
}

}  // namespace glintmark
