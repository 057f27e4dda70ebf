// OBJ files: numbers, encodings, faces of every kind.
#include <cmath>

#include "host/scene/import/text_scanner.h"
#include "host/scene/import_mesh.h"
#include "tests/scene/scene_test_tools.h"

namespace glintmark {
namespace {

PartMesh obj(const std::string& text) {
  const TemporaryFolder folder;
  return importMesh(folder.write("mesh.obj", text));
}

std::string objError(const std::string& text) {
  const TemporaryFolder folder;
  const std::string file = folder.write("mesh.obj", text);
  return errorOf([&] { importMesh(file); });
}

double areaOf(const TriangleMesh& mesh) {
  double area = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 p = mesh.positions[t.x];
    area += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - p,
                                         glm::dvec3(mesh.positions[t.z]) - p));
  }
  return area;
}

constexpr const char* kObjSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
constexpr const char* kObjUvs = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

TEST(Obj, NumbersOfEveryForm) {
  const std::pair<const char*, double> numbers[] = {
      {".5", 0.5},      {"-.5", -0.5}, {"5.", 5},    {"+1.5", 1.5}, {"1e3", 1000}, {"1E+3", 1000},
      {"2.5e-1", 0.25}, {"1d2", 100},  {"1,5", 1.5}, {"0007", 7},   {"1e-400", 0}, {"-0", 0}};
  for (const auto& [text, value] : numbers) {
    ASSERT_TRUE(parseNumber(text)) << text;
    EXPECT_EQ(*parseNumber(text), value) << text;
  }
  for (const char* text : {"nan", "-nan", "1.#QNAN", "-1.#IND"}) {
    ASSERT_TRUE(parseNumber(text)) << text;
    EXPECT_TRUE(std::isnan(*parseNumber(text))) << text;
  }
  for (const char* text : {"inf", "1e400", "1.#INF"})
    EXPECT_TRUE(std::isinf(*parseNumber(text))) << text;
  for (const char* text : {"", ".", "+", "x", "1x", "--1", "++1", "1e", "1 2"})
    EXPECT_FALSE(parseNumber(text)) << text;
}

TEST(Obj, LinesEncodingsAndContinuations) {
  const std::string plain = std::string(kObjSquare) + kObjUvs + "f 1/1 2/2 3/3\n";
  const std::string variants[] = {
      plain, "\xEF\xBB\xBF" + plain,
      std::string(kObjSquare) + kObjUvs + "f 1/1 \\\n2/2 \\\r\n 3/3 # end",
      "#" + std::string(3, '\xFF') + "\n" + plain,
      "\tv\t9 9 9\n  v 9 9 8\n" + std::string(kObjUvs) + kObjSquare + "f -4/1 -3/2 -2/3\n"};
  for (const std::string& text : variants) {
    const PartMesh mesh = obj(text);
    ASSERT_EQ(mesh.mesh.positions.size(), 3u) << text;
    EXPECT_EQ(mesh.mesh.positions[1], glm::vec3(1, 0, 0)) << text;
  }
  std::string old_mac = plain, windows, utf16 = "\xFF\xFE", utf16_big = "\xFE\xFF";
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  for (const char c : plain) {
    windows += c == '\n' ? "\r\n" : std::string(1, c);
    utf16 += std::string{c, '\0'};
    utf16_big += std::string{'\0', c};
  }
  for (const std::string& text : {old_mac, windows, utf16, utf16_big})
    EXPECT_EQ(obj(text).mesh.triangleCount(), 1u);
}

TEST(Obj, FacesOfEveryKind) {
  const std::string base = std::string(kObjSquare) + kObjUvs + "vn 0 0 -2\n";
  EXPECT_EQ(obj(base + "f 1/1/1 2/2/1 3/3/1 4/4/1\n").mesh.normals[0], glm::vec3(0, 0, -1));
  EXPECT_EQ(obj(base + "f 1//1 2//1 3//1\n").mesh.normals[0], glm::vec3(0, 0, -1));
  EXPECT_EQ(obj(base + "f -4/-4 -3/-3 -2/-2\n").mesh.uvs[2], glm::dvec2(1, 0));
  // Vertices may come after the faces that name them.
  EXPECT_EQ(obj("f 1/1 2/2 3/3\n" + base).mesh.triangleCount(), 1u);
  // A corner without uv leaves the face without.
  const PartMesh mixed = obj(base + "f 1/1 2/2 3/3\nf 1/1 3 4/4\n");
  ASSERT_EQ(mixed.notes.size(), 1u);
  expectMessage(mixed.notes[0], {"1 of 2 triangles have no uvs", "planar"});
}

