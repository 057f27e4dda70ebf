// Pictures of tables: one coloured square per entry.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "host/core/image.h"

namespace glintmark {

/// One table of a picture, row by row from the top; all tables of a picture have the same size.
struct MatrixPanel {
  std::string caption;
  std::span<const double> values;  // width * height
};

struct MatrixPictureOptions {
  int width = 0, height = 0;         // entries of each panel
  int entry_px = 5;                  // side of an entry's square
  double low = 0, high = 1;          // values of the ends of the colour bar
  std::string title{};               // what the colours mean, above the colour bar
  std::string x_label{}, y_label{};  // what runs to the right and downwards
};

/// The panels side by side with their captions, labels, and a colour bar below. Values outside low
/// to high take the end colours. Throws Error if a panel does not have width * height values.
Image matrixPicture(const std::vector<MatrixPanel>& panels, const MatrixPictureOptions& options);

}  // namespace glintmark
