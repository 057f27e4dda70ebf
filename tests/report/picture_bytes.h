// Files of pictures, byte by byte: what writers of others make and ours does not.
#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace glintmark {

template <typename T>
std::string littleEndian(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

/// One part of an EXR file: floats without compression. Channels must be in alphabetical order.
struct ExrPart {
  std::string name;                   // empty in files of one part
  std::vector<std::string> channels;  // each with its values, row by row
  std::vector<std::vector<float>> values;
  std::array<int, 4> data_window, display_window;  // least and largest x and y: x, y, x, y
  std::vector<int> steps{};  // pixels between samples, both ways; empty: 1 for each channel
  std::vector<float> chromaticities{};  // of red, green, blue and white, x and y; empty: none said

  int step(std::size_t channel) const { return steps.empty() ? 1 : steps[channel]; }
};

inline std::string exrAttribute(const std::string& name, const std::string& type,
                                const std::string& value) {
  return name + '\0' + type + '\0' + littleEndian(static_cast<std::int32_t>(value.size())) + value;
}

inline std::string exrHeader(const ExrPart& part, bool in_parts) {
  std::string channels;
  for (std::size_t c = 0; c < part.channels.size(); ++c)
    channels += part.channels[c] + '\0' + littleEndian(std::int32_t{2}) +
                littleEndian(std::int32_t{0}) + littleEndian(std::int32_t{part.step(c)}) +
                littleEndian(std::int32_t{part.step(c)});
  const auto box = [](const std::array<int, 4>& b) {
    std::string bytes;
    for (const int v : b) bytes += littleEndian(std::int32_t{v});
    return bytes;
  };
  std::string header = exrAttribute("channels", "chlist", channels + '\0');
  if (in_parts)
    header +=
        exrAttribute("chunkCount", "int",
                     littleEndian(std::int32_t{part.data_window[3] - part.data_window[1] + 1}));
  if (!part.chromaticities.empty()) {
    std::string numbers;
    for (const float v : part.chromaticities) numbers += littleEndian(v);
    header += exrAttribute("chromaticities", "chromaticities", numbers);
  }
  header += exrAttribute("compression", "compression", std::string(1, '\0')) +
            exrAttribute("dataWindow", "box2i", box(part.data_window)) +
            exrAttribute("displayWindow", "box2i", box(part.display_window)) +
            exrAttribute("lineOrder", "lineOrder", std::string(1, '\0'));
  if (in_parts) header += exrAttribute("name", "string", part.name);
  header += exrAttribute("pixelAspectRatio", "float", littleEndian(1.0f)) +
            exrAttribute("screenWindowCenter", "v2f", littleEndian(0.0f) + littleEndian(0.0f)) +
            exrAttribute("screenWindowWidth", "float", littleEndian(1.0f));
  if (in_parts) header += exrAttribute("type", "string", "scanlineimage");
  return header + '\0';
}

/// A whole EXR file.
inline std::string exrBytes(const std::vector<ExrPart>& parts) {
  const bool in_parts = parts.size() > 1;
  std::string file =
      std::string("\x76\x2f\x31\x01\x02", 5) + (in_parts ? '\x10' : '\0') + std::string(2, '\0');
  for (const ExrPart& part : parts) file += exrHeader(part, in_parts);
  if (in_parts) file += '\0';
  std::string chunks;
  std::vector<std::size_t> offsets;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const ExrPart& part = parts[p];
    const std::size_t width = part.data_window[2] - part.data_window[0] + 1;
    for (int y = part.data_window[1]; y <= part.data_window[3]; ++y) {
      offsets.push_back(chunks.size());
      if (in_parts) chunks += littleEndian(static_cast<std::int32_t>(p));
      std::string row;
      for (std::size_t c = 0; c < part.values.size(); ++c) {
        const int step = part.step(c);
        if (y % step != 0) continue;
        const std::size_t samples = width / step, at = (y - part.data_window[1]) / step * samples;
        for (std::size_t x = 0; x < samples; ++x) row += littleEndian(part.values[c][at + x]);
      }
      chunks +=
          littleEndian(std::int32_t{y}) + littleEndian(static_cast<std::int32_t>(row.size())) + row;
    }
  }
  const std::size_t begin = file.size() + 8 * offsets.size();
  for (const std::size_t offset : offsets) file += littleEndian(std::uint64_t{begin + offset});
  return file + chunks;
}

inline std::string bigEndian(std::uint32_t value) {
  std::string bytes;
  for (int i = 3; i >= 0; --i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
  return bytes;
}

inline std::string pngChunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const char c : type + data) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  return bigEndian(static_cast<std::uint32_t>(data.size())) + type + data + bigEndian(~crc);
}

