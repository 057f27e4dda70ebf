// Whole frames: nothing to see, one pixel, and mapped normals by every method.
#include <algorithm>
#include <cmath>
#include <memory>

#include "host/filter/normal_map_generators.h"
#include "host/frame/frame_renderer.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/small_scenes.h"
#include "host/verify/check_frames.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

double insaneValues(const Image& image) {
  return static_cast<double>(std::ranges::count_if(
      image.pixels, [](float value) { return !(std::isfinite(value) && value >= 0); }));
}

// The floor lies out of sight.
Finding emptyFrame(const CheckContext& context) {
  Scene scene = floorScene();
  scene.mesh = TriangleMesh{};
  addFloor(scene, 100, 101, 0);
  const Image image = checkFrame(
      context, scene, lookingDown(90),
      {.width_px = 64, .height_px = 48, .lanes = context.lanes, .may_show_nothing = true});
  Finding finding(0);
  finding.require(image.width == 64 && image.height == 48, "the picture has another size");
  for (const float value : image.pixels) finding.add(std::abs(value));
  return finding;
}

// One pixel of glints is what the same pixel is in a frame of one row.
Finding onePixel(const CheckContext& context) {
  const Scene scene = floorScene();
  const Image image = checkFrame(context, scene, lookingDown(45),
                                 {.width_px = 1, .height_px = 1, .lanes = context.lanes});
  const Image narrow =
      checkFrame(context, scene, lookingDown(45), {.width_px = 1, .height_px = 1, .lanes = 1});
  Finding finding(0);
  finding.add(insaneValues(image));
  finding.require(image.pixels.size() == 4 && image.pixels[3] == 1, "the pixel is not covered");
  finding.require(image.pixels == narrow.pixels, "lanes differ from one lane");
  return finding;
}

// One texel, a strip, an odd size, and normals that all but lie in the surface.
std::vector<NormalMap> hardMaps() {
  const auto bumps = [](int size_px) {
    return generateNormalMap({.kind = "bumps", .size_px = size_px, .seed = 3});
  };
  NormalMap strip = bumps(16), steep = bumps(16);
  strip.height_px = 1;
  strip.normals.resize(16);
  for (std::size_t i = 0; i < steep.normals.size(); ++i)
    steep.normals[i] = glm::normalize(glm::vec3(i % 2 == 0 ? 1 : -1, i % 3 == 0 ? 1 : 0, 1e-3f));
  return {bumps(1), strip, bumps(37), steep, generateNormalMap({"flat", 4})};
}

struct NamedMethod {
  const char* name;
  NormalMethod method;
};
constexpr NamedMethod kMethods[] = {
    {"mip", NormalMethod::kMip},           {"fixed", NormalMethod::kFixed},
    {"toksvig", NormalMethod::kToksvig},   {"lean", NormalMethod::kLean},
    {"fournier", NormalMethod::kFournier}, {"gmm", NormalMethod::kGmm},
    {"leadr", NormalMethod::kLeadr}};

// Near and far, at 8 degrees: every value is a radiance, and one lane gives the same bits.
Finding mappedNormals(const CheckContext& context, NormalMethod method) {
  double bad = 0, different = 0;
  for (const NormalMap& map : hardMaps()) {
    const Scene scene = mappedFloor(map);
    const auto textures = std::make_shared<NormalTextures>(context.bench.device);
    for (const double distance : {0.5, 6.0}) {
      const View view = lookingDown(8, distance);
      ShadingOptions options{.width_px = 48, .height_px = 48, .lanes = context.lanes};
      options.normal_method = method;
      const Image wide = checkFrame(context, scene, view, options, textures);
      options.lanes = 1;
      const Image one = checkFrame(context, scene, view, options, textures);
      bad += insaneValues(wide);
      for (std::size_t i = 0; i < wide.pixels.size(); ++i)
        different += wide.pixels[i] != one.pixels[i];
    }
  }
  Finding finding(0);
  finding.add(bad + different);
  finding.require(bad == 0, "values are NaN, infinite or negative");
  return finding;
}

}  // namespace

std::vector<Check> frameChecks() {
  std::vector<Check> checks = {{"frame/empty", "radiance of nothing", emptyFrame},
                               {"frame/one_pixel", "values NaN, infinite or negative", onePixel}};
  for (const NamedMethod& m : kMethods)
    checks.push_back({std::string("normal_map/") + m.name + "_same_bits",
                      "values no radiance, or not one lane's", [&m](const CheckContext& context) {
                        return mappedNormals(context, m.method);
                      }});
  return checks;
}

}  // namespace glintmark
