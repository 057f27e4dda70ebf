// Pictures of the page: heatmaps with histograms, strips to compare, the rest.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/report/picture/cell_statistics.h"
#include "host/report/record/record.h"

namespace glintmark {

struct ReportPicture {
  std::string name;        // file name, "cells_snow_steep.png"
  std::string png_bytes;   // the file as it is; empty if it could not be read
  std::string problem;     // why not
  CellDistribution cells;  // read back from a heatmap's colours; glint_px is 0 for other pictures
};

/// Reads a picture; what is wrong with it goes to `problem`.
ReportPicture readReportPicture(const std::filesystem::path& file);

/// Hands each picture out once, as long as the page stays below its size.
class PictureShelf {
 public:
  /// `most_bytes` of the page are for pictures.
  PictureShelf(std::span<const ReportPicture> pictures, std::size_t most_bytes);

  /// Pictures that belong to a table by their names, each with what it needs around it; a sentence
  /// in place of each that its records make one expect and that is not there.
  std::string tablePictures(const std::string& table, std::span<const Record> records);
  /// Those that no table took.
  std::string otherPictures();

 private:
  const ReportPicture* take(const std::string& name);
  std::string image(const ReportPicture& picture, const std::string& alt);
  std::string figure(const std::string& name, const std::string& caption,
                     const std::string& attributes = "", const std::string& below = "");
  std::string heatmaps(std::span<const Record> records);
  std::string strips(const std::string& table, std::span<const Record> records);

  std::span<const ReportPicture> pictures_;
  std::vector<bool> taken_;
  std::size_t bytes_left_;
};

/// Pixels over cells as a drawing in SVG; empty if there are none.
std::string histogramSvg(const CellDistribution& cells);

}  // namespace glintmark
