// The file between write_hits and shade_hits: this header, then kHitArrays arrays of `count` words
// (kernels/sample/glints.cl), three arrays of the radiance that our frame has, r, g and b, and the
// floats of the table that the method looks things up in, if it has one.
#pragma once
#include <cstdint>

inline constexpr std::uint32_t kHitArrays = 14;

struct HitsHeader {
  char device[256];              // name of the device that shaded the frame
  std::uint32_t count;           // hits, a multiple of 64
  std::uint32_t material_bytes;  // of MaterialParams
  float irradiance[4];
  std::uint32_t table_floats;
  unsigned char material[288];
};
