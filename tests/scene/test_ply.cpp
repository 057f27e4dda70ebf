// PLY files: headers, numbers, attributes of vertices and faces.
#include <cmath>
#include <cstring>

#include "host/scene/import_mesh.h"
#include "tests/scene/scene_test_tools.h"

namespace glintmark {
namespace {

std::string plyError(const std::string& text) {
  const TemporaryFolder folder;
  const std::string file = folder.write("mesh.ply", text);
  return errorOf([&] { importMesh(file); });
}

PartMesh ply(const std::string& text) {
  const TemporaryFolder folder;
  return importMesh(folder.write("mesh.ply", text));
}

/// Bytes of numbers, of either order.
template <typename T>
std::string bytesOf(std::initializer_list<T> values, bool big_endian) {
  std::string bytes;
  for (const T value : values) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (big_endian) std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
  }
  return bytes;
}

constexpr const char* kVertices =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
constexpr const char* kFaces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kTextHead = "ply\nformat ascii 1.0\n";

TEST(Ply, LinesMayEndInAnyWay) {
  const std::string text =
      kTextHead + kVertices + kFaces + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string changed;
    for (const char c : text) changed += c == '\n' ? std::string(end) : std::string(1, c);
    EXPECT_EQ(ply(changed).mesh.triangleCount(), 1u);
  }
}

TEST(Ply, BinaryOfBothOrdersAndEveryType) {
  for (const bool big : {false, true}) {
    const std::string text =
        std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
        "_endian 1.0\r\ncomment made here\r\nelement vertex 3\r\nproperty double x\r\nproperty "
        "short "
        "y\r\nproperty uchar z\r\nproperty float nx\r\nproperty float ny\r\nproperty float "
        "nz\r\nproperty float texture_u\r\nproperty float texture_v\r\nelement other 1\r\nproperty "
        "list uint8 uint16 numbers\r\nelement face 1\r\nproperty char flags\r\nproperty list int "
        "uint "
        "vertex_index\r\nend_header\r\n";
    std::string body;
    const double x[] = {0, 2, 0};
    const std::int16_t y[] = {-300, -300, 300};
    for (int i = 0; i < 3; ++i) {
      body += bytesOf<double>({x[i]}, big) + bytesOf<std::int16_t>({y[i]}, big) + '\x07';
      body += bytesOf<float>({0, 0, 2, 0.25f * static_cast<float>(i), i == 1 ? 0.75f : 0.5f}, big);
    }
    body += '\x02' + bytesOf<std::uint16_t>({1, 2}, big);
    body += '\x01' + bytesOf<std::int32_t>({3}, big) + bytesOf<std::uint32_t>({0, 1, 2}, big);
    const TriangleMesh mesh = ply(text + body).mesh;
    ASSERT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.positions[2], glm::vec3(0, 300, 7));
    EXPECT_EQ(mesh.normals[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.uvs[1], glm::dvec2(0.25, 0.25));  // v runs down here and up there
  }
}

TEST(Ply, UvsOfCornersMakeSeams) {
  const std::string text =
      kTextHead + "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
      "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float "
      "texcoord\n" +
      "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" +
      "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0 0 0.5 0.5 0 1\n";
  const PartMesh mesh = ply(text);
  EXPECT_EQ(mesh.mesh.positions.size(), 5u);  // the first corner is shared, the third is not
  EXPECT_EQ(mesh.mesh.uvs[mesh.mesh.triangles[1].y], glm::dvec2(0.5, 0.5));
  EXPECT_TRUE(mesh.notes.empty());
}

TEST(Ply, StripsAndPolygonsBecomeTriangles) {
  const std::string vertices =
      "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string numbers = "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n";
  const PartMesh strip = ply(kTextHead + vertices + "element tristrips 1\nproperty list int int " +
                             "vertex_indices\nend_header\n" + numbers + "8 0 1 2 3 -1 2 3 4\n");
  EXPECT_EQ(strip.mesh.triangleCount(), 3u);
  // All of one side.
  for (const glm::vec3& n : strip.mesh.normals) EXPECT_NEAR(n.z, -1, 1e-6);
}

TEST(Ply, ListsAmongTheNumbersOfAVertex) {
  const std::string lists =
      std::string(kVertices) + "property list uchar float s\nproperty float t\n";
  const TriangleMesh mesh = ply(kTextHead + lists + kFaces +
                                "end_header\n0 0 0 2 8 9 5\n1 0 0 0 5\n0 1 0 1 7 5\n3 0 1 2\n")
                                .mesh;
  ASSERT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.positions[2], glm::vec3(0, 1, 0));
  expectMessage(
      plyError(kTextHead + "element vertex 1\nproperty list uchar float x\nproperty float "
                           "y\nproperty float z\nend_header\n1 5 0 0\n"),
      {"no property x"});
}

TEST(Ply, TextsMayHoldMoreThanTheirHeaderSays) {
  const TriangleMesh mesh = ply(kTextHead + "Created by hand\n" + kVertices + kFaces +
                                "end_header\n0 0 0 9\n1 0 0\n0\n1 0 5 5\n3 0 1 2 6 1 1 1\n")
                                .mesh;
  ASSERT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.positions[2], glm::vec3(0, 1, 0));
}

TEST(Ply, WhatIsWrongIsSaid) {
  expectMessage(plyError(kTextHead + "element vertex 9\nproperty float x\nend_header\n0\n1"),
                {"mesh.ply", "ends before the elements"});
  expectMessage(plyError(kTextHead + "element vertex x\nend_header\n"), {"has no count"});
  for (const char* text : {"ply\n", "ply\nformat ascii 1.0\nelement vertex 1\n"})
    expectMessage(plyError(text), {"no whole PLY header"});
  for (const char* text : {"", "plz\nend_header\n"})
    expectMessage(plyError(text), {"begin with 'ply'"});
  expectMessage(plyError("ply\nelement vertex 1\nend%_header\n"), {"no whole PLY header"});
  expectMessage(plyError(kTextHead + "element vertex 1\nproperty quad x\n"), {"type 'quad'"});
  expectMessage(plyError(kTextHead + "element vertex 1\nproperty float x\nend_header\n1\n"),
                {"no property y"});
  expectMessage(
      plyError(kTextHead + kVertices + kFaces + "end_header\n0 0 0\n1 0 0\n0 a 0\n3 0 1 2\n"),
      {"'a' is not a number"});
  // Nothing of what has no properties is in the file: counting to its end takes minutes.
  EXPECT_EQ(ply(kTextHead + kVertices + "element note 4294967279\n" + kFaces +
                "element face 4294967279\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
                .mesh.triangleCount(),
            1u);
  // A count that no file of this size can hold, in a name of either case.
  const TemporaryFolder folder;
  const std::string bomb = folder.write(
      "bomb.PLY",
      "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float "
      "x\nproperty float y\nproperty float z\nend_header\n    ");
  expectMessage(errorOf([&] { importMesh(bomb); }), {"bomb.PLY", "ends before the elements"});
}

}  // namespace
}  // namespace glintmark
