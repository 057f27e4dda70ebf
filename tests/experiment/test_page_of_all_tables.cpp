// The page of a run with every table.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/experiment/all_tables.h"
#include "host/report/page/html_report.h"
#include "tests/experiment/sample_run.h"

namespace glintmark {
namespace {

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

TEST(PageOfAllTables, EveryTableHasItsSection) {
  const std::string page = htmlReport(SampleRun().results(), allTableSpecs(), {}, "results.json");
  for (const char* table :
       {"zk16", "tan05", "tao21", "msbrdf", "effects", "accuracy", "some_new_table"})
    EXPECT_NE(page.find(fmt::format("<h2 id=\"{}\">", table)), std::string::npos) << table;
  for (const char* element : {"table", "section", "details", "figure", "div", "p", "tr", "h3"})
    EXPECT_EQ(
        countOf(page, fmt::format("<{}>", element)) + countOf(page, fmt::format("<{} ", element)),
        countOf(page, fmt::format("</{}>", element)))
        << element;
  EXPECT_EQ(countOf(page, "data-chart=\"tradeoff\""), 2u);
  // The default of glints stands under two knobs, but is one setting.
  EXPECT_EQ(countOf(page, "Pareto-optimal: ka=1, ka=2, the default, ka=8, ka=16."), 2u);
  EXPECT_EQ(countOf(page, "<p>The default of glints has an error of 0.05 "), 1u);
  EXPECT_EQ(countOf(page, "; the next step up, ka=8, takes 2.05 times its time"), 2u);
  EXPECT_NE(page.find("Where the time of a frame goes"), std::string::npos);
  // The matrix is symmetric: a pair stands twice, next to its ratio.
  EXPECT_EQ(countOf(page, "class=\"heat\""), 15u);  // 9 of the ratio, 6 of the sums
}

TEST(PageOfAllTables, ATableNobodyKnowsIsAPlainTable) {
  const std::string page = htmlReport(SampleRun().results(), allTableSpecs(), {}, "results.json");
  const std::string section = page.substr(page.find("<h2 id=\"some_new_table\">"));
  EXPECT_NE(section.find("<details open>"), std::string::npos);
  EXPECT_NE(section.find("a &lt;b&gt; &amp; &quot;c&quot;"), std::string::npos);
}

TEST(PageOfAllTables, MissingPicturesAreSaidInTheirPlace) {
  const std::string page = htmlReport(SampleRun().results(), allTableSpecs(), {}, "results.json");
  for (const char* name : {"cells_snow_steep.png", "cells_car_steep.png",
                           "tao21_area_cloth_near.png", "msbrdf_energy.png"})
    EXPECT_NE(page.find(std::string(name) + " is not in the folder"), std::string::npos) << name;
}

}  // namespace
}  // namespace glintmark
