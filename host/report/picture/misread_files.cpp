#include "host/report/picture/misread_files.h"

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "host/report/picture/little_endian.h"

namespace glintmark {
namespace {

// [Microsoft, "DDS_PIXELFORMAT structure"]
bool isLuminanceDds(std::string_view head) {
  constexpr std::size_t kFlags = 80, kBits = 88;
  constexpr std::uint32_t kLuminance = 0x20000;
  return head.starts_with("DDS ") && head.size() >= 128 &&
         (littleEndian(head, kFlags, 4) & kLuminance) != 0 && littleEndian(head, kBits, 4) <= 8;
}

// [Microsoft, "BITMAPV4HEADER structure"]
bool hasOtherMasksBmp(std::string_view head) {
  constexpr std::size_t kBits = 28, kCompression = 30, kMasks = 54;
  constexpr std::uint32_t kBitFields = 3, kAlphaBitFields = 6;
  if (!head.starts_with("BM") || head.size() < kMasks + 12 || littleEndian(head, kBits, 2) != 32)
    return false;
  const std::uint64_t compression = littleEndian(head, kCompression, 4);
  if (compression != kBitFields && compression != kAlphaBitFields) return false;
  return littleEndian(head, kMasks, 4) != 0xFF0000u ||
         littleEndian(head, kMasks + 4, 4) != 0xFF00u || littleEndian(head, kMasks + 8, 4) != 0xFFu;
}

bool isTga(std::string_view name) {
  constexpr std::string_view kEnd = ".tga";
  return name.size() >= kEnd.size() &&
         std::ranges::equal(name.substr(name.size() - kEnd.size()), kEnd, [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) == b;
         });
}

// [Truevision, "TGA File Format Specification" 2.0]
bool hasShiftedMapTga(std::string_view head) {
  constexpr std::size_t kHasMap = 1, kType = 2, kFirst = 3;
  if (head.size() < 18 || head[kHasMap] != 1) return false;
  return (head[kType] == 1 || head[kType] == 9) && littleEndian(head, kFirst, 2) != 0;
}

// Orientations from 4 on: lines that go down or up. [SMPTE 268M-2003]
bool hasColumnsDpx(std::string_view head) {
  constexpr std::size_t kOrientation = 768;
  if (head.size() < kOrientation + 2) return false;
  const bool is_big = head.starts_with("SDPX");
  if (!is_big && !head.starts_with("XPDS")) return false;
  const auto orientation = static_cast<unsigned char>(head[kOrientation + (is_big ? 1 : 0)]);
  return orientation >= 4 && orientation <= 7;
}

}  // namespace

std::string misreading(std::string_view head, std::string_view name) {
  if (isLuminanceDds(head)) return "its DDS format is luminance, which is not read; save it as PNG";
  if (hasOtherMasksBmp(head))
    return "its BMP has bit masks of its own, which are not read; save it as PNG";
  if (isTga(name) && hasShiftedMapTga(head))
    return "its TGA has a colour map that does not begin at 0, which is not read; save it as PNG";
  if (hasColumnsDpx(head)) return "its DPX lies in columns, which are misread; save it as PNG";
  return {};
}

}  // namespace glintmark
