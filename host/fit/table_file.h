// The file format that all tables of linearly transformed cosines share: a header of 32 bytes
// (magic, version, NDF, nodes of an axis, floats per cell, checksum of those and of the
// values, all little-endian), then the values.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/reference/microfacet.h"

namespace glintmark {

/// What one kind of table is.
struct TableFormat {
  std::string_view magic;    // eight bytes
  std::string_view name;     // "an LTC table"
  std::string_view command;  // what writes one
  std::uint32_t version = 2, cell_floats = 1;
  std::uint32_t least_size = 1, most_size = 1;  // nodes of an axis
  int axes = 2;

  std::size_t floats(std::size_t size) const;
};

struct TableContent {
  reference::Ndf ndf = reference::Ndf::kGgx;
  int size = 0;
  std::vector<float> values;
};

/// The bytes of a table file.
std::string serializeTable(const TableFormat& format, reference::Ndf ndf, int size,
                           std::span<const float> values);

/// Reads them back. Throws Error naming `name` if they are of another kind of file, another
/// version or layout, truncated, or damaged.
TableContent parseTable(const TableFormat& format, std::string_view bytes, const std::string& name);

/// The bytes of a file; throws Error if there is none.
std::string readTableFile(const TableFormat& format, const std::filesystem::path& path);

/// Throws Error unless `found`, which the file at `path` holds, is `wanted`.
void requireNdf(reference::Ndf found, reference::Ndf wanted, const std::filesystem::path& path);

}  // namespace glintmark
