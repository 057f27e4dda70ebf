// The file format of LtcTable. Writing is serializeLtcTable plus whoever owns the file.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/fit/data_folder.h"
#include "host/fit/ltc_table.h"

namespace glintmark {
namespace {

static_assert(std::endian::native == std::endian::little, "table files are little-endian");

constexpr char kMagic[8] = {'G', 'M', '-', 'L', 'T', 'C', '\r', '\n'};  // shows text conversion
constexpr std::uint32_t kVersion = 1;

struct FileHeader {
  char magic[8];
  std::uint32_t version;
  std::uint32_t ndf;  // the value of reference::Ndf
  std::uint32_t size;
  std::uint32_t cell_floats;
  std::uint64_t checksum;  // FNV-1a of the values' bytes
};
static_assert(sizeof(FileHeader) == 32);

std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  }
  return hash;
}

FileHeader readHeader(std::string_view bytes, const std::string& name) {
  FileHeader header;
  if (bytes.size() < sizeof(header) || std::memcmp(bytes.data(), kMagic, sizeof(kMagic)) != 0) {
    throw Error(fmt::format("{} is not an LTC table; `glintmark fit ltc` writes one", name));
  }
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (header.version != kVersion || header.cell_floats != LTC_CELL_FLOATS) {
    throw Error(
        fmt::format("{} is an LTC table of version {} with {} floats per cell, expected version {} "
                    "with {}; `glintmark fit ltc` writes one",
                    name, header.version, header.cell_floats, kVersion, LTC_CELL_FLOATS));
  }
  if (header.size < LTC_SIZE_MIN || header.size > LTC_SIZE_MAX || header.ndf > 2) {
    throw Error(fmt::format("{} has a damaged header: size {} (8 to 128), distribution {} (0 to 2)",
                            name, header.size, header.ndf));
  }
  return header;
}

}  // namespace

std::string serializeLtcTable(const LtcTable& table) {
  const std::string_view values(reinterpret_cast<const char*>(table.values.data()),
                                table.values.size() * sizeof(float));
  FileHeader header{.magic = {},
                    .version = kVersion,
                    .ndf = static_cast<std::uint32_t>(table.ndf),
                    .size = static_cast<std::uint32_t>(table.size),
                    .cell_floats = LTC_CELL_FLOATS,
                    .checksum = fnv1a(values)};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof(header));
  return bytes.append(values);
}

LtcTable parseLtcTable(std::string_view bytes, const std::string& name) {
  const FileHeader header = readHeader(bytes, name);
  LtcTable table(static_cast<reference::Ndf>(header.ndf), static_cast<int>(header.size));
  const std::string_view values = bytes.substr(sizeof(header));
  const std::size_t expected = table.values.size() * sizeof(float);
  if (values.size() != expected) {
    throw Error(fmt::format("{} has {} bytes, expected {} for a table of {}x{}", name, bytes.size(),
                            expected + sizeof(header), header.size, header.size));
  }
  if (fnv1a(values) != header.checksum) {
    throw Error(fmt::format("{} is damaged: its checksum does not match its values", name));
  }
  std::memcpy(table.values.data(), values.data(), expected);
  for (const float value : table.values) {
    if (!std::isfinite(value)) {
      throw Error(fmt::format("{} holds a value that is not a finite number", name));
    }
  }
  return table;
}

LtcTable loadLtcTable(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw Error(fmt::format("no LTC table {}; `glintmark fit ltc` writes one", path.string()));
  }
  return parseLtcTable(readFile(path), path.string());
}

LtcTable shippedLtcTable(reference::Ndf ndf) {
  const std::filesystem::path path =
      findDataFile(fmt::format("ltc_{}.table", reference::ndfName(ndf)));
  LtcTable table = loadLtcTable(path);
  if (table.ndf != ndf) {
    throw Error(fmt::format("{} holds the {} distribution, expected {}", path.string(),
                            reference::ndfName(table.ndf), reference::ndfName(ndf)));
  }
  return table;
}

}  // namespace glintmark
