// Every bit of the shipped data counts: one that is wrong is refused, whichever it is.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/fit/anisotropic_table.h"
#include "host/fit/data_folder.h"
#include "host/fit/ltc_table.h"
#include "host/fit/multiscatter_data.h"
#include "tests/damaged_bytes.h"
#include "tests/report/temp_folder.h"

namespace glintmark {
namespace {

constexpr std::size_t kHead_bytes = 40;

template <class Parse>
void expectRefused(const std::string& file, const Parse& parse) {
  const std::string good = readFile(findDataFile(file));
  ASSERT_NO_THROW(parse(good));
  int flips = 0;
  withEachBitFlipped(good, kHead_bytes, good.size() / 300,
                     [&](const std::string& damaged, const std::string& place) {
                       ++flips;
                       try {
                         parse(damaged);
                         FAIL() << file << " at " << place << " was read";
                       } catch (const Error& error) {
                         const std::string what = error.what();
                         EXPECT_EQ(what.rfind("some.table", 0), 0u) << what;
                         EXPECT_NE(what.find("fit "), std::string::npos) << what;
                       }
                     });
  EXPECT_GT(flips, 600);
}

TEST(DamagedData, TablesOfCosinesAreRefused) {
  for (const char* file : {"ltc_ggx.table", "ltc_beckmann.table", "ltc_normals.table"})
    expectRefused(file, [](const std::string& bytes) { parseLtcTable(bytes, "some.table"); });
  for (const char* file : {"ltc_anisotropic_ggx.table", "ltc_anisotropic_beckmann.table"})
    expectRefused(file,
                  [](const std::string& bytes) { parseAnisotropicTable(bytes, "some.table"); });
}

// Spaces may become other spaces, which changes nothing.
TEST(DamagedData, LobesOfMultipleScatteringAreRefusedOrTheSame) {
  const std::filesystem::path path = findDataFile("multiscatter.json");
  const std::string good = readFile(path), same = toJson(readMultiscatterData(path));
  EXPECT_EQ(good, same);
  const TempFolder folder;
  int refused = 0;
  withEachBitFlipped(good, 8, good.size() / 200,
                     [&](const std::string& damaged, const std::string& place) {
                       const std::filesystem::path file = folder / "some.json";
                       writeFile(file, damaged);
                       try {
                         EXPECT_EQ(toJson(readMultiscatterData(file)), same) << place;
                       } catch (const Error& error) {
                         EXPECT_NE(std::string(error.what()).find("some.json"), std::string::npos);
                         ++refused;
                       }
                     });
  EXPECT_GT(refused, 150);
}

}  // namespace
}  // namespace glintmark
