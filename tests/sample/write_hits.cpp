// Shades a frame of glints and writes what each pixel saw and got: write_hits METHOD FILE.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <optional>
#include <vector>

#include "host/core/error.h"
#include "host/core/float4.h"
#include "host/core/glint_grids.h"
#include "host/frame/effect/glint_table.h"
#include "host/frame/effect/lights.h"
#include "host/frame/frame_renderer.h"
#include "host/harness/small_scenes.h"
#include "tests/sample/hits_file.h"

namespace glintmark {
namespace {

constexpr std::array kUvPlanes = {Plane::kUInt, Plane::kUFrac, Plane::kVInt, Plane::kVFrac,
                                  Plane::kDudx, Plane::kDvdx,  Plane::kDudy, Plane::kDvdy};

template <typename T>
void append(std::ofstream& file, const T* data, std::size_t count) {
  file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(count * sizeof(T)));
}

// Vectors to the eye and to the light in the tangent frame, six arrays, as the kernels have them.
std::vector<float> directions(Device& device, const FrameRenderer& renderer, const float4& light) {
  const PixelPlanes& planes = renderer.planes();
  FrameParams params{};
  params.ray_origin = toFloat4(renderer.camera().ray_origin);
  params.ray_dx = toFloat4(renderer.camera().ray_dx);
  params.ray_dy = toFloat4(renderer.camera().ray_dy);
  params.plane_stride = static_cast<uint>(planes.stride);
  KernelConfig config = renderer.configs().front();
  config.width = 1;
  const std::size_t plane_bytes = planes.mask.size() * planes.stride * 4;
  Buffer words(device, plane_bytes, BufferPurpose::kPlanes),
      frame(device, sizeof params, BufferPurpose::kFrameParams);
  Buffer out(device, planes.stride * 24, BufferPurpose::kProbe);
  words.write(planes.storage.data(), plane_bytes);
  frame.write(&params, sizeof params);
  ProgramCache cache(device);
  const KernelArg args[] = {words, frame, light.x, light.y, light.z, out};
  cache.get("probes/probe_pixel.cl", config).kernel("probePixels").launch(args, planes.stride, 16);
  std::vector<float> result(planes.stride * 6);
  out.read(result.data(), result.size() * 4);
  return result;
}

// What the method looks things up in; empty for most.
std::vector<float> methodsTable(Device& device, const KernelConfig& config) {
  const std::optional<Buffer> table = glintTable(device, config, BufferPurpose::kProbe);
  if (!table) return {};
  std::vector<float> floats(table->bytes() / sizeof(float));
  table->read(floats.data(), table->bytes());
  return floats;
}

void write(const std::string& method, const std::string& path) {
  Scene scene = floorScene();
  scene.materials[0].params.glints.size_variation = 1;
  ShadingOptions options;
  options.width_px = 160;
  options.height_px = 90;
  options.method = parseMethod(method);
  Device device;
  FrameRenderer renderer(device, scene, lookingDown(20), options, 1);
  renderer.prepare();
  renderer.shade();
  const Image image = renderer.readRadiance();
  const PixelPlanes& planes = renderer.planes();
  const LightParams light = prepareLights(scene.lights).front();

  HitsHeader header{};
  static_assert(sizeof header.material == sizeof(MaterialParams));
  std::strncpy(header.device, device.info().name.c_str(), sizeof header.device - 1);
  header.count = static_cast<std::uint32_t>(planes.stride);
  header.material_bytes = sizeof(MaterialParams);
  const float irradiance[] = {light.power.x, light.power.y, light.power.z, 0};
  std::copy(std::begin(irradiance), std::end(irradiance), header.irradiance);
  const MaterialParams material = withGlintGrids(scene.materials[0].params);
  std::memcpy(header.material, &material, sizeof header.material);

  const std::vector<float> table = methodsTable(device, renderer.configs().front());
  header.table_floats = static_cast<std::uint32_t>(table.size());

  std::ofstream file(path, std::ios::binary);
  append(file, &header, 1);
  const std::vector<float> vectors = directions(device, renderer, light.direction);
  append(file, vectors.data(), vectors.size());
  for (const Plane plane : kUvPlanes) append(file, planes.plane(plane).data(), planes.stride);
  float brightest = 0;
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<float> values;
    for (const std::uint32_t pixel : planes.plane(Plane::kPixel)) {
      const std::size_t at = (pixel >> 16) * 160u + (pixel & 0xFFFFu);
      values.push_back(image.pixels[at * 4 + static_cast<std::size_t>(channel)]);
    }
    brightest = std::max(brightest, *std::ranges::max_element(values));
    append(file, values.data(), values.size());
  }
  append(file, table.data(), table.size());
  if (!(brightest > 0)) throw Error("the frame is black");
  if (!file.flush()) throw Error("cannot write '" + path + "'");
}

}  // namespace
}  // namespace glintmark

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: write_hits METHOD FILE\n");
    return 2;
  }
  try {
    glintmark::write(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_hits: %s\n", error.what());
    return 1;
  }
}
