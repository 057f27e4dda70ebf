// A table that nobody has: all that the page shows of it comes from what it says of itself.
#include "host/report/record/table_spec.h"

#include <gtest/gtest.h>

#include "host/core/error.h"
#include "host/report/page/chart_section.h"
#include "host/report/page/html_report.h"
#include "tests/report/sample_records.h"

namespace glintmark {
namespace {

std::string ownSection(std::span<const Record> records) {
  return "<p>own section of " + std::to_string(records.size()) + "</p>\n" +
         tradeOffHtml({.cost = "stew_ms",
                       .error = "salt",
                       .noise = "pepper",
                       .optimal = "best",
                       .cost_title = "time",
                       .error_title = "salt & pepper",
                       .noise_title = "noise",
                       .tip = "{error} in {cost}"},
                      "kitchen", "pot", "salt over time");
}

TableSpec kitchen() {
  return {.name = "kitchen",
          .title = "Soups & stews",
          .about = "What soup costs.",
          .source = "Grandmother 1931",
          .metrics = {{"stew_ms", "ms", "stewing", "", "", {"salt"}},
                      {"salt", "1", "salt content"},
                      {"cut_ms", "ms"},
                      {"peas", "peas"}},
          .cost_ratios = {"stew_over_roast"},
          .headline = Headline{"stew_ms", "milliseconds of stewing"},
          .frame_parts = {{"cut_ms", "cutting"}, {"stew_ms", "stewing"}},
          .curves = {{"stew_ms"}},
          .pictures = {{.kind = PictureGroup::Kind::kHeatmaps, .heading = "Peas", .metric = "peas"},
                       {.kind = PictureGroup::Kind::kStrips,
                        .heading = "Pots",
                        .truth_first = true,
                        .differences = true},
                       {.pictures = {{"steam.png", "steam", "nobody has drawn the steam"}},
                        .large = true},
                       {.metric = "no_such_metric", .pictures = {{"never.png", "never"}}},
                       {.kind = PictureGroup::Kind::kHidden, .pictures = {{"secret.png", ""}}}},
          .section = ownSection};
}

Record kitchenRecord(const std::string& case_name, const std::string& metric, double value) {
  Record record = sampleRecord(case_name, metric, value);
  record.table = "kitchen";
  return record;
}

Results kitchenRun() {
  Results run{sampleRun(), {}};
  for (const char* method : {"slow", "fast"}) {
    const std::string name = std::string("pot/lid/") + method;
    run.records.push_back(kitchenRecord(name, "stew_ms", 40));
    run.records.back().paper = 20;
    run.records.push_back(kitchenRecord(name, "salt", 0.5));
    run.records.push_back(kitchenRecord(name, "cut_ms", 10));
    run.records.push_back(kitchenRecord(name, "peas", 12));
  }
  for (const char* carrots : {"1", "2", "4"})
    run.records.push_back(kitchenRecord(std::string("pot/carrots=") + carrots, "stew_ms", 20));
  return run;
}

std::string pageOf(std::span<const TableSpec> tables) {
  const std::vector<ReportPicture> pictures = {{"kitchen_pot_lid.png", "strip", "", {}},
                                               {"secret.png", "secret", "", {}},
                                               {"kitchen_more.png", "more", "", {}}};
  return htmlReport(kitchenRun(), tables, pictures, "results.json");
}

TEST(TableSpec, ThePageShowsWhatATableSaysOfItself) {
  const TableSpec table = kitchen();
  const std::string page = pageOf({&table, 1});
  for (const char* part :
       {("<a class=\"tile\" href=\"#kitchen\"><b>20.0 … 40.0</b><span>milliseconds of "
         "stewing</span>"),
        "<a href=\"#kitchen\">Soups &amp; stews</a>",
        "<h2 id=\"kitchen\">Soups &amp; stews</h2>",
        "<p>What soup costs.</p>",
        "Paper: Grandmother 1931",
        "<caption>stewing, ms</caption>",
        "<th scope=\"col\">salt content, ms</th>",
        "<p>own section of 11</p>",
        "<li class=\"part0\">cutting</li><li class=\"part1\">stewing</li>",
        "<div class=\"label\">pot/lid/slow</div>",
        ("data-chart=\"curve\" data-table=\"kitchen\" data-prefix=\"pot/carrots=\" "
         "data-metrics=\"stew_ms\""),
        "aria-label=\"stewing, ms over pot/carrots\"",
        ("data-chart=\"tradeoff\" data-table=\"kitchen\" data-prefix=\"pot/\" "
         "data-cost=\"stew_ms\" "
         "data-error=\"salt\" data-noise=\"pepper\" data-optimal=\"best\""),
        "data-error-title=\"salt &amp; pepper\"",
        "<h3>Peas</h3>",
        "cells_pot_lid_slow.png is not in the folder",
        "<h3>Pots</h3>",
        "data-panels=\"truth;slow;fast;|slow − truth|;|fast − truth|\"",
        "<figcaption>pot/lid</figcaption>",
        "nobody has drawn the steam",
        "<figcaption>kitchen_more.png</figcaption>",
        "<details><summary>All 11 figures"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  for (const char* part : {"secret.png", "never.png", "More pictures"})
    EXPECT_EQ(page.find(part), std::string::npos) << part;
}

TEST(TableSpec, WithoutItTheSameRecordsAreAPlainTable) {
  const std::string page = pageOf({});
  EXPECT_NE(page.find("<h2 id=\"kitchen\">kitchen</h2>"), std::string::npos);
  EXPECT_NE(page.find("<caption>stew_ms, ms</caption>"), std::string::npos);
  for (const char* part : {"class=\"tile\"", "own section", "<canvas", "class=\"bars\"",
                           "data-panels=", "nobody has drawn"})
    EXPECT_EQ(page.find(part), std::string::npos) << part;
  EXPECT_NE(page.find("secret.png"), std::string::npos);  // nobody says that it is not to be shown
}

TEST(TableSpec, AStripMayBeMissingOnlyWhereTheTableSaysSo) {
  TableSpec table = kitchen();
  const Results run = kitchenRun();
  const std::string missing = "kitchen_pot_lid.png is not in the folder";
  EXPECT_NE(htmlReport(run, {&table, 1}, {}, "r").find(missing), std::string::npos);
  table.pictures[1].optional = true;
  EXPECT_EQ(htmlReport(run, {&table, 1}, {}, "r").find(missing), std::string::npos);
}

TEST(TableSpec, AHeadlineMayCount) {
  TableSpec table = kitchen();
  table.headline = Headline{"best", "best pots", true};
  Results run{sampleRun(), {}};
  for (const double value : {1.0, 0.0, 1.0})
    run.records.push_back(kitchenRecord("pot/" + std::to_string(value), "best", value));
  run.records.back().valid = false;
  EXPECT_NE(htmlReport(run, {&table, 1}, {}, "r").find("<b>1</b><span>best pots</span>"),
            std::string::npos);
}

TEST(TableSpec, MetricsByName) {
  const TableSpec table = kitchen();
  EXPECT_EQ(table.metricTitle("stew_ms", "ms"), "stewing, ms");
  EXPECT_EQ(table.metricTitle("salt", "1"), "salt content");
  EXPECT_EQ(table.metricTitle("peas", "peas"), "peas");
  EXPECT_EQ(table.metric("cut_ms").unit, "ms");
  EXPECT_EQ(table.findMetric("leeks"), nullptr);
  EXPECT_THROW(table.metric("leeks"), Error);
  EXPECT_EQ(tableOf({&table, 1}, "cellar").title, "cellar");
}

}  // namespace
}  // namespace glintmark
