#include "host/report/picture/aov.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/core/error.h"
#include "host/core/frame_packing.h"
#include "host/core/shared_types.h"

namespace glintmark {
namespace {

constexpr std::size_t kSecond = GM_LIST_PADDING;  // where the second list starts

// Two lists: material 2 covers pixel (1, 0), material 5 covers pixel (0, 1).
void fillSample(PixelPlanes& planes, PlaneMask mask) {
  planes.width_px = 2;
  planes.height_px = 2;
  planes.mask = mask;
  planes.stride = 2 * GM_LIST_PADDING;
  planes.storage.reserve(planes.stride * mask.size());
  std::fill_n(planes.storage.data(), planes.stride * mask.size(), 0u);
  planes.lists = {{2, 0, 1}, {5, GM_LIST_PADDING, 1}};
  planes.covered_px = 2;
}

int channel(const Image& image, const std::string& name) {
  const auto found = std::ranges::find(image.channel_names, name);
  EXPECT_NE(found, image.channel_names.end()) << name;
  return static_cast<int>(found - image.channel_names.begin());
}

TEST(Aov, ScattersEveryPlaneToItsPixel) {
  PixelPlanes planes;
  fillSample(planes, PlaneMask::all());
  planes.plane(Plane::kPixel)[0] = 0 << 16 | 1;
  planes.plane(Plane::kPixel)[kSecond] = 1 << 16 | 0;
  planes.plane<std::int32_t>(Plane::kUInt)[0] = -7;
  planes.plane(Plane::kUFrac)[0] = 0x80000000u;
  planes.plane<float>(Plane::kDvdy)[kSecond] = 0.25f;
  planes.plane<float>(Plane::kDepth)[0] = 12.5f;
  const PackedFrame frame = packFrame({0, 1, 0}, {1, 0, 0}, false);
  planes.plane(Plane::kFrame0)[kSecond] = frame.frame0;
  planes.plane(Plane::kFrame1)[kSecond] = frame.frame1;

  const Image image = planesToImage(planes);
  EXPECT_EQ(image.channel_names.size(), static_cast<std::size_t>(image.channels));
  EXPECT_EQ(image.at(1, 0)[channel(image, "material")], 2);
  EXPECT_EQ(image.at(0, 1)[channel(image, "material")], 5);
  EXPECT_EQ(image.at(0, 0)[channel(image, "material")], -1);
  EXPECT_EQ(image.at(1, 1)[channel(image, "material")], -1);
  EXPECT_EQ(image.at(1, 0)[channel(image, "u.int")], -7);
  EXPECT_EQ(image.at(1, 0)[channel(image, "u.frac")], 0.5f);
  EXPECT_EQ(image.at(1, 0)[channel(image, "uv.X")], -6.5f);
  EXPECT_EQ(image.at(1, 0)[channel(image, "Z")], 12.5f);
  EXPECT_EQ(image.at(0, 1)[channel(image, "dvdy")], 0.25f);
  EXPECT_EQ(image.at(1, 0)[channel(image, "dvdy")], 0);
  EXPECT_NEAR(image.at(0, 1)[channel(image, "N.Y")], 1, 1e-6);
  EXPECT_NEAR(image.at(0, 1)[channel(image, "T.X")], 1, 1e-5);
}

TEST(Aov, OnlyThePlanesThereAre) {
  PixelPlanes planes;
  fillSample(planes, {Plane::kPixel, Plane::kDepth});
  const Image image = planesToImage(planes);
  EXPECT_EQ(image.channel_names, (std::vector<std::string>{"material", "Z"}));
}

TEST(Aov, RowsAreThoseOfTheWhole) {
  PixelPlanes planes;
  fillSample(planes, PlaneMask::all());
  planes.plane(Plane::kPixel)[0] = 0 << 16 | 1;
  planes.plane(Plane::kPixel)[kSecond] = 1 << 16 | 0;
  planes.plane<float>(Plane::kDepth)[kSecond] = 12.5f;
  const Image whole = planesToImage(planes);
  const PlaneRows rows(planes);
  for (int y = 0; y < 2; ++y) {
    const Image row = rows.read(y, 1);
    EXPECT_EQ(row.channel_names, whole.channel_names);
    ASSERT_EQ(row.height, 1);
    for (int x = 0; x < 2; ++x)
      EXPECT_TRUE(std::ranges::equal(row.at(x, 0), whole.at(x, y))) << x << ' ' << y;
  }
}

TEST(Aov, PlanesWithoutPixelPositionsAreAnError) {
  PixelPlanes planes;
  fillSample(planes, {Plane::kDepth});
  EXPECT_THROW(planesToImage(planes), Error);
}

}  // namespace
}  // namespace glintmark
