#include "host/report/record/text_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "host/core/error.h"
#include "tests/report/widest_line.h"

namespace glintmark {
namespace {

std::ptrdiff_t countOf(const std::string& text, char c) {
  return std::ranges::count(text, c);
}

TEST(TextTable, AlignsColumns) {
  TextTable table({"name", "ms"});
  table.addRow({"a", "1.5"});
  table.addRow({"longer", "10"});
  EXPECT_EQ(table.toString(),
            "name     ms\n"
            "-----------\n"
            "a       1.5\n"
            "longer   10\n");
}

TEST(TextTable, RowsOfAnotherLengthAreErrors) {
  TextTable table({"a", "b"});
  EXPECT_THROW(table.addRow({"1"}), Error);
}

TEST(TextTable, TooWideTablesBreakTheFirstColumnOnly) {
  TextTable table({"a", "b"});
  table.addRow({std::string(60, 'x'), std::string(60, 'y')});
  EXPECT_EQ(widestLine(table.toString()), kTableColumnsLimit);
  EXPECT_NE(table.toString().find(std::string(60, 'y')), std::string::npos);
  EXPECT_EQ(countOf(table.toString(), 'x'), 60) << table.toString();
}

TEST(TextTable, CompactNumbers) {
  EXPECT_EQ(compactNumber(0), "0");
  EXPECT_EQ(compactNumber(0.01234), "0.0123");
  EXPECT_EQ(compactNumber(1.234), "1.23");
  EXPECT_EQ(compactNumber(9.996), "10.0");
  EXPECT_EQ(compactNumber(12.34), "12.3");
  EXPECT_EQ(compactNumber(99.96), "100");
  EXPECT_EQ(compactNumber(45678.4), "45678");
  EXPECT_EQ(compactNumber(99999.6), "100k");
  EXPECT_EQ(compactNumber(2073600), "2.1M");
  EXPECT_EQ(compactNumber(-1.5), "-1.50");
  EXPECT_EQ(compactNumber(std::numeric_limits<double>::quiet_NaN()), "-");
}

}  // namespace
}  // namespace glintmark
