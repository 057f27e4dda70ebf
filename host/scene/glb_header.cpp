#include "host/scene/glb_header.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>

#include "host/core/error.h"

namespace glintmark {
namespace {

constexpr std::uint64_t kFileHeaderBytes = 12, kChunkHeaderBytes = 8;

}  // namespace

void checkGlbSize(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::uint64_t size = std::filesystem::file_size(file);
  for (std::uint64_t at = kFileHeaderBytes; at + kChunkHeaderBytes <= size;) {
    std::array<unsigned char, 4> bytes = {};  // the chunk's length, little-endian
    stream.seekg(static_cast<std::streamoff>(at));
    stream.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    const std::uint64_t length =
        bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint64_t>(bytes[3]) << 24;
    at += kChunkHeaderBytes;
    if (!stream || length > size - at)
      throw Error(fmt::format("{}: cannot be read as a mesh: it ends within a chunk of {} bytes",
                              file.string(), length));
    at += length;
  }
}

}  // namespace glintmark
