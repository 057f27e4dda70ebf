// A host of its own fills the kernels' structs: vectors of OpenCL's sizes first, then their
// headers.
#include <math.h>

#include <cstdint>

namespace {
using uint = std::uint32_t;
struct alignas(8) float2 {
  float x, y;
};
struct alignas(16) float4 {
  float x, y, z, w;
};
#include <types.h>

#include <glint/glint_grids.h>
}  // namespace

static_assert(sizeof(MaterialParams) == 288);

// The compression of grooves four times as rough one way as the other.
float compressionOfGrooves() {
  return glintGamma(1, 16);
}
