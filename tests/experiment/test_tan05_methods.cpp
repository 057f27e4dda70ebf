// Methods of table tan05 that a scene's lobes are too many for.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "host/experiment/session.h"
#include "host/experiment/tan05/tan05_view.h"

namespace glintmark {
namespace {

bool offersAnisotropic(const std::vector<std::string>& overrides) {
  CommonOptions common;
  common.quiet = true;
  common.overrides = overrides;
  const std::vector<Tan05Method> methods = tan05MethodsOf(openScene(common, "disk"));
  const bool offers = std::ranges::any_of(methods, [](const Tan05Method& method) {
    return method.method == NormalMethod::kAnisotropic;
  });
  EXPECT_EQ(methods.size() + (offers ? 0 : 1), tan05Methods().size());
  return offers;
}

TEST(Tan05Methods, AreThoseThatTakeTheScenesLobes) {
  EXPECT_TRUE(offersAnisotropic({}));
  EXPECT_TRUE(offersAnisotropic({"material.silver.normal_map.lobes=5"}));
  EXPECT_FALSE(offersAnisotropic({"material.silver.normal_map.lobes=6"}));
  EXPECT_FALSE(offersAnisotropic({"material.silver.normal_map.lobes=8"}));
}

}  // namespace
}  // namespace glintmark
