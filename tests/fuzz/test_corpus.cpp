// The fuzzers' corpus, replayed without a fuzzer: inputs by hand, and those that once found a
// fault.
#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>

#include "fuzz/entries.h"
#include "host/core/atomic_file.h"

namespace glintmark {

namespace fuzz {

static void PrintTo(const Entry& entry, std::ostream* out) {
  *out << entry.name;
}

}  // namespace fuzz

namespace {

class Corpus : public testing::TestWithParam<fuzz::Entry> {};

TEST_P(Corpus, EveryInputIsReadOrRefused) {
  const std::filesystem::path folder =
      std::filesystem::path(GLINTMARK_SOURCE_DIR) / "tests/corpus" / GetParam().name;
  int inputs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path());
    const std::string bytes = readFile(entry.path());
    EXPECT_NO_THROW(GetParam().run(bytes)) << entry.path();
    // The first half, as a file that was cut off.
    EXPECT_NO_THROW(GetParam().run(std::string_view(bytes).substr(0, bytes.size() / 2)));
    ++inputs;
  }
  EXPECT_GT(inputs, 2);
}

INSTANTIATE_TEST_SUITE_P(Readers, Corpus, testing::ValuesIn(fuzz::entries()),
                         [](const auto& parameter) { return parameter.param.name; });

}  // namespace
}  // namespace glintmark
