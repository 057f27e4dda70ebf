#include "host/report/record/case_name.h"

#include <gtest/gtest.h>

#include "host/core/error.h"

namespace glintmark {
namespace {

TEST(CaseName, ReadsWhatItWrites) {
  for (const char* text :
       {"all", "snow/steep", "area_glass/middle/exact/roughness=0.03", "disk/near_8/gmm",
        "energy/alpha=0.24/theta=60", "glints+normals", "gmm/method=toksvig", "msbrdf/rays=1e5",
        "a/b=c=d", "", "/", "a//b", "x=", "=y", "a <b> & \"c\""})
    EXPECT_EQ(CaseName::parse(text).text(), text);
}

TEST(CaseName, PartsByPlaceAndByName) {
  const CaseName name = CaseName::parse("area_glass/middle/exact/roughness=0.03/lights=4");
  EXPECT_EQ(name.word(0), "area_glass");
  EXPECT_EQ(name.word(2), "exact");
  EXPECT_EQ(name.word(3), "");
  EXPECT_EQ(name.value("roughness"), "0.03");
  EXPECT_EQ(name.value("vertices"), std::nullopt);
  EXPECT_EQ(name.number("lights"), 4);
  EXPECT_EQ(name.rest().text(), "middle/exact/roughness=0.03/lights=4");
  EXPECT_EQ(CaseName::parse("ka=16").rest().text(), "ka=16");
}

TEST(CaseName, WritesKnobsAsTheyAreGiven) {
  const CaseName name{{"surface"}, {{"alpha", 0.24}, {"theta", 60}, {"method", "exact"}}};
  EXPECT_EQ(name.text(), "surface/alpha=0.24/theta=60/method=exact");
  EXPECT_EQ(name.fileStem(), "surface_alpha_0.24_theta_60_method_exact");
  EXPECT_EQ(CaseName::parse(name.text()), name);
  EXPECT_EQ((CaseName{{"x"}, {{"alpha", 1.0}}}.text()), "x/alpha=1");
}

TEST(CaseName, NumbersThatAreNoneAreErrors) {
  const CaseName name = CaseName::parse("gmm/method=toksvig/lobes=4x/texels=");
  EXPECT_THROW(name.number("method"), Error);
  EXPECT_THROW(name.number("lobes"), Error);
  EXPECT_THROW(name.number("texels"), Error);
  EXPECT_THROW(name.number("probes"), Error);
  EXPECT_EQ(numberOf("1e5"), 1e5);
  EXPECT_EQ(numberOf(""), std::nullopt);
}

}  // namespace
}  // namespace glintmark
