// Tables of linearly transformed cosines for anisotropic lobes: what they hold, how they are looked
// up and stored. Layout and addressing: kernels/area/anisotropic_table.h.
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/fit/anisotropic_samples.h"
#include "kernels/area/anisotropic_table.h"

namespace glintmark {

/// One cell, or what lies between cells.
struct AnisotropicCell {
  glm::dmat3 rest{0.0};  // columns A, B and C
  double albedo = 1, schlick_albedo = 0;
};

/// `values` are ANISO_CELLS * ANISO_FLOATS floats.
struct AnisotropicTable {
  reference::Ndf ndf = reference::Ndf::kGgx;
  std::vector<float> values = std::vector<float>(std::size_t{ANISO_CELLS} * ANISO_FLOATS);

  AnisotropicCell cell(int index) const;
  void setCell(int index, const AnisotropicCell& cell);
  /// What the device gets: cells ANISO_STRIDE floats apart.
  std::vector<float> paddedValues() const;
};

/// Nodes along the axes of roughness, ratio, view and azimuth.
using AnisotropicNode = std::array<int, 4>;
int anisotropicIndex(const AnisotropicNode& node);
/// What a node stands for. First nodes of roughness and ratio, where lobes vanish, are measured at
/// a small one.
AnisotropicView anisotropicView(reference::Ndf ndf, const AnisotropicNode& node);
/// The same between nodes.
AnisotropicView anisotropicViewAt(reference::Ndf ndf, const std::array<double, 4>& place);

/// M of a cell for a view with alpha.x >= alpha.y and phi in [0, pi / 2], in the frame of view and
/// normal.
glm::dmat3 anisotropicMatrix(const AnisotropicCell& cell, const AnisotropicView& view);
/// The cell of a matrix M, at any scale and turned by anything about its z: both are chosen such
/// that cells of neighbours resemble each other. Albedos are left as they are.
void storeAnisotropic(const glm::dmat3& matrix, const AnisotropicView& view, AnisotropicCell& cell);

/// Interpolation over the simplex of five nodes around a view, as in the kernels; `view` as for
/// anisotropicMatrix, roughness and ratio clamped to [0, 1].
AnisotropicCell lookUpAnisotropic(const AnisotropicTable& table, const AnisotropicView& view);

/// The bytes of a table file: a header of 32 bytes (magic, version, NDF, nodes, floats per cell,
/// checksum of those and of the values, all little-endian), then the values.
std::string serializeAnisotropicTable(const AnisotropicTable& table);
/// Reads them back. Throws Error naming `name` if they are of another kind of file, another version
/// or layout, truncated, or damaged.
AnisotropicTable parseAnisotropicTable(std::string_view bytes, const std::string& name);
/// Reads a table file. Throws Error like parseAnisotropicTable, or if the file cannot be read.
AnisotropicTable loadAnisotropicTable(const std::filesystem::path& path);
/// The table that ships with the program, see findDataFile. Throws Error if it is missing, damaged
/// or of another NDF.
AnisotropicTable shippedAnisotropicTable(reference::Ndf ndf);

}  // namespace glintmark
