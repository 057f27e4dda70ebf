#include "host/scene/ply_header.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <string>

#include "host/core/error.h"

namespace glintmark {
namespace {

// Longest header that is looked through; comments make them long.
constexpr int kMostHeaderLines = 10000;

}  // namespace

void checkPlySize(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  // Least bytes of the elements before the current one, and of one of those; a number takes at
  // least one byte, in text a separator too.
  double least_bytes = 0, count = 0;
  int properties = 0, bytes_of_number = 1;
  std::string line;
  for (int i = 0; i < kMostHeaderLines && std::getline(stream, line); ++i) {
    std::istringstream words(line);
    std::string key, name;
    words >> key >> name;
    if (i == 0 && key != "ply") break;
    if (key == "format" && name == "ascii") bytes_of_number = 2;
    if (key == "property") ++properties;
    if (key != "element" && key != "end_header") continue;
    least_bytes += count * properties * bytes_of_number;
    count = properties = 0;
    if (key == "end_header") {
      const auto begin = static_cast<double>(stream.tellg());
      const auto size = static_cast<double>(std::filesystem::file_size(file));
      // The last number needs no separator.
      if (least_bytes > size - begin + 1)
        throw Error(fmt::format(
            "{}: cannot be read as a mesh: it ends before the elements that its header counts",
            file.string()));
      return;
    }
    if (!(words >> count) || count < 0)
      throw Error(fmt::format("{}: cannot be read as a mesh: element {} has no count",
                              file.string(), name));
  }
  throw Error(
      fmt::format("{}: cannot be read as a mesh: it has no whole PLY header", file.string()));
}

}  // namespace glintmark
