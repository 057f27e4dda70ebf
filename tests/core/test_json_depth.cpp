// Brackets in brackets are counted before a parser meets them.
#include "host/core/json_depth.h"

#include <gtest/gtest.h>

#include "host/core/error.h"

namespace glintmark {
namespace {

std::string nested(const std::string& open, const std::string& close, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += open;
  for (int i = 0; i < times; ++i) text += close;
  return text;
}

TEST(JsonDepth, CountsOpenBracketsOutsideOfStrings) {
  EXPECT_NO_THROW(checkJsonDepth(nested("[", "]", kMostJsonDepth), "a.json"));
  EXPECT_THROW(checkJsonDepth(nested("[", "]", kMostJsonDepth + 1), "a.json"), Error);
  EXPECT_THROW(checkJsonDepth(nested("{\"a\":[", "]}", kMostJsonDepth), "a.json"), Error);
  EXPECT_NO_THROW(checkJsonDepth("\"" + nested("[", "\\\"", 1000) + "\"", "a.json"));
  // Those that are closed again do not add up; what is cut off is left to the parser.
  std::string flat = "[";
  for (int i = 0; i < 1000; ++i) flat += "[],";
  EXPECT_NO_THROW(checkJsonDepth(flat + "[]]", "a.json"));
  EXPECT_NO_THROW(checkJsonDepth("\"abc\\", "a.json"));
  EXPECT_NO_THROW(checkJsonDepth("]]]][", "a.json"));
}

TEST(JsonDepth, NamesTheFile) {
  try {
    checkJsonDepth(nested("[", "", 1000000), "a.json");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "a.json: has more brackets in brackets than the 256 that are read");
  }
}

}  // namespace
}  // namespace glintmark