TEST(Obj, FacesBesideTexturedOnesGetUvsOfTheirOwn) {
  // Two quads share an edge; one has uvs.
  const PartMesh mesh = obj("v -1 0 -1\nv -1 0 1\nv 0 0 -1\nv 0 0 1\nv 1 0 -1\nv 1 0 1\n" +
                            std::string(kObjUvs) + "f 1/1 2/2 4/4 3/3\nf 3 4 6 5\n");
  for (const glm::uvec3& t : mesh.mesh.triangles) {
    const glm::dvec2 a = mesh.mesh.uvs[t.y] - mesh.mesh.uvs[t.x],
                     b = mesh.mesh.uvs[t.z] - mesh.mesh.uvs[t.x];
    EXPECT_GT(std::abs(a.x * b.y - a.y * b.x), 0.5);
  }
}

TEST(Obj, ManyUvsAtOnePlaceTakeLinearTime) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\n";
  constexpr int kFaces = 800000;  // searched one by one they take longer than ctest waits
  for (int i = 0; i < kFaces; ++i) text += "vt " + std::to_string(i) + " 1\nf 1/-1 2/1 3/2\n";
  EXPECT_EQ(obj(text).mesh.triangleCount(), static_cast<std::size_t>(kFaces));
}

TEST(Obj, DentedPolygonsKeepTheirArea) {
  // A star-like heptagon with two dents, area by the shoelace formula.
  const glm::dvec2 corners[] = {{0, 0}, {4, 0}, {2, 1}, {4, 4}, {2, 2}, {0, 4}, {1, 2}};
  std::string text, face = "f";
  double twice = 0;
  for (int i = 0; i < 7; ++i) {
    const glm::dvec2 a = corners[i], b = corners[(i + 1) % 7];
    twice += a.x * b.y - a.y * b.x;
    text += "v " + std::to_string(a.x) + " 3 " + std::to_string(a.y) + "\n";
    face += " " + std::to_string(i + 1);
  }
  const PartMesh mesh = obj(text + face + "\n");
  EXPECT_EQ(mesh.mesh.triangleCount(), 5u);
  EXPECT_NEAR(areaOf(mesh.mesh), std::abs(twice) / 2, 1e-6);
}

TEST(Obj, SmoothingGroups) {
  // A roof: two quads at a right angle along the edge 2-3.
  const std::string roof = "v 0 0 0\nv 1 1 0\nv 1 1 1\nv 0 0 1\nv 2 0 0\nv 2 0 1\n";
  const std::string left = "f 1 4 3 2\n", right = "f 2 3 6 5\n";
  const auto ridgeNormals = [&](const std::string& text) {
    std::vector<glm::vec3> normals;
    const PartMesh mesh = obj(text);
    for (std::size_t v = 0; v < mesh.mesh.positions.size(); ++v)
      if (mesh.mesh.positions[v] == glm::vec3(1, 1, 0)) normals.push_back(mesh.mesh.normals[v]);
    return normals;
  };
  const double diagonal = std::sqrt(0.5);
  for (const std::string& smooth : {std::string(), std::string("s 1\n")})
    for (const glm::vec3& n : ridgeNormals(roof + smooth + left + right))
      EXPECT_NEAR(n.y, 1, 1e-6) << smooth;
  for (const std::string& second :
       {std::string("s off\n"), std::string("s 0\n"), std::string("s 2\n")}) {
    const std::string first = second == "s 2\n" ? "s 1\n" : second;
    const auto normals = ridgeNormals(roof + first + left + second + right);
    ASSERT_EQ(normals.size(), 2u) << second;
    for (const glm::vec3& n : normals) EXPECT_NEAR(n.y, diagonal, 1e-6) << second;
  }
}

TEST(Obj, ListsThatAreLeftOutAreNotNamed) {
  const PartMesh mesh = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1/7/8 2/7/8 3/7/8\n");
  EXPECT_EQ(mesh.mesh.normals[0], glm::vec3(0, 0, 1));
  ASSERT_GE(mesh.notes.size(), 2u);
  expectMessage(mesh.notes[0], {"name uvs, of which it has none"});
  expectMessage(mesh.notes[1], {"name normals, of which it has none"});
}

TEST(Obj, WhatIsWrongIsSaidWithItsLine) {
  const std::string base = std::string(kObjSquare) + kObjUvs;
  expectMessage(objError(base + "f 1 0 2\n"), {"mesh.obj:9", "index out of range"});
  expectMessage(objError(base + "f 1 -9 2\n"), {"mesh.obj:9", "index out of range"});
  expectMessage(objError(base + "f 1 two 3\n"), {"mesh.obj:9", "'two'"});
  expectMessage(objError(base + "f 1/1 2/2 3/9\n"), {"uv 9", "index out of range"});
  expectMessage(objError("v 0 0 zero\n"), {"mesh.obj:1", "'zero' of v is not a number"});
  expectMessage(objError(base + "f 1 2 2000000000\n"), {"index out of range"});
  expectMessage(objError(base + "surf 0 1 0 1 1 2 3\n"), {"no triangles", "free-form"});
}

}  // namespace
}  // namespace glintmark
