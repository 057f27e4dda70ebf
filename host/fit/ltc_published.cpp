// Reads the published table of linearly transformed cosines, to compare with.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/fit/ltc_error.h"
#include "host/fit/ltc_fit.h"

namespace glintmark {
namespace {

constexpr int kSize = 64;
using Matrix = std::vector<double>;  // kSize x kSize

std::map<std::string, Matrix> readOctaveMatrices(std::istream& file) {
  std::map<std::string, Matrix> matrices;
  Matrix* current = nullptr;
  for (std::string line; std::getline(file, line);) {
    constexpr std::string_view kName = "# name: ";
    if (line.starts_with(kName)) {
      current = &matrices[line.substr(kName.size())];
    } else if (current != nullptr && !line.starts_with('#')) {
      std::istringstream words(line);
      std::vector<double> row;
      for (double value; words >> value;) row.push_back(value);
      if (row.size() == kSize) current->insert(current->end(), row.begin(), row.end());
    }
  }
  return matrices;
}

}  // namespace

LtcTable readPublishedLtc(const std::filesystem::path& path) {
  std::istringstream file(readFile(path));
  std::map<std::string, Matrix> matrices = readOctaveMatrices(file);
  const auto matrix = [&](const std::string& name) -> const Matrix& {
    const Matrix& m = matrices[name];
    if (m.size() != static_cast<std::size_t>(kSize) * kSize) {
      throw Error(fmt::format("{} has no {}x{} matrix {}, expected the published ltc.mat",
                              path.string(), kSize, kSize, name));
    }
    return m;
  };
  const Matrix& magnitude = matrix("tabMagnitude");
  std::array<std::array<const Matrix*, 3>, 3> entries{};
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      entries[column][row] = &matrix(fmt::format("tab{}{}", column, row));
    }
  }
  LtcTable table(reference::Ndf::kGgx, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * kSize + x;
      glm::dmat3 forward;
      for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) forward[column][row] = (*entries[column][row])[at];
      }
      LtcCell cell{.scale = magnitude[at], .albedo = magnitude[at]};
      storeLobe(lobeOfMatrix(glm::inverse(forward)), ltcFitAlpha(x, kSize), ltcRowCosine(y, kSize),
                cell);
      table.setCell(x, y, cell);
    }
  }
  return table;
}

}  // namespace glintmark
