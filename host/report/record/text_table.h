// Plain text tables for terminals and result files.
#pragma once
#include <string>
#include <vector>

namespace glintmark {

inline constexpr std::size_t kTableColumnsLimit = 100;

/// Columns as wide as their widest cell, two spaces between them; one space if lines would be wider
/// than kTableColumnsLimit, and if they still are, the first column's cells take more lines than
/// one. The first column is left-aligned, the others right-aligned.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header);
  /// Throws Error if the row does not have one cell per column.
  void addRow(std::vector<std::string> row);
  /// A rule of dashes before the next row.
  void addRule();
  std::string toString() const;

 private:
  std::vector<std::vector<std::string>> rows_;  // the header first; an empty row is a rule
};

/// `value` with three significant digits where that is readable ("0.0123", "4.10", "123", "45678",
/// thousands and millions as "460k", "21.0M"); "-" if it is not finite.
std::string compactNumber(double value);

}  // namespace glintmark
