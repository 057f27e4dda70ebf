// export: what is written for Mitsuba 3, which no test needs.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <glm/glm.hpp>
#include <numbers>
#include <sstream>
#include <utility>

#include "host/core/atomic_file.h"
#include "host/report/picture/image_io.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

// Every element is closed, in order; "" or what is wrong.
std::string xmlComplaint(const std::string& text) {
  std::vector<std::string> open;
  std::size_t at = text.find("?>");
  if (at == std::string::npos) return "no declaration";
  while ((at = text.find('<', at)) != std::string::npos) {
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) return "a tag without end";
    const std::string tag = text.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(0, tag.find_first_of(" /"));
    if (std::ranges::count(tag, '"') % 2 != 0) return "quotes of <" + tag;
    if (tag.starts_with('/')) {
      if (open.empty() || "/" + open.back() != tag) return "unexpected <" + tag;
      open.pop_back();
    } else if (!tag.ends_with('/')) {
      open.push_back(name);
    }
    at = end;
  }
  return open.empty() ? "" : "never closed: " + open.back();
}

// The three numbers behind `start`, up to the next quote.
std::array<double, 3> numbersAfter(const std::string& text, const std::string& start) {
  std::array<double, 3> numbers{};
  const std::size_t at = text.find(start);
  EXPECT_NE(at, std::string::npos) << start;
  if (at == std::string::npos) return numbers;
  std::istringstream stream(text.substr(at + start.size()));
  char comma = 0;
  stream >> numbers[0] >> comma >> numbers[1] >> comma >> numbers[2];
  return numbers;
}

// A PLY file's header, and its vertices as floats.
struct Ply {
  std::string header;
  std::vector<float> values;
};
Ply readPly(const std::string& path, std::size_t floats_per_vertex) {
  const std::string bytes = readFile(path);
  const std::size_t body = bytes.find("end_header\n") + 11;
  Ply ply{bytes.substr(0, body), {}};
  const std::size_t at = ply.header.find("element vertex ");
  const auto count = static_cast<std::size_t>(std::stoul(ply.header.substr(at + 15)));
  ply.values.resize(count * floats_per_vertex);
  EXPECT_GE(bytes.size(), body + 4 * ply.values.size());
  std::memcpy(ply.values.data(), bytes.data() + body, 4 * ply.values.size());
  return ply;
}

