#include "host/report/difference/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "host/report/difference/plane_filter.h"
#include "host/report/picture/tonemap.h"

namespace glintmark {
namespace {

// Sums of up to two Gaussians of squared distance in degrees: a sqrt(pi / b) exp(-pi^2 d^2 / b).
// [ANAM20] Table 1
struct ContrastTerm {
  double a, b;
};
constexpr std::array<ContrastTerm, 1> kAchromatic = {{{1, 0.0047}}};
constexpr std::array<ContrastTerm, 1> kRedGreen = {{{1, 0.0053}}};
constexpr std::array<ContrastTerm, 2> kBlueYellow = {{{34.1, 0.04}, {13.5, 0.025}}};
constexpr double kWidestTerm = 0.04;

constexpr double kColourExponent = 0.7, kKneeColour = 0.4, kKneeError = 0.95;  // Sect. 4.1.3
constexpr double kFeatureWidth_deg = 0.082, kFeatureExponent = 0.5;            // Sect. 4.2

// Linear light of the primaries of Rec. 709 to CIE XYZ, by column.
const glm::mat3 kToXyz = {0.4123866f, 0.2126368f, 0.0193306f, 0.3575915f, 0.7151830f,
                          0.1191972f, 0.1804505f, 0.0721802f, 0.9503726f};
const glm::vec3 kWhite = kToXyz * glm::vec3(1);

glm::vec3 colourOf(const Image& image, int x, int y) {
  const auto c = image.at(x, y);
  return {c[0], c[1], c[2]};
}

// The opponent space that contrast sensitivity is known in, of XYZ relative to white.
glm::vec3 toOpponent(const glm::vec3& linear) {
  const glm::vec3 t = kToXyz * linear / kWhite;
  return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

glm::vec3 fromOpponent(const glm::vec3& opponent, const glm::mat3& from_xyz) {
  const float y = (opponent.x + 16) / 116;
  const glm::vec3 t = {y + opponent.y / 500, y, y - opponent.z / 200};
  return glm::clamp(from_xyz * (t * kWhite), glm::vec3(0), glm::vec3(1));
}

float labCurve(float t) {
  constexpr float kKnee = 6.0f / 29;
  return t > kKnee * kKnee * kKnee ? std::cbrt(t) : t / (3 * kKnee * kKnee) + 4.0f / 29;
}

// CIELab with chroma that falls with lightness, after Hunt.
glm::vec3 toHuntLab(const glm::vec3& linear) {
  const glm::vec3 t = kToXyz * linear / kWhite;
  const float x = labCurve(t.x), y = labCurve(t.y), z = labCurve(t.z);
  const float lightness = 116 * y - 16;
  return {lightness, 0.01f * lightness * 500 * (x - y), 0.01f * lightness * 200 * (y - z)};
}

float hyab(const glm::vec3& a, const glm::vec3& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

template <std::size_t N>
Image contrastFiltered(const Image& plane, const std::array<ContrastTerm, N>& terms,
                       double pixels_per_degree) {
  constexpr double kPi = std::numbers::pi;
  const int radius =
      static_cast<int>(std::ceil(3 * std::sqrt(kWidestTerm / (2 * kPi * kPi)) * pixels_per_degree));
  Image sum(plane.width, plane.height, 1);
  double weights = 0;
  for (const ContrastTerm& term : terms) {
    const double sigma_px = std::sqrt(term.b / 2) / kPi * pixels_per_degree;
    double along = 0;
    for (int x = -radius; x <= radius; ++x) along += std::exp(-0.5 * x * x / (sigma_px * sigma_px));
    // What the term adds to the whole filter, which then sums to 1.
    const double weight = term.a * std::sqrt(kPi / term.b) * along * along;
    const FilterTaps taps = gaussianTaps(sigma_px, radius);
    const Image part = filtered(plane, taps, taps);
    for (std::size_t i = 0; i < sum.pixels.size(); ++i)
      sum.pixels[i] += static_cast<float>(weight) * part.pixels[i];
    weights += weight;
  }
  for (float& value : sum.pixels) value /= static_cast<float>(weights);
  return sum;
}

// Three channels of Hunt-adjusted Lab as the eye sees them from its distance.
Image seenColours(const std::array<Image, 3>& opponent, double pixels_per_degree) {
  const Image y = contrastFiltered(opponent[0], kAchromatic, pixels_per_degree);
  const Image cx = contrastFiltered(opponent[1], kRedGreen, pixels_per_degree);
  const Image cz = contrastFiltered(opponent[2], kBlueYellow, pixels_per_degree);
  const glm::mat3 from_xyz = glm::inverse(kToXyz);
  Image lab(y.width, y.height, 3);
  forEachRow(y.height, [&](int row) {
    for (int x = 0; x < y.width; ++x) {
      const glm::vec3 seen =
          toHuntLab(fromOpponent({y.at(x, row)[0], cx.at(x, row)[0], cz.at(x, row)[0]}, from_xyz));
      std::ranges::copy(std::array{seen.x, seen.y, seen.z}, lab.at(x, row).begin());
    }
  });
  return lab;
}

// Signed weights whose positive ones sum to 1 and whose negative ones to -1.
FilterTaps balanced(const std::vector<double>& weights) {
  double positive = 0, negative = 0;
  for (const double w : weights) (w > 0 ? positive : negative) += std::abs(w);
  FilterTaps taps;
  for (const double w : weights)
    taps.push_back(static_cast<float>(w / (w > 0 ? positive : negative > 0 ? negative : 1)));
  return taps;
}

// Strength of edges and of points, two channels. [ANAM20] Sect. 4.2
Image features(const Image& achromatic, double pixels_per_degree) {
  const double sigma = 0.5 * kFeatureWidth_deg * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  std::vector<double> slope, bend;
  for (int x = -radius; x <= radius; ++x) {
    const double g = std::exp(-0.5 * x * x / (sigma * sigma));
    slope.push_back(-x * g);
    bend.push_back((x * x / (sigma * sigma) - 1) * g);
  }
  const FilterTaps smooth = gaussianTaps(sigma, radius), edge = balanced(slope),
                   point = balanced(bend);
  const Image edge_x = filtered(achromatic, edge, smooth),
              edge_y = filtered(achromatic, smooth, edge),
              point_x = filtered(achromatic, point, smooth),
              point_y = filtered(achromatic, smooth, point);
  Image both(achromatic.width, achromatic.height, 2);
  for (std::size_t i = 0; i < achromatic.pixels.size(); ++i) {
    both.pixels[2 * i] = std::hypot(edge_x.pixels[i], edge_y.pixels[i]);
    both.pixels[2 * i + 1] = std::hypot(point_x.pixels[i], point_y.pixels[i]);
  }
  return both;
}

struct SeenImage {
  Image lab, features;
};

SeenImage seen(const Image& linear, double pixels_per_degree) {
  std::array<Image, 3> opponent;
  opponent.fill(Image(linear.width, linear.height, 1));
  Image achromatic(linear.width, linear.height, 1);
  forEachRow(linear.height, [&](int y) {
    for (int x = 0; x < linear.width; ++x) {
      const glm::vec3 o = toOpponent(colourOf(linear, x, y));
      for (int c = 0; c < 3; ++c) opponent[static_cast<std::size_t>(c)].at(x, y)[0] = o[c];
      achromatic.at(x, y)[0] = (o.x + 16) / 116;
    }
  });
  return {seenColours(opponent, pixels_per_degree), features(achromatic, pixels_per_degree)};
}

// Distances of colours onto [0, 1], where small ones take most of it.
float perceivedError(float distance) {
  static const float largest = std::pow(hyab(toHuntLab({0, 1, 0}), toHuntLab({0, 0, 1})),
                                        static_cast<float>(kColourExponent));
  const float raised = std::pow(distance, static_cast<float>(kColourExponent));
  const float knee = static_cast<float>(kKneeColour) * largest;
  constexpr float kKnee = static_cast<float>(kKneeError);
  if (raised < knee) return raised * kKnee / knee;
  return kKnee + (raised - knee) / (largest - knee) * (1 - kKnee);
}

// [ANSA21] Sect. 3: a rational curve fitted to the film emulation of the Academy.
struct FilmCurve {
  double a = 0.36 * 2.51, b = 0.6 * 0.03, c = 0.36 * 2.43, d = 0.6 * 0.59, e = 0.14;

  float operator()(double x) const {
    return static_cast<float>(std::clamp((a * x + b) * x / ((c * x + d) * x + e), 0.0, 1.0));
  }
  // Where the curve is at `y` < a / c.
  double inverse(double y) const {
    const double square = a - y * c, linear = b - y * d, constant = -y * e;
    return (-linear + std::sqrt(linear * linear - 4 * square * constant)) / (2 * square);
  }
};
constexpr double kNearWhite = 0.85;

Image exposed(const Image& radiance, double stops) {
  Image display(radiance.width, radiance.height, 3);
  const double scale = std::exp2(stops);
  const FilmCurve film;
  forEachRow(radiance.height, [&](int y) {
    for (int x = 0; x < radiance.width; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        display.at(x, y)[c] = film(scale * std::max(radiance.at(x, y)[c], 0.0f));
  });
  return display;
}

}  // namespace

Image flipMap(const Image& image, const Image& reference, double pixels_per_degree) {
  const SeenImage a = seen(image, pixels_per_degree), b = seen(reference, pixels_per_degree);
  Image flip(image.width, image.height, 1);
  forEachRow(flip.height, [&](int y) {
    for (int x = 0; x < flip.width; ++x) {
      const float colour = perceivedError(hyab(colourOf(a.lab, x, y), colourOf(b.lab, x, y)));
      const auto fa = a.features.at(x, y), fb = b.features.at(x, y);
      const float feature = std::max(std::abs(fa[0] - fb[0]), std::abs(fa[1] - fb[1]));
      const float weight =
          std::pow(feature / std::numbers::sqrt2_v<float>, static_cast<float>(kFeatureExponent));
      flip.at(x, y)[0] = std::pow(colour, 1 - std::min(weight, 1.0f));
    }
  });
  return flip;
}

std::optional<ExposureRange> exposureRange(const Image& reference) {
  std::vector<double> luminances;
  for (int y = 0; y < reference.height; ++y)
    for (int x = 0; x < reference.width; ++x) {
      const glm::vec3 c = glm::max(colourOf(reference, x, y), glm::vec3(0));
      const double light = luminance(c.r, c.g, c.b);
      if (light > 0) luminances.push_back(light);
    }
  if (luminances.empty()) return std::nullopt;
  const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
  std::ranges::nth_element(luminances, middle);
  const double near_white = FilmCurve().inverse(kNearWhite);
  ExposureRange range{.first = std::log2(near_white / std::ranges::max(luminances)),
                      .last = std::log2(near_white / *middle)};
  range.count = std::max(2, static_cast<int>(std::ceil(range.last - range.first)));
  return range;
}

Image hdrFlipMap(const Image& image, const Image& reference, const ExposureRange& exposures,
                 double pixels_per_degree) {
  Image largest(image.width, image.height, 1);
  for (int i = 0; i < exposures.count; ++i) {
    const double stops =
        std::lerp(exposures.first, exposures.last, static_cast<double>(i) / (exposures.count - 1));
    const Image flip = flipMap(exposed(image, stops), exposed(reference, stops), pixels_per_degree);
    for (std::size_t p = 0; p < largest.pixels.size(); ++p)
      largest.pixels[p] = std::max(largest.pixels[p], flip.pixels[p]);
  }
  return largest;
}

}  // namespace glintmark
