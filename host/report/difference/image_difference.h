// Everything that is said of one picture against another.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/core/image.h"
#include "host/report/difference/pixel_errors.h"

namespace glintmark {

struct DifferenceOptions {
  double exposure = 1;                 // of radiance before it is shown; > 0
  double pixels_per_degree = 67.0206;  // of FLIP; > 0
  double trim = 0.001;                 // share of pixels that the trimmed relMSE leaves out
  bool hdr_flip = true;                // of radiance; the slowest by far
};

/// One metric over all pixels, and over those that are not black in both: sparse glints are lost in
/// a mean over a black picture.
struct MetricPair {
  std::string name, meaning;
  double all = 0, lit = 0;  // NaN where there is none
};

/// Quantiles of an error of the pixels that are not black in both.
struct ErrorQuantiles {
  std::string name;
  std::vector<double> values{};  // as kQuantiles
};
inline constexpr double kQuantiles[] = {0.5, 0.9, 0.99, 0.999, 1};

struct ImageDifference {
  int width = 0, height = 0;
  bool is_radiance = false;  // display values otherwise
  double lit_share = 0;      // of pixels that are not black in both, in [0, 1]
  std::vector<MetricPair> metrics{};
  std::vector<ErrorQuantiles> quantiles{};
  LuminanceRatios ratios{};
  Image absolute{}, relative{}, ssim{}, flip{};  // maps of one channel
  std::optional<Image> hdr_flip{};

  /// Throws Error naming the metrics if there is none of that name.
  const MetricPair& metric(const std::string& name) const;
};

/// Compares the colours of two pictures of readColours(). Those of 8 or 16 bits hold display
/// values: they are compared in linear light where light is meant, and as they are by SSIM;
/// radiance is shown as by `render`. Throws Error if sizes differ, if one holds display values and
/// the other radiance, or if a value is not finite.
ImageDifference differenceOf(const Image& image, const Image& reference,
                             const DifferenceOptions& options);

/// As tables and a sentence. `name` and `reference`: of the pictures.
std::string differenceText(const ImageDifference& difference, const std::string& name,
                           const std::string& reference);

/// The same as JSON, schema "glintmark.difference/1".
std::string differenceJson(const ImageDifference& difference, const std::string& name,
                           const std::string& reference);

}  // namespace glintmark
