// What is printed keeps to the terminal's columns; what is written to files does not know them.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "host/core/atomic_file.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/terminal_text.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

const std::string kRuns = GLINTMARK_SOURCE_DIR "/results/";

// Lines of more than one word that are wider.
std::string tooWide(const std::string& text, std::size_t columns) {
  std::istringstream lines(text);
  std::string wide;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    if (columnsOf(line) > columns && line.find(' ', begin) != std::string::npos)
      wide += line + '\n';
  }
  return wide;
}

TEST(Columns, AreKeptByEveryTable) {
  const TempFolder folder;
  writeExr(Image(8, 8, 3), folder / "a_picture_with_a_long_name.exr");
  const std::string picture = folder / "a_picture_with_a_long_name.exr";
  const std::string run = kRuns + "pocl-3.1-xeon-avx512-2-cores/2026-11-30/results.json";
  const std::string other = kRuns + "nvidia-h200/2026-11-26/results.json";
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"info"},
           {"diff", picture, picture},
           {"simulate", "--rays", "1e4"},
           {"compare", "--across-devices", "--all", run, other},
           {"compare", "--across-devices", "--all", run, other, run},
           {"verify", "--only", "^device/"},
           {"fit", "ltc", "--size", "8"},
           {"heatmap", "screen_plane", "--size", "64x36"}}) {
    for (const std::size_t columns : {40, 72}) {
      const ProcessResult result = runGlintmark(words, {"COLUMNS=" + std::to_string(columns)});
      EXPECT_LE(result.exit_code, 1) << result.err;
      EXPECT_EQ(tooWide(result.out, columns), "") << words[0] << " at " << columns;
    }
    EXPECT_EQ(tooWide(runGlintmark(words, {"COLUMNS="}).out, 100), "") << words[0];
  }
}

TEST(Columns, AreNoneOfFiles) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark({"bench", "zk16", "--scene", "screen_plane", "--view", "steep", "--size",
                    "64x36", "--reps", "1", "-o", folder.path()},
                   {"COLUMNS=40"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(tooWide(result.out, 40), "");
  const std::string table = readFile(folder / "table.txt");
  EXPECT_NE(tooWide(table, 80), "") << table;
  EXPECT_EQ(tooWide(table, 100), "");
  EXPECT_NE(table, result.out);
}

}  // namespace
}  // namespace glintmark
