// What drivers say, as it is shown: one line, in UTF-8, of a length that tables bear.
#include <gtest/gtest.h>

#include "host/ocl/driver_text.h"

namespace glintmark {
namespace {

TEST(DriverText, LosesPaddingAndWhatStandsBehindItsEnd) {
  EXPECT_EQ(shownText("  a name \t\n"), "a name");
  EXPECT_EQ(shownText(std::string_view("first\0second", 12)), "first");
  EXPECT_EQ(shownText(std::string_view(" \0", 2)), "");
  EXPECT_EQ(shownText(""), "");
}

TEST(DriverText, IsOneLineWithoutControlCharacters) {
  EXPECT_EQ(shownText("one\ntwo\r\tthree"), "one two  three");
  EXPECT_EQ(shownText("\x1b[31mred\x7f"), "?[31mred?");
}

// The ends of the ranges that Unicode calls well-formed, and what lies just outside of them.
TEST(DriverText, KeepsUtf8AndNothingElse) {
  for (const char* good : {"caf\u00e9", "\u00a0x", "\u07ff", "\u0800", "\ud7ff", "\ue000", "\uffff",
                           "\U00010000", "\U0010ffff"})
    EXPECT_EQ(shownText(good), good);
  EXPECT_EQ(shownText("caf\xe9"), "caf?");
  EXPECT_EQ(shownText("\xc1\x80"), "??");            // too long for what it says
  EXPECT_EQ(shownText("\xc2\x85"), "??");            // a control character
  EXPECT_EQ(shownText("\xe0\x80\x80"), "???");       // too long
  EXPECT_EQ(shownText("\xed\xa0\x80"), "???");       // half of a surrogate pair
  EXPECT_EQ(shownText("\xf4\x90\x80\x80"), "????");  // beyond the last code point
  EXPECT_EQ(shownText("\xe2\x82"), "??");            // cut off
}

TEST(DriverText, IsCutBetweenCharacters) {
  EXPECT_EQ(shownText("abcdef", 4), "abcd...");
  EXPECT_EQ(shownText("abcd", 4), "abcd");
  EXPECT_EQ(shownText("abc\u00e9", 4), "abc...");
}

}  // namespace
}  // namespace glintmark
