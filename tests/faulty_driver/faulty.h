// Runs glintmark on a driver with faults.
#pragma once
#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include "host/core/atomic_file.h"
#include "host/report/picture/image_io.h"
#include "tests/cli/process.h"

namespace glintmark {

/// `faults` as in fault_list.h.
inline std::vector<std::string> faultyEnvironment(const std::string& faults) {
  return {"LD_PRELOAD=" GLINTMARK_BINARY_DIR "/lib/glintmark_faulty_driver.so",
          "ASAN_OPTIONS=verify_asan_link_order=0", "GLINTMARK_FAULTS=" + faults};
}

inline ProcessResult runFaulty(const std::vector<std::string>& arguments,
                               const std::string& faults) {
  return runGlintmark(arguments, faultyEnvironment(faults));
}

/// Pictures that take a moment: of glints that are few, and of a plane.
inline std::vector<std::string> renderGlitter(const std::string& file) {
  return {"render", "glitter", "--quiet", "--size", "96x64", "-o", file};
}
inline std::vector<std::string> renderPlane(const std::string& file) {
  return {"render", "screen_plane", "--quiet", "--size", "64x36", "-o", file};
}

/// Faults as the name of a test.
inline std::string testName(std::string faults) {
  for (char& c : faults)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return faults;
}

/// Have both files the same pixels, bit by bit? An EXR also holds its date.
inline bool samePixels(const std::filesystem::path& a, const std::filesystem::path& b) {
  const Image one = readImage(a), other = readImage(b);
  return one.width == other.width && one.height == other.height && one.pixels == other.pixels;
}

}  // namespace glintmark
