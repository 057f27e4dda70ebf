// What the tables say of themselves, against what was measured, what is documented, and what the
// page may know.
#include "host/experiment/all_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "host/core/atomic_file.h"
#include "host/report/record/records.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

const fs::path kProject = GLINTMARK_SOURCE_DIR;

std::vector<fs::path> filesBelow(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  return files;
}

TEST(AllTables, EachHasItsNameAndItsMetricsOnce) {
  std::set<std::string> names;
  for (const TableSpec& table : allTableSpecs()) {
    EXPECT_TRUE(names.insert(table.name).second) << table.name;
    EXPECT_FALSE(table.title.empty()) << table.name;
    EXPECT_FALSE(table.about.empty()) << table.name;
    ASSERT_FALSE(table.metrics.empty()) << table.name;
    EXPECT_FALSE(table.metrics.front().meaning.empty()) << table.name;
    std::set<std::string> metrics;
    for (const MetricSpec& metric : table.metrics) {
      EXPECT_TRUE(metrics.insert(metric.name).second) << table.name << " " << metric.name;
      EXPECT_FALSE(metric.unit.empty()) << table.name << " " << metric.name;
    }
  }
}

TEST(AllTables, WhatIsShownIsMeasured) {
  for (const TableSpec& table : allTableSpecs()) {
    std::vector<std::string> shown = table.cost_ratios;
    if (table.headline) shown.push_back(table.headline->metric);
    for (const TimePart& part : table.frame_parts) shown.push_back(part.metric);
    for (const auto& group : table.curves) shown.insert(shown.end(), group.begin(), group.end());
    for (const PictureGroup& group : table.pictures)
      if (!group.metric.empty()) shown.push_back(group.metric);
    for (const MetricSpec& metric : table.metrics)
      shown.insert(shown.end(), metric.beside.begin(), metric.beside.end());
    for (const std::string& metric : shown)
      EXPECT_NE(table.findMetric(metric), nullptr) << table.name << " " << metric;
  }
}

// Every record that was ever published: in a table that is there, by a metric of its, in its unit.
TEST(AllTables, PublishedResultsAreOfTheirMetricsAndUnits) {
  const std::vector<TableSpec> tables = allTableSpecs();
  std::set<std::string> seen;
  for (const fs::path& file : filesBelow(kProject / "results")) {
    if (file.filename() != "results.json") continue;
    for (const Record& record : readResults(file).records) {
      seen.insert(record.table);
      const MetricSpec* metric = tableOf(tables, record.table).findMetric(record.metric);
      ASSERT_NE(metric, nullptr) << file << " " << record.table << " " << record.metric;
      EXPECT_EQ(metric->unit, record.unit) << record.table << " " << record.metric;
    }
  }
  EXPECT_GE(seen.size(), 6u);
}

// The table's metrics as Markdown: those whose meaning is said together in one row.
std::string metricsMarkdown(const TableSpec& table) {
  const bool has_cases =
      std::ranges::any_of(table.metrics, [](const auto& one) { return !one.cases.empty(); });
  std::string text = has_cases ? "| case | metric | unit | meaning |\n|---|---|---|---|\n"
                               : "| metric | unit | meaning |\n|---|---|---|\n";
  for (std::size_t i = 0; i < table.metrics.size();) {
    const MetricSpec& first = table.metrics[i];
    std::vector<std::string> names, units;
    do {
      names.push_back("`" + table.metrics[i].name + "`");
      const std::string& unit = table.metrics[i].unit;
      if (std::ranges::find(units, unit) == units.end()) units.push_back(unit);
    } while (++i < table.metrics.size() && table.metrics[i].meaning.empty());
    text += fmt::format("|{} {} | {} | {} |\n", has_cases ? " " + first.cases + " |" : "",
                        fmt::join(names, ", "), fmt::join(units, ", "), first.meaning);
  }
  return std::regex_replace(text, std::regex("\\|  \\|"), "| |");
}

TEST(AllTables, ReadmeSaysWhatTheTablesSay) {
  const std::string readme = readFile(kProject / "results/README.md");
  const std::vector<TableSpec> tables = allTableSpecs();
  std::size_t sections = 0;
  for (const TableSpec& table : tables) {
    const std::size_t begin = readme.find(fmt::format("\n## Table `{}`\n", table.name));
    if (begin == std::string::npos) continue;
    ++sections;
    const std::string section =
        readme.substr(begin, std::min(readme.find("\n## ", begin + 1), readme.size()) - begin);
    const std::string expected = metricsMarkdown(table);
    EXPECT_NE(section.find(expected), std::string::npos)
        << "results/README.md, table " << table.name << ", should hold\n"
        << expected;
  }
  EXPECT_GE(sections, 6u);
}

std::vector<std::string> tableNames() {
  std::vector<std::string> names;
  for (const TableSpec& table : allTableSpecs()) names.push_back(table.name);
  return names;
}

// Text in quotes that begins with a table's name; comments do not count.
std::vector<std::string> namedTables(const std::string& source) {
  const std::string code = std::regex_replace(source, std::regex("//[^\n]*"), "");
  const std::regex quoted(fmt::format("[\"'`#.]({})(?![A-Za-z0-9])", fmt::join(tableNames(), "|")));
  std::vector<std::string> found;
  for (std::sregex_iterator hit(code.begin(), code.end(), quoted), end; hit != end; ++hit)
    found.push_back(hit->str());
  return found;
}

TEST(AllTables, ReportKnowsNoneByName) {
  EXPECT_EQ(namedTables("if (table == \"zk16\") // or \"tan05\"\n f('tao21_over_original')").size(),
            2u);
  std::size_t files = 0;
  for (const fs::path& file : filesBelow(kProject / "host/report")) {
    ++files;
    EXPECT_EQ(namedTables(readFile(file)), std::vector<std::string>()) << file;
  }
  EXPECT_GT(files, 40u);
}

}  // namespace
}  // namespace glintmark
