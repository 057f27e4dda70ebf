// What pixels are unpacked to: frames of all normals, tangents and charts, and the ray to the eye.
#include <algorithm>
#include <cmath>
#include <random>

#include "host/core/angles.h"
#include "host/core/float4.h"
#include "host/core/frame_packing.h"
#include "host/harness/kernel_bench.h"
#include "host/harness/tolerances.h"
#include "host/ocl/kernel_config.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

// A frame as the planes say it, and the screen position of its pixel.
struct PackedPixel {
  PackedFrame packed;
  glm::dvec3 normal, tangent, bitangent;  // before packing
  std::uint32_t x = 0, y = 0;
};

std::vector<PackedPixel> packedPixels(int count) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<PackedPixel> pixels(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    PackedPixel& p = pixels[i];
    p.normal = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const glm::dvec3 any(normal(random), normal(random), normal(random));
    p.tangent = glm::normalize(any - glm::dot(any, p.normal) * p.normal);
    const bool mirrored = i % 3 == 0;
    p.bitangent = glm::cross(p.normal, p.tangent) * (mirrored ? -1.0 : 1.0);
    p.packed = packFrame(p.normal, p.tangent, mirrored);
    p.x = static_cast<std::uint32_t>(random() % 4096);
    p.y = static_cast<std::uint32_t>(random() % 2048);
  }
  return pixels;
}

// The frames that were packed, not those that the host unpacks: view and light in each, and the
// view is the ray through the pixel's column and row.
Finding frames(const CheckContext& context) {
  const std::vector<PackedPixel> pixels = packedPixels(2000);
  const std::size_t stride = paddedCount(pixels.size());
  std::vector<std::uint32_t> words(3 * stride);
  for (std::size_t i = 0; i < stride; ++i) {
    const PackedPixel& p = pixels[std::min(i, pixels.size() - 1)];
    words[i] = p.y << 16 | p.x;
    words[stride + i] = p.packed.frame0;
    words[2 * stride + i] = p.packed.frame1;
  }
  FrameParams params{};
  const glm::dvec3 origin(-0.7, 0.4, -1), dx(3e-4, 2e-5, 1e-5), dy(1e-5, -4e-4, 2e-5);
  params.ray_origin = toFloat4(origin);
  params.ray_dx = toFloat4(dx);
  params.ray_dy = toFloat4(dy);
  params.plane_stride = static_cast<uint>(stride);
  const glm::dvec3 light = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
  Buffer output(context.bench.device, 6 * stride * 4, BufferPurpose::kProbe, "local directions");
  const std::vector<KernelArg> args = {
      probeData(context.bench, words), probeData(context.bench, std::vector{params}),
      static_cast<float>(light.x),     static_cast<float>(light.y),
      static_cast<float>(light.z),     output};
  KernelConfig config;
  config.width = context.lanes;
  config.glint = config.size_variation = config.cone_lights = false;
  config.planes = {Plane::kPixel, Plane::kFrame0, Plane::kFrame1};
  context.bench.cache.get("probes/probe_pixel.cl", config)
      .kernel("probePixels")
      .launch(args, stride / static_cast<std::size_t>(context.lanes), kLocalSize);
  std::vector<float> out(6 * stride);
  output.read(out.data(), out.size() * 4);

  Finding finding(kFrameError);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const PackedPixel& p = pixels[i];
    const glm::dvec3 view =
        -glm::normalize(origin + dx * static_cast<double>(p.x) + dy * static_cast<double>(p.y));
    const glm::dvec3 axes[] = {p.tangent, p.bitangent, p.normal};
    for (std::size_t k = 0; k < 3; ++k) {
      // Views from below are raised to the horizon.
      const double want_view = glm::dot(axes[k], view);
      finding.add(std::abs(out[k * stride + i] - (k == 2 ? std::max(want_view, 1e-4) : want_view)));
      finding.add(std::abs(out[(k + 3) * stride + i] - glm::dot(axes[k], light)));
    }
  }
  return finding;
}

}  // namespace

std::vector<Check> pixelChecks() {
  return {{"pixel/frames", "error of directions in their frames", frames}};
}

}  // namespace glintmark
