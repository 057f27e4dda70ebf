// What is said of names that there are not.
#include "host/core/unknown_name.h"

#include <gtest/gtest.h>

#include <vector>

#include "host/core/error.h"

namespace glintmark {
namespace {

const std::vector<std::string> kMethods = {"zk16", "exact", "distributed"};

TEST(UnknownName, SaysWhichThereAre) {
  EXPECT_EQ(unknownName("method", "mip", kMethods),
            "unknown method 'mip'; methods are zk16, exact, distributed");
  EXPECT_EQ(unknownName("axis", "width", std::vector<std::string>{"lanes"}, "axes"),
            "unknown axis 'width'; axes are lanes");
  EXPECT_EQ(unknownName("view", "front", {}, "views of scene x"),
            "unknown view 'front'; there are no views of scene x");
}

TEST(UnknownName, GuessesWhatWasMeant) {
  const auto guess = [](const std::string& name) {
    const std::string text = unknownName("method", name, kMethods);
    const std::size_t at = text.find("; did you mean ");
    return at == std::string::npos ? "" : text.substr(at + 15);
  };
  EXPECT_EQ(guess("zk61"), "zk16?");               // two letters swapped
  EXPECT_EQ(guess("exakt"), "exact?");             // another letter
  EXPECT_EQ(guess("distribted"), "distributed?");  // one left out
  EXPECT_EQ(guess("dist"), "distributed?");        // how it begins
  EXPECT_EQ(guess("kemppinen"), "");
  EXPECT_EQ(guess(""), "");
  EXPECT_EQ(guess("di"), "");
}

TEST(UnknownName, KnownNamesPass) {
  EXPECT_NO_THROW(requireKnownName("method", "exact", kMethods));
  EXPECT_THROW(requireKnownName("method", "Exact", kMethods), Error);
}

}  // namespace
}  // namespace glintmark
