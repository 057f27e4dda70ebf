#include "host/fit/table_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/fnv1a.h"

namespace glintmark {
namespace {

static_assert(std::endian::native == std::endian::little, "table files are little-endian");

struct FileHeader {
  char magic[8];
  std::uint32_t version;
  std::uint32_t ndf;  // the value of reference::Ndf
  std::uint32_t size;
  std::uint32_t cell_floats;
  std::uint64_t checksum;  // FNV-1a of all bytes before it, then of the values'
};
static_assert(sizeof(FileHeader) == 32);

std::uint64_t checksumOf(const FileHeader& header, std::string_view values) {
  const std::string_view head(reinterpret_cast<const char*>(&header),
                              offsetof(FileHeader, checksum));
  return fnv1a(values, fnv1a(head));
}

FileHeader readHeader(const TableFormat& format, std::string_view bytes, const std::string& name) {
  FileHeader header;
  if (bytes.size() < sizeof(header) || bytes.substr(0, sizeof(header.magic)) != format.magic) {
    throw Error(fmt::format("{} is not {}; `{}` writes one", name, format.name, format.command));
  }
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (header.version != format.version || header.cell_floats != format.cell_floats) {
    throw Error(fmt::format(
        "{} is {} of version {} with {} floats per cell, expected version {} with {}; `{}` writes "
        "one",
        name, format.name, header.version, header.cell_floats, format.version, format.cell_floats,
        format.command));
  }
  if (header.size < format.least_size || header.size > format.most_size || header.ndf > 2) {
    throw Error(fmt::format(
        "{} has a damaged header: size {} ({} to {}), distribution {} (0 to 2); "
        "`{}` writes one",
        name, header.size, format.least_size, format.most_size, header.ndf, format.command));
  }
  return header;
}

}  // namespace

std::size_t TableFormat::floats(std::size_t size) const {
  std::size_t count = cell_floats;
  for (int axis = 0; axis < axes; ++axis) count *= size;
  return count;
}

std::string serializeTable(const TableFormat& format, reference::Ndf ndf, int size,
                           std::span<const float> values) {
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  FileHeader header{.magic = {},
                    .version = format.version,
                    .ndf = static_cast<std::uint32_t>(ndf),
                    .size = static_cast<std::uint32_t>(size),
                    .cell_floats = format.cell_floats,
                    .checksum = 0};
  std::memcpy(header.magic, format.magic.data(), sizeof(header.magic));
  header.checksum = checksumOf(header, bytes);
  std::string file(reinterpret_cast<const char*>(&header), sizeof(header));
  return file.append(bytes);
}

TableContent parseTable(const TableFormat& format, std::string_view bytes,
                        const std::string& name) {
  const FileHeader header = readHeader(format, bytes, name);
  TableContent content{static_cast<reference::Ndf>(header.ndf), static_cast<int>(header.size), {}};
  const std::string_view values = bytes.substr(sizeof(header));
  const std::size_t expected = format.floats(header.size) * sizeof(float);
  if (values.size() != expected) {
    std::string sides = fmt::format("{}", header.size);
    for (int axis = 1; axis < format.axes; ++axis) sides += fmt::format("x{}", header.size);
    throw Error(fmt::format("{} has {} bytes, expected {} for a table of {}; `{}` writes one", name,
                            bytes.size(), expected + sizeof(header), sides, format.command));
  }
  if (checksumOf(header, values) != header.checksum) {
    throw Error(
        fmt::format("{} is damaged: its checksum does not match its content; `{}` writes one", name,
                    format.command));
  }
  content.values.resize(format.floats(header.size));
  std::memcpy(content.values.data(), values.data(), expected);
  for (const float value : content.values) {
    if (!std::isfinite(value)) {
      throw Error(fmt::format("{} holds a value that is not a finite number", name));
    }
  }
  return content;
}

std::string readTableFile(const TableFormat& format, const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    std::string name(format.name.substr(format.name.find(' ') + 1));
    throw Error(fmt::format("no {} {}; `{}` writes one", name, path.string(), format.command));
  }
  return readFile(path, FileRole::kOwn);
}

void requireNdf(reference::Ndf found, reference::Ndf wanted, const std::filesystem::path& path) {
  if (found == wanted) return;
  throw Error(fmt::format("{} holds the {} distribution, expected {}", path.string(),
                          reference::ndfName(found), reference::ndfName(wanted)));
}

}  // namespace glintmark
