// A float image in memory, row by row from the top left, channels interleaved.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace glintmark {

struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> pixels;                 // width * height * channels
  std::vector<std::string> channel_names{};  // empty, or one per channel (for EXR)
  float step = 0;  // between neighbouring values of a file of 8 or 16 bits; 0: floats

  Image() = default;
  Image(int w, int h, int c)
      : width(w), height(h), channels(c), pixels(static_cast<std::size_t>(w) * h * c) {}

  std::span<float> at(int x, int y) {
    return {pixels.data() + (static_cast<std::size_t>(y) * width + x) * channels,
            static_cast<std::size_t>(channels)};
  }
  std::span<const float> at(int x, int y) const {
    return {pixels.data() + (static_cast<std::size_t>(y) * width + x) * channels,
            static_cast<std::size_t>(channels)};
  }
};

}  // namespace glintmark
