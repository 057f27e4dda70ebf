// Tables of linearly transformed cosines: addressing, and files good and bad.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "host/core/error.h"
#include "host/fit/data_folder.h"
#include "host/fit/ltc_table.h"
#include "tests/report/temp_folder.h"

namespace glintmark {
namespace {

using reference::Ndf;

constexpr std::size_t kVersionOffset = 8, kSizeOffset = 16, kHeaderBytes = 32;

// A table whose entries tell where they are: 1000 y + x, plus an eighth per entry.
LtcTable numberedTable(int size) {
  LtcTable table(Ndf::kBeckmann, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double base = 1000.0 * y + x;
      table.setCell(x, y,
                    {base, base + 0.125, base + 0.25, base + 0.375, base + 0.5, base + 0.625,
                     base + 0.75, base + 0.875});
    }
  }
  return table;
}

TEST(LtcTable, CellsLieWhereTheHeaderSays) {
  const LtcTable table = numberedTable(8);
  EXPECT_EQ(table.values.size(), 8u * 8u * 8u);
  EXPECT_EQ(table.values[LTC_CELL(3, 5, 8) + LTC_XX], 5003.0f);
  EXPECT_EQ(table.values[(5 * 8 + 3) * 8 + 4], 5003.5f);
  EXPECT_EQ(table.cell(3, 5).scale, 5003.5);
  EXPECT_EQ(table.cell(3, 5).schlick_albedo, 5003.875);
}

TEST(LtcTable, NodesAreLookedUpExactly) {
  const LtcTable table = numberedTable(16);
  for (const int x : {0, 1, 9, 15}) {
    for (const int y : {0, 4, 14, 15}) {
      const LtcCell cell = lookUpLtc(table, ltcColumnAlpha(x, 16), ltcRowCosine(y, 16));
      EXPECT_NEAR(cell.xx, 1000.0 * y + x, 1e-6);
      EXPECT_NEAR(cell.albedo, 1000.0 * y + x + 0.75, 1e-6);
    }
  }
}

TEST(LtcTable, BilinearBetweenNodesAndClampedOutside) {
  const LtcTable table = numberedTable(8);
  const double root_x = 2.25 / 7, root_y = 4.5 / 7;
  EXPECT_NEAR(lookUpLtc(table, root_x * root_x, 1 - root_y * root_y).xx, 4502.25, 1e-6);
  EXPECT_NEAR(lookUpLtc(table, 2, -0.5).xx, 7007, 1e-6);
  EXPECT_NEAR(lookUpLtc(table, -1, 1.5).xx, 0, 1e-6);
}

TEST(LtcTableFile, RoundTrip) {
  const LtcTable table = numberedTable(9);
  const LtcTable back = parseLtcTable(serializeLtcTable(table), "test");
  EXPECT_EQ(back.ndf, Ndf::kBeckmann);
  EXPECT_EQ(back.size, 9);
  EXPECT_EQ(back.values, table.values);
}

std::string parseMessage(const std::string& bytes) {
  return messageOf<Error>([&] { parseLtcTable(bytes, "some.table"); });
}

TEST(LtcTableFile, SaysWhatIsWrong) {
  const std::string good = serializeLtcTable(numberedTable(8));
  EXPECT_NE(parseMessage("").find("some.table is not an LTC table"), std::string::npos);
  EXPECT_NE(parseMessage("GM-LTC but text follows, not a table").find("is not an LTC table"),
            std::string::npos);
  EXPECT_NE(parseMessage(good.substr(0, 20)).find("is not an LTC table"), std::string::npos);

  EXPECT_NE(parseMessage(good.substr(0, good.size() - 4)).find("has 2076 bytes, expected 2080"),
            std::string::npos);
  EXPECT_NE(parseMessage(good + "x").find("has 2081 bytes, expected 2080"), std::string::npos);

  std::string other = good;
  other[kVersionOffset] = 1;
  EXPECT_NE(parseMessage(other).find("of version 1 with 8 floats per cell, expected version 2"),
            std::string::npos);

  std::string sized = good;
  sized[kSizeOffset] = 5;
  EXPECT_NE(parseMessage(sized).find("size 5 (8 to 128)"), std::string::npos);

  std::string flipped = good;
  flipped[kHeaderBytes + 100] ^= 1;
  EXPECT_NE(parseMessage(flipped).find("checksum does not match"), std::string::npos);
}

TEST(LtcTableFile, RefusesNumbersThatAreNone) {
  LtcTable table = numberedTable(8);
  table.values[17] = NAN;
  EXPECT_NE(parseMessage(serializeLtcTable(table)).find("not a finite number"), std::string::npos);
}

TEST(LtcTableFile, MissingFileIsNamed) {
  const std::string message = messageOf<Error>([] { loadLtcTable("/no/such/place.table"); });
  EXPECT_NE(message.find("/no/such/place.table"), std::string::npos);
  EXPECT_NE(messageOf<Error>([] { loadLtcTable("/"); }).find("no LTC table /"), std::string::npos);
}

TEST(DataFolder, FollowsTheEnvironment) {
  const TempFolder folder;
  ASSERT_EQ(setenv("GLINTMARK_TABLES", folder.path().c_str(), 1), 0);
  const std::string missing = messageOf<Error>([] { shippedLtcTable(Ndf::kGgx); });
  EXPECT_NE(missing.find("ltc_ggx.table; set GLINTMARK_TABLES"), std::string::npos) << missing;

  std::ofstream(folder / "ltc_ggx.table", std::ios::binary) << serializeLtcTable(numberedTable(8));
  const std::string swapped = messageOf<Error>([] { shippedLtcTable(Ndf::kGgx); });
  EXPECT_NE(swapped.find("holds the beckmann distribution, expected ggx"), std::string::npos);
  unsetenv("GLINTMARK_TABLES");
  EXPECT_EQ(shippedLtcTable(Ndf::kGgx).size, LTC_SIZE_DEFAULT);
}

}  // namespace
}  // namespace glintmark
