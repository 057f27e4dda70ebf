// Pictures of the page: heatmaps with histograms, strips to compare, the rest.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/report/picture/cell_statistics.h"
#include "host/report/record/table_spec.h"

namespace glintmark {

struct ReportPicture {
  std::string name;        // file name, "cells_snow_steep.png"
  std::string png_bytes;   // the file as it is; empty if it could not be read
  std::string problem;     // why not
  CellDistribution cells;  // read back from a heatmap's colours; glint_px is 0 for other pictures
  int name_height_px = 0;  // of the names above a strip
};

/// Reads a picture; what is wrong with it goes to `problem`.
ReportPicture readReportPicture(const std::filesystem::path& file);

/// Hands each picture out once, as long as the page stays below its size.
class PictureShelf {
 public:
  /// `most_bytes` of the page are for pictures.
  PictureShelf(std::span<const ReportPicture> pictures, std::size_t most_bytes);

  /// Pictures of a table: the groups that it has, and all others whose names begin with its own; a
  /// sentence in place of each that its records make one expect and that is not there.
  std::string tablePictures(const TableSpec& table, std::span<const Record> records);
  /// Those that no table took.
  std::string otherPictures();

 private:
  bool has(const std::string& name) const;
  const ReportPicture* take(const std::string& name);
  std::string image(const ReportPicture& picture, const std::string& alt);
  std::string figure(const std::string& name, const std::string& caption,
                     const std::string& attributes = "", const std::string& below = "");
  std::string heatmaps(const PictureGroup& group, std::span<const Record> records);
  std::string strips(const PictureGroup& group, const std::string& table,
                     std::span<const Record> records);
  std::string singles(const PictureGroup& group);
  std::string groupHtml(const PictureGroup& group, const std::string& table,
                        std::span<const Record> records);

  std::span<const ReportPicture> pictures_;
  std::vector<bool> taken_;
  std::size_t bytes_left_;
};

/// Pixels over cells as a drawing in SVG; empty if there are none.
std::string histogramSvg(const CellDistribution& cells);

}  // namespace glintmark
