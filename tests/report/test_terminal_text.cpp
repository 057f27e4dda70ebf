// Printed text keeps to the columns there are, and loses nothing.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "host/report/record/terminal_text.h"
#include "host/report/record/text_table.h"
#include "tests/report/widest_line.h"

namespace glintmark {
namespace {

TEST(TerminalText, LinesAreBrokenAtBlanks) {
  EXPECT_EQ(wrapped("one two three", 7, 0), "one two\nthree");
  EXPECT_EQ(wrapped("one two three", 8, 2), "one two\n  three");
  EXPECT_EQ(wrapped("  a b", 80, 4), "  a b");
  EXPECT_EQ(wrapped("unbreakable", 4, 0), "unbreakable");
  EXPECT_EQ(wrapped("a unbreakable b", 4, 0), "a\nunbreakable\nb");
  EXPECT_EQ(wrapped(std::string(50, ' '), 20, 0), std::string(50, ' '));
  EXPECT_EQ(wrapped("\xC3\xA4\xC3\xA4 \xC3\xB6", 4, 0), "\xC3\xA4\xC3\xA4 \xC3\xB6");
  EXPECT_EQ(fitted("  memory      one two three\n", 20 + 8), "  memory      one two three\n");
  EXPECT_EQ(fitted("  mem   one two three\n", 20), "  mem   one two\n        three\n");
}

TEST(TerminalText, CellsAreBrokenBehindSigns) {
  EXPECT_EQ(cellLines("", 5), std::vector<std::string>{""});
  EXPECT_EQ(cellLines("area_cloth/far/tao21", 12),
            (std::vector<std::string>{"area_cloth/", "far/tao21"}));
  EXPECT_EQ(cellLines("abcdefgh", 3), (std::vector<std::string>{"abc", "def", "gh"}));
}

TEST(TerminalText, WideTablesBecomeSeveralWithTheFirstColumnInEach) {
  TextTable table({"scene", "paper ms", "ours", "ratio of both"});
  table.addRow({"snow", "2.5", "16.7", "6.66"});
  table.addRow({"", "4.0", "38.2", "9.55"});
  const std::string whole = table.toString();
  EXPECT_EQ(fitted(whole, 80), whole);
  EXPECT_EQ(fitted(whole, 24),
            "scene  paper ms  ours\n"
            "---------------------\n"
            "snow        2.5  16.7\n"
            "            4.0  38.2\n"
            "\n"
            "scene  ratio of both\n"
            "--------------------\n"
            "snow            6.66\n"
            "                9.55\n");
}

TEST(TerminalText, ScoresStayOneLineForWhatLooksForThem) {
  const std::string score = "score: zk16 shading_event_ms 0.09 ms 1 cases\n";
  EXPECT_EQ(fitted(score, 20), score);
}

// Blanks within names, words below no header, and a header longer than its names.
TEST(TerminalText, TheFirstColumnMayHoldWords) {
  TextTable table({"metric", "all pixels", "not black"});
  table.addRow({"bias  a / b - 1", "1", "2"});
  table.addRow({"mape  c / d - 2", "3", "4"});
  EXPECT_EQ(fitted(table.toString(), 29),
            "metric           all pixels\n"
            "---------------------------\n"
            "bias  a / b - 1           1\n"
            "mape  c / d - 2           3\n"
            "\n"
            "metric           not black\n"
            "--------------------------\n"
            "bias  a / b - 1          2\n"
            "mape  c / d - 2          4\n");
  TextTable cases({"case", "metric", "old", "new"});
  cases.addRow({"zk16 plane/steep", "shading_ms", "10.5", "1"});
  cases.addRow({"zk16 plane/grazing", "cells", "22", "1"});
  EXPECT_EQ(fitted(cases.toString(), 36).substr(0, 36), "case                    metric   old");
  TextTable errors({"error of pixels not black", "50 %", "90 %"});
  errors.addRow({"absolute", "0", "0"});
  EXPECT_EQ(fitted(errors.toString(), 32),
            "error of pixels not black  50 %\n"
            "-------------------------------\n"
            "absolute                      0\n"
            "\n"
            "error of pixels not black  90 %\n"
            "-------------------------------\n"
            "absolute                      0\n");
}

TEST(TerminalText, ColumnsOfWordsAreBroken) {
  TextTable table({"check", "bound", "of"});
  table.addRow({"device/types", "0", "bytes of difference in size"});
  table.addRow({"device/fma", "1e-7", "error of chains"});
  EXPECT_EQ(fitted(table.toString(), 24),
            "check         bound\n"
            "-------------------\n"
            "device/types      0\n"
            "device/fma     1e-7\n"
            "\n"
            "check         of\n"
            "------------------------\n"
            "device/types  bytes of\n"
            "            difference\n"
            "            in size\n"
            "device/fma    error of\n"
            "            chains\n");
}

TEST(TerminalText, LongNamesOfRowsTakeSeveralLines) {
  TextTable table({"case", "ms"});
  table.addRow({"area_cloth/near/original", "1234.5"});
  EXPECT_EQ(fitted(table.toString() + "\n", 20),
            "case              ms\n"
            "--------------------\n"
            "area_cloth/   1234.5\n"
            "near/\n"
            "original\n"
            "\n");
}

TEST(TerminalText, EveryTableFitsAndKeepsEveryFigure) {
  TextTable table({"what is measured", "a", "b", "c", "d", "e", "f"});
  for (int row = 0; row < 20; ++row)
    table.addRow({std::string(static_cast<std::size_t>(row) + 1, 'x'), "1.5", "22222", "3", "-",
                  "5e-05", "6"});
  for (std::size_t columns = 20; columns < 70; ++columns) {
    const std::string text = fitted("said before\n\n" + table.toString() + "\nand after", columns);
    EXPECT_LE(widestLine(text), columns);
    EXPECT_EQ(std::ranges::count(text, '2'), 100) << text;
    EXPECT_GE(std::ranges::count(text, 'x'), 210) << text;
    EXPECT_TRUE(text.ends_with("\nand after")) << text;
  }
}

TEST(TerminalText, ColumnsAreThoseOfTheEnvironmentAwayFromTerminals) {
  if (isatty(STDOUT_FILENO) == 1) GTEST_SKIP() << "the terminal's own count";
  for (const auto& [text, columns] : {std::pair("40", 40),
                                      {"", 100},
                                      {"wide", 100},
                                      {"0", 100},
                                      {"1", 20},
                                      {"99999999999999999999", 100},
                                      {"40x", 100}}) {
    setenv("COLUMNS", text, 1);
    EXPECT_EQ(terminalColumns(), static_cast<std::size_t>(columns)) << text;
  }
  unsetenv("COLUMNS");
  EXPECT_EQ(terminalColumns(), 100u);
}

}  // namespace
}  // namespace glintmark
