#include "host/frame/frame_renderer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "host/core/error.h"
#include "host/core/stopwatch.h"
#include "host/frame/effects.h"
#include "host/frame/lights.h"
#include "host/ocl/compute.h"

namespace glintmark {
namespace {

constexpr std::size_t kLocalSize = 64;
constexpr std::uint32_t kLimitedBit = 0x80000000u;

float4 toFloat4(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
}

// A small read-only buffer holding `items`; at least one element, so that no buffer is empty.
template <typename T>
Buffer uploadItems(Device& device, std::vector<T> items, const std::string& what) {
  if (items.empty()) items.resize(1);
  Buffer buffer(device, items.size() * sizeof(T), what);
  buffer.write(items.data(), items.size() * sizeof(T));
  return buffer;
}

}  // namespace

struct FrameRenderer::Impl {
  // One material's share of the frame.
  struct Launch {
    PixelList list;
    KernelConfig config;
    Kernel kernel;
    Buffer frame_params;
    Buffer material;
  };

  Impl(Device& device_, const Scene& scene_, const View& view, const ShadingOptions& options_,
       int thread_count)
      : device(device_),
        scene(scene_),
        options(options_),
        cache(device_),
        rasterizer(thread_count),
        camera(makeCamera(view, options_.width_px, options_.height_px)),
        lanes(options_.lanes > 0 ? options_.lanes : device_.info().default_lanes) {}

  void makeLaunches();
  void makeBuffers(FrameTimes& times);
  std::vector<KernelArg> arguments(const Launch& launch) const;
  std::vector<std::uint32_t> readCounts() const;

  Device& device;
  const Scene& scene;
  ShadingOptions options;
  ProgramCache cache;
  Rasterizer rasterizer;
  Camera camera;
  int lanes;

