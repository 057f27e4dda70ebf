#include "host/codec/exr_image.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaYca.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTestFile.h>

#include <algorithm>
#include <array>
#include <exception>
#include <stdexcept>
#include <string_view>

namespace glintmark {
namespace {

// A channel's own samples: every `x_step`-th of every `y_step`-th row.
struct Samples {
  std::string name;
  int x_step = 1, y_step = 1, width = 0, height = 0;
  std::vector<float> values{};
};

float mix(float a, float b, float t) {
  return a + t * (b - a);
}

// The value at a pixel: samples lie on the first pixel of each step; behind the last it stays.
float valueAt(const Samples& s, int x, int y) {
  const int column = x / s.x_step, row = y / s.y_step;
  const auto sample = [&](int i, int j) {
    return s.values[static_cast<std::size_t>(std::min(j, s.height - 1)) * s.width +
                    std::min(i, s.width - 1)];
  };
  const float right = static_cast<float>(x % s.x_step) / static_cast<float>(s.x_step);
  const float down = static_cast<float>(y % s.y_step) / static_cast<float>(s.y_step);
  if (right == 0 && down == 0) return sample(column, row);
  return mix(mix(sample(column, row), sample(column + 1, row), right),
             mix(sample(column, row + 1), sample(column + 1, row + 1), right), down);
}

bool isChroma(std::string_view channel) {
  const std::string_view own = channel.substr(channel.rfind('.') + 1);
  return own == "RY" || own == "BY";
}

// Of red, green and blue, by the file's primaries. Throws where these span no colours.
std::array<float, 3> luminanceOf(const Imf::Header& header) {
  if (!Imf::hasChromaticities(header)) return StoredPart{}.luminance;
  const Imath::V3f weights = Imf::RgbaYca::computeYw(Imf::chromaticities(header));
  if (!(weights.y > 0)) throw std::runtime_error("by its chromaticities green is dark");
  return {weights.x, weights.y, weights.z};
}

class SampledExr : public StoredImage {
 public:
  explicit SampledExr(const std::string& path) : file_(path.c_str()) {}

  bool isNeeded() const {
    for (int number = 0; number < file_.parts(); ++number) {
      const Imf::Header& header = file_.header(number);
      if (isDeep(header)) continue;
      for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        if (c.channel().xSampling > 1 || c.channel().ySampling > 1 || isChroma(c.name()))
          return true;
      }
    }
    return false;
  }

  std::optional<StoredPart> part(int number) override {
    if (number >= file_.parts()) return std::nullopt;
    const Imf::Header& header = file_.header(number);
    StoredPart part;
    if (header.hasName()) part.name = header.name();
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
      part.channel_names.emplace_back(c.name());
    const Imath::Box2i &data = header.dataWindow(), &display = header.displayWindow();
    part.x = data.min.x;
    part.y = data.min.y;
    part.width = data.max.x - data.min.x + 1;
    part.height = data.max.y - data.min.y + 1;
    part.full_x = display.min.x;
    part.full_y = display.min.y;
    part.full_width = display.max.x - display.min.x + 1;
    part.full_height = display.max.y - display.min.y + 1;
    if (const auto* turned = header.findTypedAttribute<Imf::IntAttribute>("Orientation"))
      part.orientation = turned->value();
    part.deep = isDeep(header);
    part.band_rows = std::max(1, part.height);  // rows are made of those beside them
    try {
      part.luminance = luminanceOf(header);
    } catch (const std::exception&) {
      // read() says so where colours are made of it.
    }
    return part;
  }

  bool hasParts() const override { return true; }

  std::string read(int part, int begin, int end, int first_row, int rows,
                   std::span<float> pixels) override try {
    const Imf::Header& header = file_.header(part);
    const Imath::Box2i& window = header.dataWindow();
    const int width = window.max.x - window.min.x + 1;
    const std::vector<Samples> channels = readSamples(part, begin, end);
    if (std::ranges::any_of(channels, [](const Samples& s) { return isChroma(s.name); }))
      luminanceOf(header);
    std::size_t at = 0;
    for (int y = first_row; y < first_row + rows; ++y)
      for (int x = 0; x < width; ++x)
        for (const Samples& channel : channels) pixels[at++] = valueAt(channel, x, y);
    return {};
  } catch (const std::exception& fault) {
    return fault.what();
  }

 private:
  static bool isDeep(const Imf::Header& header) {
    return header.hasType() && Imf::isDeepData(header.type());
  }

  std::vector<Samples> readSamples(int part, int begin, int end) {
    Imf::InputPart input(file_, part);
    const Imath::Box2i& window = input.header().dataWindow();
    std::vector<Samples> channels;
    channels.reserve(static_cast<std::size_t>(end - begin));
    Imf::FrameBuffer frame;
    int number = 0;
    for (auto c = input.header().channels().begin(); c != input.header().channels().end(); ++c) {
      const int own = number++;
      if (own < begin || own >= end) continue;
      Samples& s =
          channels.emplace_back(Samples{c.name(), c.channel().xSampling, c.channel().ySampling});
      // The format wants windows that begin and end on a step.
      s.width = (window.max.x - window.min.x + 1) / s.x_step;
      s.height = (window.max.y - window.min.y + 1) / s.y_step;
      s.values.resize(static_cast<std::size_t>(s.width) * s.height);
      const std::ptrdiff_t row = s.width, column_0 = window.min.x / s.x_step,
                           row_0 = window.min.y / s.y_step;
      float* const origin = s.values.data() - row_0 * row - column_0;
      frame.insert(s.name,
                   Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(origin), sizeof(float),
                              sizeof(float) * static_cast<std::size_t>(row), s.x_step, s.y_step));
    }
    input.setFrameBuffer(frame);
    input.readPixels(window.min.y, window.max.y);
    return channels;
  }

  Imf::MultiPartInputFile file_;
};

}  // namespace

std::unique_ptr<StoredImage> openSampledExr(const std::string& path) try {
  if (!Imf::isOpenExrFile(path.c_str())) return nullptr;
  auto file = std::make_unique<SampledExr>(path);
  if (!file->isNeeded()) return nullptr;
  return file;
} catch (const std::exception&) {
  return nullptr;  // OpenImageIO says what is wrong with it
}

}  // namespace glintmark