std::string exported(const TempFolder& folder, std::vector<std::string> arguments,
                     std::string* notes = nullptr) {
  arguments.insert(arguments.begin(), "export");
  arguments.insert(arguments.end(), {"-o", folder / "e"});
  const ProcessResult result = runGlintmark(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  if (notes != nullptr) *notes = result.err;
  const std::string xml = readFile(folder / "e/scene.xml");
  EXPECT_EQ(xmlComplaint(xml), "") << xml;
  return xml;
}

TEST(Export, AreaLightsAndAMap) {
  const TempFolder folder;
  std::string notes;
  const std::string xml = exported(folder,
                                   {"area_cloth", "--view", "far", "--size", "160x90", "--set",
                                    "material.cloth.normal_map.size_px=16"},
                                   &notes);
  EXPECT_NE(xml.find("<integer name=\"width\" value=\"160\"/>"), std::string::npos);
  EXPECT_NE(xml.find("<float name=\"fov\" value=\"30\"/>"), std::string::npos);
  EXPECT_NE(xml.find("<boolean name=\"flip_invalid_normals\" value=\"false\"/>"),
            std::string::npos);
  EXPECT_NE(xml.find("<boolean name=\"use_shadowing_function\" value=\"false\"/>"),
            std::string::npos);
  EXPECT_NEAR(numbersAfter(xml, "origin=\"")[1], 24 * std::sin(25 * std::numbers::pi / 180), 1e-9);
  // One lobe: nothing is shared out. An index of (1 + sqrt f0) / (1 - sqrt f0).
  EXPECT_EQ(countOf(xml, "blendbsdf"), 0u);
  EXPECT_EQ(numbersAfter(xml, "name=\"radiance\" value=\""), (std::array{4.0, 3.8, 3.4}));
  EXPECT_NEAR(numbersAfter(xml, "name=\"eta\" value=\"")[0],
              (1 + std::sqrt(0.95)) / (1 - std::sqrt(0.95)), 1e-3);
  // The wall, and both sides of the sign.
  EXPECT_EQ(countOf(xml, "<emitter type=\"area\">"), 3u);
  EXPECT_NE(readPly(folder / "e/light_1_back.ply", 3).header.find("element face 3"),
            std::string::npos);
  const Ply mesh = readPly(folder / "e/mesh_0.ply", 8);
  EXPECT_NE(mesh.header.find("element vertex 4"), std::string::npos) << mesh.header;
  EXPECT_EQ(*std::ranges::max_element(mesh.values), 24.0f) << "uv, twice the side of 12";
  const Image map = readImage(folder / "e/normals_0.exr");
  EXPECT_EQ(map.width, 16);
  for (std::size_t i = 0; i < map.pixels.size(); i += 3) {
    double squares = 0;
    for (std::size_t c = 0; c < 3; ++c) squares += std::pow(2 * map.pixels[i + c] - 1, 2);
    EXPECT_NEAR(squares, 1, 1e-5);
  }
  EXPECT_NE(notes.find("note: material cloth: masking and shadowing are independent"),
            std::string::npos)
      << notes;
  const std::string readme = readFile(folder / "e/README.md");
  EXPECT_NE(readme.find("- meshes throw shadows, here they throw none."), std::string::npos);
}

TEST(Export, TwoLobesAreHalvedAndPointsDoubled) {
  const TempFolder folder;
  const std::string xml =
      exported(folder, {"disk", "--quiet", "--set", "material.silver.normal_map.size_px=8"});
  EXPECT_EQ(countOf(xml, "<emitter type=\"directional\">"), 4u);
  EXPECT_EQ(countOf(xml, "<bsdf type=\"blendbsdf\">"), 1u);
  EXPECT_NEAR(numbersAfter(xml, "name=\"irradiance\" value=\"")[0], 2 * 1.2, 1e-6);
  EXPECT_NEAR(numbersAfter(xml, "name=\"reflectance\" value=\"")[0], 0.06, 1e-6);
  EXPECT_EQ(numbersAfter(xml, "name=\"specular_reflectance\" value=\"")[0], 1);
}

TEST(Export, ConesAreCapsOfTheSameIrradiance) {
  const TempFolder folder;
  const std::string xml =
      exported(folder, {"snow", "--quiet", "--set", "light.sun.half_angle_deg=20", "--set",
                        "light.sun.irradiance=3", "--set", "light.sun.elevation_deg=90"});
  const double sine = std::sin(20 * std::numbers::pi / 180);
  const double share = countOf(xml, "blendbsdf") > 0 ? 2 : 1;
  EXPECT_NEAR(numbersAfter(xml, "name=\"radiance\" value=\"")[1],
              share * 3 / (std::numbers::pi * sine * sine), 1e-4);
  const Ply cap = readPly(folder / "e/cone_0.ply", 3);
  const std::size_t vertices = cap.values.size() / 3;
  glm::dvec3 low(1e30), high(-1e30);
  for (std::size_t i = 0; i < vertices; ++i)
    for (int c = 0; c < 3; ++c) {
      const double value = cap.values[3 * i + static_cast<std::size_t>(c)];
      low[c] = std::min(low[c], value);
      high[c] = std::max(high[c], value);
    }
  // Height over radius of a cap of 20 degrees.
  EXPECT_NEAR((high.y - low.y) / (high.x - low.x), (1 - std::cos(0.349066)) / (2 * sine), 1e-3);
  EXPECT_NE(readFile(folder / "e/README.md").find("cones of light are"), std::string::npos);
}

// The knot's charts are mirrored: so is the map.
TEST(Export, MirroredChartsMirrorTheMap) {
  const TempFolder folder;
  const std::string small = "material.gold.normal_map.size_px=8";
  const std::string xml = exported(folder, {"armour", "--quiet", "--set", small});
  EXPECT_EQ(countOf(xml, "<ref id=\"material_0_mirrored\"/>"), 1u);
  EXPECT_EQ(countOf(xml, "<ref id=\"material_0\"/>"), 0u);
  const Image mirrored = readImage(folder / "e/normals_0_mirrored.exr");
  exported(folder, {"disk", "--quiet", "--set", "material.silver.normal_map.size_px=8", "--set",
                    "material.silver.normal_map.generator=armour"});
  const Image map = readImage(folder / "e/normals_0.exr");
  ASSERT_EQ(map.pixels.size(), mirrored.pixels.size());
  for (std::size_t i = 0; i < map.pixels.size(); ++i)
    EXPECT_NEAR(i % 3 == 1 ? 1 - map.pixels[i] : map.pixels[i], mirrored.pixels[i], 1e-6);
}

TEST(Export, PicturesOfLightsCarryTheirRadiance) {
  const TempFolder folder;
  const std::string xml = exported(folder, {"area_glass", "--quiet"});
  EXPECT_GE(countOf(xml, "<texture name=\"radiance\" type=\"bitmap\">"), 1u);
  EXPECT_TRUE(std::filesystem::exists(folder / "e/picture_0.exr"));
  const Ply light = readPly(folder / "e/light_0.ply", 5);
  EXPECT_EQ(light.values.size(), 20u);
  EXPECT_EQ(light.values[4], 1) << "the first vertex is the picture's lower left corner";
}

TEST(Export, DiscsSpheresAndTubes) {
  const TempFolder folder;
  const std::string xml =
      exported(folder, {"area_shapes", "--quiet", "--set", "material.floor.normal_map.size_px=8"});
  // Both sides of the disc, and the ends of the tube.
  EXPECT_EQ(countOf(xml, "<shape type=\"disk\">"), 4u);
  EXPECT_EQ(countOf(xml, "<shape type=\"sphere\">"), 1u);
  EXPECT_EQ(countOf(xml, "<shape type=\"cylinder\">"), 1u);
  EXPECT_EQ(countOf(xml, "<emitter type=\"area\">"), 6u);
  EXPECT_NE(xml.find("<point name=\"p1\" x=\"2.3\" y=\"1.3\" z=\"-2.2\"/>"), std::string::npos);
  // The disc's matrix: two radii, its normal as long, its centre.
  const std::string start = "<matrix value=\"";
  std::istringstream numbers(xml.substr(xml.find(start) + start.size()));
  double m[4][4];
  for (auto& row : m)
    for (double& value : row) numbers >> value;
  const glm::dvec3 u(m[0][0], m[1][0], m[2][0]), v(m[0][1], m[1][1], m[2][1]),
      n(m[0][2], m[1][2], m[2][2]);
  EXPECT_LT(glm::distance(glm::cross(u, v), 0.7 * n), 1e-9);
  EXPECT_LT(glm::distance(n, 0.7 * glm::normalize(glm::dvec3(0.3, -0.1, 1))), 1e-9);
  EXPECT_EQ(m[0][3], -1.5);
}

TEST(Export, WhatIsWrongIsOneSentence) {
  const TempFolder folder;
  writeFile(folder / "file", "x");
  const std::pair<std::vector<std::string>, std::string> cases[] = {
      {{"export", "area_cloth", "-o", folder / "file/e"}, "file"},
      {{"export", "area_cloth", "-o", folder / "e", "--view", "nowhere"}, "nowhere"},
      {{"export", "no_such_scene", "-o", folder / "e"}, "no_such_scene"},
      {{"export", "area_cloth", "-o", folder / "e", "--size", "0x9"}, "0x9"},
      {{"export", "area_cloth"}, "--output"},
  };
  for (const auto& [arguments, named] : cases) {
    const ProcessResult result = runGlintmark(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(named), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "e"));
}

}  // namespace
}  // namespace glintmark