  PixelPlanes planes;
  std::vector<Launch> launches;
  std::vector<KernelConfig> configs;
  Buffer plane_buffer, lights, taps, radiance, counts;
  uint light_count = 0;
  double build_ns = 0;
};

void FrameRenderer::Impl::makeBuffers(FrameTimes& times) {
  const std::size_t plane_bytes = planes.mask.size() * planes.stride * 4;
  plane_buffer = Buffer::wrapHost(device, planes.storage.data(),
                                  std::max<std::size_t>(plane_bytes, 4), "the rasterized planes");
  times.upload_ns = plane_bytes > 0 ? plane_buffer.write(planes.storage.data(), plane_bytes) : 0;
  radiance = Buffer(device, std::max<std::size_t>(planes.stride, 1) * 12, "the radiance");
  if (options.count_cells)
    counts = Buffer(device, std::max<std::size_t>(planes.stride, 1) * 4, "the cell counts");

  PreparedLights prepared = prepareLights(scene.lights);
  light_count = static_cast<uint>(prepared.lights.size());
  lights = uploadItems(device, std::move(prepared.lights), "the lights");
  taps = uploadItems(device, std::move(prepared.taps), "the lights' taps");
}

void FrameRenderer::Impl::makeLaunches() {
  launches.clear();
  configs.clear();
  for (const PixelList& list : planes.lists) {
    const Material& material = scene.materials[list.material];
    Launch launch;
    launch.list = list;
    launch.config = configFor(material, scene, options, lanes);
    launch.config.planes = planes.mask;
    const Program program = cache.get("shade.cl", launch.config);
    build_ns += program.buildNs();
    launch.kernel = program.kernel("shade");

    FrameParams params{};
    params.ray_origin = toFloat4(camera.ray_origin);
    params.ray_dx = toFloat4(camera.ray_dx);
    params.ray_dy = toFloat4(camera.ray_dy);
    params.light_count = light_count;
    params.list_offset = list.offset;
    params.list_count = list.count;
    params.plane_stride = static_cast<uint>(planes.stride);
    launch.frame_params = uploadItems(device, std::vector{params}, "the frame's parameters");
    launch.material = uploadItems(device, std::vector{material.glint}, "a material");
    configs.push_back(launch.config);
    launches.push_back(std::move(launch));
  }
}

std::vector<KernelArg> FrameRenderer::Impl::arguments(const Launch& launch) const {
  std::vector<KernelArg> args = {plane_buffer, launch.frame_params, launch.material, lights, taps,
                                 radiance};
  if (launch.config.count_cells) args.emplace_back(counts);
  return args;
}

std::vector<std::uint32_t> FrameRenderer::Impl::readCounts() const {
  if (!options.count_cells)
    throw Error("cells were not counted: set ShadingOptions::count_cells before shading");
  std::vector<std::uint32_t> words(planes.stride);
  if (!words.empty()) counts.read(words.data(), words.size() * 4);
  return words;
}

FrameRenderer::FrameRenderer(Device& device, const Scene& scene, const View& view,
                             const ShadingOptions& options, int thread_count)
    : impl_(std::make_unique<Impl>(device, scene, view, options, thread_count)) {}
FrameRenderer::~FrameRenderer() = default;

FrameTimes FrameRenderer::prepare() {
  FrameTimes times;
  const Stopwatch watch;
  impl_->rasterizer.render(impl_->scene.mesh, impl_->camera, impl_->scene.cull_back_faces,
                           planesFor(impl_->scene, impl_->options), impl_->planes);
  times.raster_ns = watch.elapsedNs();
  impl_->makeBuffers(times);
  impl_->makeLaunches();
  return times;
}

FrameTimes FrameRenderer::shade() {
  FrameTimes times;
  for (Impl::Launch& launch : impl_->launches) {
    const auto lanes = static_cast<std::size_t>(launch.config.width);
    const std::size_t items = (launch.list.count + lanes - 1) / lanes;
    const LaunchTimes t = launch.kernel.launch(impl_->arguments(launch), items, kLocalSize);
    times.shading_event_ns += t.event_ns;
    times.shading_wall_ns += t.wall_ns;
  }
  return times;
}

Image FrameRenderer::readRadiance(FrameTimes* times) {
  const PixelPlanes& planes = impl_->planes;
  std::vector<float> words(planes.stride * 3);
  const Stopwatch watch;
  if (!words.empty()) impl_->radiance.read(words.data(), words.size() * 4);
  if (times) times->readback_ns = watch.elapsedNs();

  Image image(planes.width_px, planes.height_px, 4);
  image.channel_names = {"R", "G", "B", "A"};
  const auto pixels = planes.plane(Plane::kPixel);
  for (const PixelList& list : planes.lists)
    tbb::parallel_for(list.offset, list.offset + list.count, [&](std::uint32_t i) {
      const auto out =
          image.at(static_cast<int>(pixels[i] & 0xFFFFu), static_cast<int>(pixels[i] >> 16));
      for (std::size_t c = 0; c < 3; ++c) out[c] = words[c * planes.stride + i];
      out[3] = 1.0f;
    });
  return image;
}

Image FrameRenderer::readCells() {
  const PixelPlanes& planes = impl_->planes;
  const std::vector<std::uint32_t> words = impl_->readCounts();
  Image image(planes.width_px, planes.height_px, 1);
  image.channel_names = {"cells"};
  std::ranges::fill(image.pixels, -1.0f);
  const auto pixels = planes.plane(Plane::kPixel);
  for (const Impl::Launch& launch : impl_->launches) {
    if (!launch.config.count_cells) continue;
    for (std::uint32_t i = launch.list.offset; i < launch.list.offset + launch.list.count; ++i)
      image.at(static_cast<int>(pixels[i] & 0xFFFFu), static_cast<int>(pixels[i] >> 16))[0] =
          static_cast<float>(words[i] & ~kLimitedBit);
  }
  return image;
}

CellCounts FrameRenderer::cellCounts() {
  const std::vector<std::uint32_t> words = impl_->readCounts();
  CellCounts result;
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  double total = 0;
  for (const Impl::Launch& launch : impl_->launches) {
    if (!launch.config.count_cells) continue;
    for (std::uint32_t i = launch.list.offset; i < launch.list.offset + launch.list.count; ++i) {
      const std::uint32_t cells = words[i] & ~kLimitedBit;
      if (cells == 0) continue;
      least = std::min(least, cells);
      result.max = std::max(result.max, cells);
      total += cells;
      ++result.glint_px;
      if (words[i] & kLimitedBit) ++result.guard_hits;
    }
  }
  result.min = result.glint_px > 0 ? least : 0;
  result.mean = result.glint_px > 0 ? total / static_cast<double>(result.glint_px) : 0;
  return result;
}

const PixelPlanes& FrameRenderer::planes() const {
  return impl_->planes;
}
const Camera& FrameRenderer::camera() const {
  return impl_->camera;
}
const std::vector<KernelConfig>& FrameRenderer::configs() const {
  return impl_->configs;
}
double FrameRenderer::buildNs() const {
  return impl_->build_ns;
}

double FrameRenderer::firstEnqueueNs() const {
  double total = 0;
  for (const Impl::Launch& launch : impl_->launches) total += launch.kernel.firstEnqueueNs();
  return total;
}

std::size_t FrameRenderer::bufferBytes() const {
  return impl_->plane_buffer.bytes() + impl_->radiance.bytes() +
         (impl_->counts.empty() ? 0 : impl_->counts.bytes());
}

}  // namespace glintmark
