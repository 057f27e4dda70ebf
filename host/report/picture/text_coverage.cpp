#include "host/report/picture/text_coverage.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include <cmath>

#include "host/core/error.h"

namespace glintmark {
namespace {

constexpr int kOversampling = 4;

int outputPx(int fine_px, bool up) {
  const double px = static_cast<double>(fine_px) / kOversampling;
  return static_cast<int>(up ? std::ceil(px) : std::floor(px));
}

// Means of kOversampling x kOversampling pixels.
Image averaged(const OIIO::ImageBuf& fine, int width, int height) {
  Image image(width, height, 1);
  OIIO::ImageBuf::ConstIterator<float> pixel(fine);
  for (; !pixel.done(); ++pixel)
    image.at(pixel.x() / kOversampling, pixel.y() / kOversampling)[0] +=
        pixel[0] / (kOversampling * kOversampling);
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
  const OIIO::ROI box = OIIO::ImageBufAlgo::text_size(text, fine_px, font.string());
  if (!box.defined() || box.width() <= 0 || box.height() <= 0)
    throw Error(
        fmt::format("cannot write '{}' into a picture with the font {}", text, font.string()));
  coverage.left = outputPx(box.xbegin, false);
  coverage.top = outputPx(box.ybegin, false);
  const int width = outputPx(box.xend, true) - coverage.left;
  const int height = outputPx(box.yend, true) - coverage.top;

  OIIO::ImageBuf fine(
      OIIO::ImageSpec(width * kOversampling, height * kOversampling, 1, OIIO::TypeDesc::FLOAT));
  OIIO::ImageBufAlgo::zero(fine);
  const float ink = 1;
  if (!OIIO::ImageBufAlgo::render_text(fine, -coverage.left * kOversampling,
                                       -coverage.top * kOversampling, text, fine_px, font.string(),
                                       ink))
    throw Error(fmt::format("cannot write '{}' into a picture: {}", text, fine.geterror()));
  coverage.share = averaged(fine, width, height);
  return coverage;
}

}  // namespace glintmark
