// Tables of linearly transformed cosines: what they hold, how they are looked up and stored.
//
// [HDHN16] Heitz, Dupuy, Hill, Neubelt, "Real-Time Polygonal-Light Shading with Linearly
// Transformed Cosines", SIGGRAPH 2016. [HH16] Heitz, Hill, "Real-Time Area Lighting: a Journey from
// Research to Production", SIGGRAPH 2016 courses. Layout and addressing: kernels/area/ltc_table.h.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/reference/microfacet.h"
#include "kernels/area/ltc_table.h"

namespace glintmark {

/// What one cell of a table holds, in the order of kernels/area/ltc_table.h.
struct LtcCell {
  double xx = 1, xz = 0, zx = 0, zz = 1;  // inverse matrix, last row divided by alpha
  double scale = 1, schlick = 0;          // factors of an integral over the upper hemisphere
  double albedo = 1, schlick_albedo = 0;  // directional albedos of the BRDF
};

/// One table. `values` is what the device gets: size * size * LTC_CELL_FLOATS floats.
struct LtcTable {
  reference::Ndf ndf = reference::Ndf::kGgx;
  int size = 0;
  std::vector<float> values;

  LtcTable() = default;
  LtcTable(reference::Ndf table_ndf, int table_size)
      : ndf(table_ndf),
        size(table_size),
        values(static_cast<std::size_t>(table_size) * table_size * LTC_CELL_FLOATS) {}

  LtcCell cell(int x, int y) const;
  void setCell(int x, int y, const LtcCell& cell);
};

/// Roughness alpha of column x and cosine of the view angle of row y of a table of `size`.
double ltcColumnAlpha(int x, int size);
double ltcRowCosine(int y, int size);

/// Bilinear interpolation at alpha and cos_theta, each clamped to [0, 1], in double precision.
LtcCell lookUpLtc(const LtcTable& table, double alpha, double cos_theta);

/// The table at another size, LTC_SIZE_MIN to LTC_SIZE_MAX, interpolated.
LtcTable resizedLtcTable(const LtcTable& table, int size);

/// The bytes of a table file: a header of 32 bytes (magic, version, NDF, size, floats per cell,
/// checksum of those and of the values, all little-endian), then the values.
std::string serializeLtcTable(const LtcTable& table);

/// Reads them back. Throws Error naming `name` if they are of another kind of file, another
/// version or layout, truncated, or damaged.
LtcTable parseLtcTable(std::string_view bytes, const std::string& name);

/// Reads a table file. Throws Error like parseLtcTable, or if the file cannot be read.
LtcTable loadLtcTable(const std::filesystem::path& path);

/// The table that ships with the program, see findDataFile. Throws Error like loadLtcTable, or if
/// the file holds another NDF.
LtcTable shippedLtcTable(reference::Ndf ndf);

}  // namespace glintmark
