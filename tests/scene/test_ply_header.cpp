#include "host/scene/ply_header.h"

#include <gtest/gtest.h>

#include <fstream>

#include "host/core/error.h"
#include "tests/report/temp_folder.h"

namespace glintmark {
namespace {

std::string messageFor(const std::string& text) {
  const TempFolder folder;
  std::ofstream(folder / "mesh.ply", std::ios::binary) << text;
  try {
    checkPlySize(folder / "mesh.ply");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(PlyHeader, WholeFilesPass) {
  EXPECT_EQ(
      messageFor("ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nend_header\n0\n1"),
      "");
  EXPECT_EQ(
      messageFor("ply\r\nformat binary_little_endian 1.0\r\nelement vertex 1\r\nproperty uchar "
                 "x\r\nend_header\r\n1"),
      "");
}

TEST(PlyHeader, ShortAndHeadlessFilesAreNamed) {
  EXPECT_NE(
      messageFor("ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nend_header\n0\n1")
          .find("ends before the elements"),
      std::string::npos);
  EXPECT_NE(
      messageFor("ply\nformat ascii 1.0\nelement vertex x\nend_header\n").find("has no count"),
      std::string::npos);
  for (const char* text :
       {"", "ply\n", "plz\nend_header\n", "ply\nelement vertex 1\nend%_header\n"})
    EXPECT_NE(messageFor(text).find("whole PLY header"), std::string::npos) << text;
}

}  // namespace
}  // namespace glintmark
