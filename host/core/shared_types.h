// The host's side of kernels/types.h: OpenCL-sized vectors, then the structs, then their sizes.
#pragma once
#include <array>
#include <cstdint>

namespace glintmark {

using uint = std::uint32_t;

struct alignas(8) float2 {
  float x = 0, y = 0;
};
struct alignas(16) float4 {
  float x = 0, y = 0, z = 0, w = 0;
};

#include "kernels/types.h"

static_assert(sizeof(float2) == 8 && sizeof(float4) == 16);
static_assert(sizeof(SurfaceMaterial) == 128);
static_assert(sizeof(GlintMaterial) == 160);
static_assert(sizeof(MaterialParams) == 288);
static_assert(sizeof(ConeLight) == 32);
static_assert(sizeof(LightParams) == 48);
static_assert(sizeof(FrameParams) == 80);
static_assert(sizeof(MipTexture) == 80);
static_assert(sizeof(AreaLightParams) == 176);

/// Sizes in the order in which probe.cl's `probeTypeSizes` reports them.
inline constexpr std::array<std::uint32_t, 8> kSharedTypeSizes = {
    sizeof(MaterialParams),  sizeof(ConeLight),    sizeof(LightParams),
    sizeof(FrameParams),     sizeof(MipTexture),   sizeof(AreaLightParams),
    sizeof(SurfaceMaterial), sizeof(GlintMaterial)};

}  // namespace glintmark
