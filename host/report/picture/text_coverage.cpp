#include "host/report/picture/text_coverage.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "host/core/error.h"
#include "host/report/picture/load_codec.h"

namespace glintmark {
namespace {

constexpr int kOversampling = 4;

int outputPx(int fine_px, bool up) {
  const double px = static_cast<double>(fine_px) / kOversampling;
  return static_cast<int>(up ? std::ceil(px) : std::floor(px));
}

// Means of kOversampling x kOversampling pixels.
Image averaged(const std::vector<float>& fine, int width, int height) {
  Image image(width, height, 1);
  const int fine_width = width * kOversampling;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const int x = static_cast<int>(i) % fine_width, y = static_cast<int>(i) / fine_width;
    image.at(x / kOversampling, y / kOversampling)[0] += fine[i] / (kOversampling * kOversampling);
  }
  return image;
}

}  // namespace

TextCoverage textCoverage(const std::string& text, int size_px, const std::filesystem::path& font) {
  if (!std::filesystem::exists(font))
    throw Error(
        fmt::format("cannot write text into a picture: the font {} is missing; it comes "
                    "with the package fonts-lato",
                    font.string()));
  TextCoverage coverage;
  if (text.empty()) return coverage;
  const int fine_px = size_px * kOversampling;
  const InkBox ink = imageCodec().inkBox(text, fine_px, font.string());
  if (ink.width <= 0 || ink.height <= 0)
    throw Error(
        fmt::format("cannot write '{}' into a picture with the font {}", text, font.string()));
  coverage.left = outputPx(ink.x, false);
  coverage.top = outputPx(ink.y, false);
  const int width = outputPx(ink.x + ink.width, true) - coverage.left;
  const int height = outputPx(ink.y + ink.height, true) - coverage.top;

  const InkBox box = {coverage.left * kOversampling, coverage.top * kOversampling,
                      width * kOversampling, height * kOversampling};
  std::vector<float> fine(static_cast<std::size_t>(box.width) * box.height);
  const std::string fault = imageCodec().drawInk(text, fine_px, font.string(), box, fine);
  if (!fault.empty()) throw Error(fmt::format("cannot write '{}' into a picture: {}", text, fault));
  coverage.share = averaged(fine, width, height);
  return coverage;
}

}  // namespace glintmark