/// A PNG of less than 64 kB of pixels; colour types: 0 grey, 2 rgb, 4 grey and alpha.
inline std::string pngBytes(int width, int height, int bits, int colour_type,
                            const std::string& pixels) {
  std::string raw;
  const std::size_t row = height > 0 ? pixels.size() / height : 0;
  for (int y = 0; y < height && row > 0; ++y) raw += '\0' + pixels.substr(y * row, row);
  std::uint32_t a = 1, b = 0;
  for (const char c : raw) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint16_t>(raw.size());
  const std::string stored = std::string("\x78\x01\x01", 3) + littleEndian(size) +
                             littleEndian(static_cast<std::uint16_t>(~size)) + raw +
                             bigEndian(b << 16 | a);
  const std::string head = bigEndian(width) + bigEndian(height) + static_cast<char>(bits) +
                           static_cast<char>(colour_type) + std::string(3, '\0');
  return std::string("\x89PNG\r\n\x1A\n", 8) + pngChunk("IHDR", head) + pngChunk("IDAT", stored) +
         pngChunk("IEND", "");
}

/// An uncompressed grey TIFF of 8 bits with an orientation.
inline std::string tiffBytes(int width, int height, int orientation, const std::string& pixels) {
  const auto entry = [](int tag, int type, int value) {
    return littleEndian(static_cast<std::uint16_t>(tag)) +
           littleEndian(static_cast<std::uint16_t>(type)) + littleEndian(std::uint32_t{1}) +
           littleEndian(static_cast<std::uint32_t>(value));
  };
  constexpr int kShort = 3, kLong = 4, kEntries = 10;
  const int begin = 8 + 2 + 12 * kEntries + 4;
  return std::string("II*\0\x08\0\0\0", 8) + littleEndian(std::uint16_t{kEntries}) +
         entry(256, kShort, width) + entry(257, kShort, height) + entry(258, kShort, 8) +
         entry(259, kShort, 1) + entry(262, kShort, 1) + entry(273, kLong, begin) +
         entry(274, kShort, orientation) + entry(277, kShort, 1) + entry(278, kShort, height) +
         entry(279, kLong, static_cast<int>(pixels.size())) + std::string(4, '\0') + pixels;
}

/// A grey JPEG of 40x40 noise, as base64.
inline constexpr const char* kNoiseJpeg =
    "/9j/2wBDAA0JCgsKCA0LCgsODg0PEyAVExISEyccHhcgLikxMC4pLSwzOko+MzZGNywtQFdBRkxOUlNSMj5aYVpQYE"
    "pRUk//wAALCAAoACgBAREA/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcICQoL/8QAtRAAAgEDAwIEAwUFBAQA"
    "AAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAkM2JyggkKFhcYGRolJicoKSo0NTY3ODk6Q0RFRkdISU"
    "pTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKztLW2t7i5usLDxMXGx8jJ"
    "ytLT1NXW19jZ2uHi4+Tl5ufo6erx8vP09fb3+Pn6/9oACAEBAAA/AGykRxM0ErjLhFcbcrk8MxHIywHXHUjHSkigmk"
    "nbCPkIvlg5GARjOAP4tvJB4B49rMmPOaWZ2WR02yK7IQwwRkBsDPCk4GDkdKdc5lj83zGHlMFlUkg9SwzkjOMKc5H3"
    "jz3qnKzRx7I4o0lQOBIpDbWPUZ7dQvJzjBz2LmgmaKK1Z/KJymB82Hx+HGMkjnGenUCURT3KusYMtpuGAY8knBG5c7"
    "sgYA9MZwMikKSrdBYliuWbMkcjR7sYHA3DHcY46FuvqxmTzgWdGk8xSrSREOG78Z5GMnHdiRyTS2cn2uOVBHskUFcg"
    "NGqq2PmI55xn04zzUkf7uN9jxhIoztETlkK7if4SMkYwc+xJqskrShJYpRunkYtjd8z9QwAz8q9PT19BZto2F+3E6z"
    "vmRgIsRL0z15I+6DjrjvTDOY4YniZLa3RN5I+YFQTwOM+h6jG8Dg0rjKb5YnkLNjcWK4y3BIB6ZXqOMYAPXFZyPsbG"
    "SFtqxqd3lkA5x8x4O7G444HfHbEsjQShZQoAUlyjrtVRvUFewP8AEMH17Z5tSXHHkSgiUEjdgbc7SOW4GSQwB45zwM"
    "YqGPdbTJAhEMrIhAlYkE4wAEHIOeSeozk46UhjCRtGEKSSP8xRQGMOAe4644+oPOARUcrypdGTcxmAUZRVBdVwSeOo"
    "2joD3HYUqO8IYu83yuSMYUKSc4L9SPlwSeMD2ALopY3XymWMymXMaRqf3uM88tgZ45PBx3xTpBJCPtbRvGyIUZozt6"
    "gEYAY+uSRn86gnRY5FaRPOdgRJgAMjkDhiMcHDADHPOM5Ff//Z";

}  // namespace glintmark
