// STL files: binary and text, what is one vertex, and what is refused.
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "host/scene/import_mesh.h"
#include "tests/scene/scene_test_tools.h"

namespace glintmark {
namespace {

using Facet = std::array<glm::vec3, 3>;

/// With normals that are none: they do not count.
std::string binary(const std::vector<Facet>& facets, std::uint32_t count, std::string head = "") {
  head.resize(80, ' ');
  const auto append = [&](const auto& value) {
    head.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(count);
  for (const Facet& facet : facets) {
    append(glm::vec3(7, 7, NAN));
    for (const glm::vec3& corner : facet) append(corner);
    append(std::uint16_t{0xABCD});
  }
  return head;
}

std::string binary(const std::vector<Facet>& facets, const std::string& head = "") {
  return binary(facets, static_cast<std::uint32_t>(facets.size()), head);
}

std::string text(const std::vector<Facet>& facets, const std::string& name) {
  std::string out = "solid " + name + "\n";
  for (const Facet& facet : facets) {
    out += "  facet normal 0 0 0\n    outer loop\n";
    for (const glm::vec3& v : facet)
      out += "      vertex " + std::to_string(v.x) + " " + std::to_string(v.y) + "\t" +
             std::to_string(v.z) + "\n";
    out += "    endloop\n  endfacet\n";
  }
  return out + "endsolid " + name + "\n";
}

PartMesh stl(const std::string& content) {
  const TemporaryFolder folder;
  return importMesh(folder.write("mesh.stl", content));
}

std::string stlError(const std::string& content) {
  const TemporaryFolder folder;
  const std::string file = folder.write("mesh.stl", content);
  return errorOf([&] { importMesh(file); });
}

const std::vector<Facet> kSquareFacets = {{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}},
                                          {{{0, 0, 0}, {1, 1, 0}, {0, 1, -0.0f}}}};

/// A strip of two squares that meet at an angle along the y axis.
std::vector<Facet> roof(double angle_deg) {
  const double a = angle_deg * std::numbers::pi / 180;
  const glm::vec3 far(std::cos(a), 0, -std::sin(a)), up(0, 1, 0);
  const glm::vec3 left(-1, 0, 0), ridge(0, 0, 0);
  return {{{left, ridge, ridge + up}},
          {{left, ridge + up, left + up}},
          {{ridge, far, far + up}},
          {{ridge, far + up, ridge + up}}};
}

TEST(Stl, BinaryAndTextAreTheSameMesh) {
  for (const std::string& content :
       {binary(kSquareFacets), binary(kSquareFacets, "solid that is none"),
        text(kSquareFacets, "a square"), "\xEF\xBB\xBF" + text(kSquareFacets, ""),
        binary(kSquareFacets) + "what some programs append"}) {
    const TriangleMesh mesh = stl(content).mesh;
    ASSERT_EQ(mesh.triangleCount(), 2u);
    ASSERT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[2], glm::vec3(1, 1, 0));
    EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 2, 3));
    for (const glm::vec3& normal : mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
  }
}

TEST(Stl, EdgesStayWhereTrianglesMeetAtMoreThanTheCrease) {
  EXPECT_EQ(stl(binary(roof(29))).mesh.positions.size(), 6u);
  const TriangleMesh sharp = stl(binary(roof(31))).mesh;
  EXPECT_EQ(sharp.positions.size(), 8u);
  const double a = 31 * std::numbers::pi / 180;
  for (std::size_t v = 0; v < sharp.positions.size(); ++v) {
    const bool flat = glm::distance(sharp.normals[v], glm::vec3(0, 0, 1)) < 1e-6f;
    const bool turned =
        glm::distance(sharp.normals[v], glm::vec3(std::sin(a), 0, std::cos(a))) < 1e-6f;
    EXPECT_TRUE(flat || turned) << v;
  }
  // On the ridge of a blunt roof one normal points half way.
  const TriangleMesh blunt = stl(binary(roof(20))).mesh;
  for (std::size_t v = 0; v < blunt.positions.size(); ++v) {
    if (blunt.positions[v].x != 0) continue;
    EXPECT_NEAR(std::atan2(blunt.normals[v].x, blunt.normals[v].z), 10 * std::numbers::pi / 180,
                1e-6);
  }
}

TEST(Stl, SolidsOfATextAreParts) {
  const PartMesh mesh =
      stl(text({kSquareFacets[0]}, "") + text({}, "empty") + text(kSquareFacets, "top side"));
  EXPECT_EQ(mesh.parts, (std::vector<std::string>{"DefaultMaterial", "empty", "top side"}));
  EXPECT_EQ(mesh.mesh.triangle_materials, (std::vector<std::uint32_t>{0, 2, 2}));
}

TEST(Stl, ManySolidsAreFoundByTheirNames) {
  std::string content;
  constexpr std::uint32_t kSolids = 400000;
  for (std::uint32_t i = 0; i < kSolids; ++i) content += "solid " + std::to_string(i) + "\n";
  content += text({kSquareFacets[0]}, "7") + text(kSquareFacets, "last");
  const PartMesh mesh = stl(content);  // searched one by one they take longer than ctest waits
  EXPECT_EQ(mesh.parts.size(), kSolids + 1);
  EXPECT_EQ(mesh.mesh.triangle_materials, (std::vector<std::uint32_t>{7, kSolids, kSolids}));
}

TEST(Stl, LongFilesAreReadInPieces) {
  std::vector<Facet> many;
  for (int i = 0; i < 50001; ++i) {
    const auto x = static_cast<float>(i);
    many.push_back({{{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}});
  }
  EXPECT_EQ(stl(binary(many)).mesh.triangleCount(), many.size());
  const TriangleMesh mesh = stl(text(many, "long")).mesh;
  EXPECT_EQ(mesh.triangleCount(), many.size());
  EXPECT_EQ(mesh.positions.back(), glm::vec3(50000, 1, 0));
}

TEST(Stl, WhatIsWrongIsSaid) {
  expectMessage(stlError(""), {"mesh.stl", "neither a text that begins with 'solid'"});
  expectMessage(stlError(binary(kSquareFacets, 3)), {"ends after 2 of the 3 triangles"});
  expectMessage(stlError(binary({}, 0xFFFFFFFFu)), {"ends after 0 of the 4294967295 triangles"});
  expectMessage(stlError(binary({})), {"no triangles"});
  expectMessage(stlError("solid\n facet\n vertex 0 0 0\n vertex 0 1 0\n endloop\n"),
                {"line 5", "2 vertices"});
  expectMessage(stlError("solid\nvertex 0 0 zero\n"), {"line 2", "'zero'", "not a number"});
  for (const char* cut : {"solid\nvertex 0 0", "solid\nvertex 0 0 0\nvertex 1 0 0\n"})
    expectMessage(stlError(cut), {"ends within a triangle"});
  expectMessage(stlError("solid\nvertex " + std::string(10000, '1')), {"line 2", "word of 4096"});
  std::vector<Facet> broken = kSquareFacets;
  broken[1][2].y = NAN;
  expectMessage(stlError(binary(broken)), {"position of vertex", "not finite"});
  // Many of them take no longer, although no two are equal by value.
  const glm::vec3 none(NAN);
  const std::vector<Facet> many(60000, Facet{none, none, none});
  expectMessage(stlError(binary(many)), {"position of vertex 0", "not finite"});
}

}  // namespace
}  // namespace glintmark
