#include "host/frame/frame_renderer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>

#include "host/core/error.h"
#include "host/core/stopwatch.h"
#include "host/core/trace.h"
#include "host/frame/all_materials.h"
#include "host/frame/effect/area_lights.h"
#include "host/frame/effect/lights.h"
#include "host/frame/effect/multiscatter.h"
#include "host/frame/effects.h"
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
    Program program;
    Kernel kernel;
    Buffer frame_params;
    Buffer material;
    Buffer map_layout, map_texels;  // of a normal map, if the material has one
    Buffer scatter;                 // of multiple scattering, if the material has it
    std::vector<KernelArg> area_args;
  };

  // Rows of the frame that fit into the device's largest buffer; as a rule there is one band.
  struct Band {
    Camera camera;
    int top_px = 0;
    PixelPlanes planes;
    std::vector<Launch> launches;
    Buffer plane_buffer, radiance, counts;
    Buffer owners;  // material of every entry, for programs that serve all materials
  };

  Impl(Device& device_, const Scene& scene_, const View& view, const ShadingOptions& options_,
       int thread_count, std::shared_ptr<NormalTextures> textures_)
      : device(device_),
        scene(scene_),
        options(options_),
        cache(device_),
        textures(textures_ ? std::move(textures_) : std::make_shared<NormalTextures>(device_)),
        rasterizer(thread_count),
        camera(makeCamera(view, options_.width_px, options_.height_px)),
        lanes(options_.lanes > 0 ? options_.lanes : device_.info().default_lanes) {}

  void makeBands();
  void makeLights();
  void makeBuffers(Band& band, FrameTimes& times);
  void rasterize(Band& band);
  Launch makeLaunch(const Band& band, const PixelList& list);
  void setMaterial(Launch& launch, const Material& material);
  void makeLaunches(Band& band);
  FrameTimes launchAll(const std::vector<KernelArg>& last_args);
  Image readPlanes(std::size_t first_plane, double& readback_ns) const;
  std::vector<KernelArg> arguments(const Band& band, const Launch& launch) const;
  void forEachCount(
      const std::function<void(const Band&, std::uint32_t entry, std::uint32_t word)>& visit) const;

  Device& device;
  const Scene& scene;
  ShadingOptions options;
  ProgramCache cache;
  std::shared_ptr<NormalTextures> textures;
  Rasterizer rasterizer;
  Camera camera;
  int lanes;

  std::vector<Band> bands;
  std::vector<KernelConfig> configs;
  Buffer lights, taps;
  std::optional<AreaLightBuffers> area_lights;
  std::optional<MaterialArrays> arrays;  // of a program for all materials
  uint light_count = 0;
  double build_ns = 0;
};

void FrameRenderer::Impl::makeBands() {
  // The planes are the largest buffer, unless there are fewer of them than of radiance channels and
  // their squares.
  const std::size_t words =
      std::max<std::size_t>(planesFor(scene, options).size(), options.truth ? 6 : 3);
  const std::size_t row_bytes = words * 4 * static_cast<std::size_t>(camera.width_px);
  const std::size_t padding_bytes = words * 4 * GM_LIST_PADDING * scene.materials.size();
  const std::size_t limit = device.info().max_alloc_bytes;
  const std::size_t rows = limit > padding_bytes ? (limit - padding_bytes) / row_bytes : 0;
  const int band_rows = static_cast<int>(
      std::clamp<std::size_t>(rows, 1, static_cast<std::size_t>(camera.height_px)));

  for (int top = 0; top < camera.height_px; top += band_rows) {
    Band band;
    band.top_px = top;
    band.camera = camera;
    band.camera.height_px = std::min(band_rows, camera.height_px - top);
    band.camera.ray_origin = camera.ray(0, top);
    bands.push_back(std::move(band));
  }
}

void FrameRenderer::Impl::makeLights() {
  PreparedLights prepared = prepareLights(scene.lights);
  light_count = static_cast<uint>(prepared.lights.size());
  lights = uploadItems(device, std::move(prepared.lights), "the lights");
  taps = uploadItems(device, std::move(prepared.taps), "the lights' taps");
  if (!area_lights) area_lights.emplace(device, scene, camera.eye, options.ltc_table);
}

void FrameRenderer::Impl::makeBuffers(Band& band, FrameTimes& times) {
  const PixelPlanes& planes = band.planes;
  const std::size_t plane_bytes = planes.mask.size() * planes.stride * 4;
  if (plane_bytes == 0) return;  // an empty frame launches nothing
  band.plane_buffer =
      Buffer::wrapHost(device, planes.storage.data(), plane_bytes, "the rasterized planes");
  times.upload_ns += band.plane_buffer.write(planes.storage.data(), plane_bytes);
  band.radiance = Buffer(device, planes.stride * (options.truth ? 24 : 12), "the radiance");
  if (options.truth) band.radiance.fillZero();
  if (options.count_cells) band.counts = Buffer(device, planes.stride * 4, "the cell counts");
}

// Rasterizes into the planes' own memory, and puts them into the order that the programs want.
void FrameRenderer::Impl::rasterize(Band& band) {
  const PlaneMask mask = planesFor(scene, options);
  rasterizer.render(scene.mesh, band.camera, scene.cull_back_faces, mask, band.planes);
  if (options.programs == Programs::kPerMaterial) return;
  std::vector<std::uint32_t> owners = entryOwners(band.planes);
  if (options.programs == Programs::kFullScreen) band.planes = inScreenOrder(band.planes, owners);
  band.owners = uploadItems(device, std::move(owners), "the materials of the pixels");
}

// The buffers of one material.
void FrameRenderer::Impl::setMaterial(Launch& launch, const Material& material) {
  launch.material = uploadItems(device, std::vector{material.params}, "a material");
  if (launch.config.normal_map) {
    const NormalTexture& texture = textures->get(material.normal_map->map, launch.config,
                                                 options.mixture_order, options.mixture_iterations);
    launch.map_layout = texture.layout;
    launch.map_texels = texture.texels;
  }
  if (launch.config.multiscatter != Multiscatter::kOff || launch.config.metal_compensation)
    launch.scatter = uploadItems(device, std::vector{prepareMultiscatter(material, launch.config)},
                                 "a material's scattering");
}

FrameRenderer::Impl::Launch FrameRenderer::Impl::makeLaunch(const Band& band,
                                                            const PixelList& list) {
  const Material& material = scene.materials[list.material];
  const bool for_all = options.programs != Programs::kPerMaterial;
  Launch launch;
  launch.list = list;
  launch.config =
      for_all ? configForAll(scene, options, lanes) : configFor(material, scene, options, lanes);
  launch.config.planes = band.planes.mask;
  launch.program = cache.get(options.truth ? "truth.cl" : "shade.cl", launch.config);
  build_ns += launch.program.buildNs();
  launch.kernel = launch.program.kernel(options.truth ? "truth" : "shade");
  if (for_all) {
    if (!arrays) arrays = uploadMaterialArrays(device, scene, options, launch.config, *textures);
    launch.material = arrays->materials;
    launch.scatter = arrays->scatter;
    launch.map_layout = arrays->map_layouts;
    launch.map_texels = arrays->map_texels;
  } else {
    setMaterial(launch, material);
  }

  FrameParams params{};
  params.ray_origin = toFloat4(band.camera.ray_origin);
  params.ray_dx = toFloat4(band.camera.ray_dx);
  params.ray_dy = toFloat4(band.camera.ray_dy);
  params.light_count = light_count;
  params.list_offset = list.offset;
  params.list_count = list.count;
  params.plane_stride = static_cast<uint>(band.planes.stride);
  area_lights->describe(launch.config, params);
  launch.area_args = area_lights->arguments(launch.config);
  launch.frame_params = uploadItems(device, std::vector{params}, "the frame's parameters");
  return launch;
}

void FrameRenderer::Impl::makeLaunches(Band& band) {
  band.launches.clear();
  for (const PixelList& list : band.planes.lists) {
    band.launches.push_back(makeLaunch(band, list));
    const KernelConfig& config = band.launches.back().config;
    if (std::ranges::find(configs, config) == configs.end()) configs.push_back(config);
  }
}

std::vector<KernelArg> FrameRenderer::Impl::arguments(const Band& band,
                                                      const Launch& launch) const {
  std::vector<KernelArg> args = {band.plane_buffer, launch.frame_params, launch.material, lights,
                                 taps};
  if (launch.config.normal_map) {
    args.emplace_back(launch.map_layout);
    args.emplace_back(launch.map_texels);
  }
  if (!launch.scatter.empty()) args.emplace_back(launch.scatter);
  args.insert(args.end(), launch.area_args.begin(), launch.area_args.end());
  if (launch.config.all_materials) args.emplace_back(band.owners);
  args.emplace_back(band.radiance);
  if (launch.config.count_cells) args.emplace_back(band.counts);
  return args;
}

// Visits the count of every pixel of glint materials.
void FrameRenderer::Impl::forEachCount(
    const std::function<void(const Band&, std::uint32_t, std::uint32_t)>& visit) const {
  if (!options.count_cells)
    throw Error("cells were not counted: set ShadingOptions::count_cells before shading");
  for (const Band& band : bands) {
    std::vector<std::uint32_t> words(band.planes.stride);
    if (!words.empty()) band.counts.read(words.data(), words.size() * 4);
    for (const Launch& launch : band.launches) {
      if (!launch.config.count_cells) continue;
      const std::uint32_t end = launch.list.offset + launch.list.count;
      for (std::uint32_t i = launch.list.offset; i < end; ++i) visit(band, i, words[i]);
    }
  }
}

FrameRenderer::FrameRenderer(Device& device, const Scene& scene, const View& view,
                             const ShadingOptions& options, int thread_count,
                             std::shared_ptr<NormalTextures> textures)
    : impl_(std::make_unique<Impl>(device, scene, view, options, thread_count,
                                   std::move(textures))) {}
FrameRenderer::~FrameRenderer() = default;

FrameTimes FrameRenderer::prepare() {
  const TraceScope scope("frame", "prepare");
  FrameTimes times;
  if (impl_->bands.empty()) impl_->makeBands();  // later calls reuse their memory
  impl_->makeLights();
  impl_->configs.clear();
  for (Impl::Band& band : impl_->bands) {
    const Stopwatch watch;
    {
      const TraceScope raster_scope("frame", "rasterize");
      impl_->rasterize(band);
    }
    times.raster_ns += watch.elapsedNs();
    impl_->makeBuffers(band, times);
    impl_->makeLaunches(band);
  }
  return times;
}

FrameTimes FrameRenderer::Impl::launchAll(const std::vector<KernelArg>& last_args) {
  FrameTimes times;
  for (Band& band : bands)
    for (Launch& launch : band.launches) {
      const auto width = static_cast<std::size_t>(launch.config.width);
      const std::size_t items = (launch.list.count + width - 1) / width;
      std::vector<KernelArg> args = arguments(band, launch);
      args.insert(args.end(), last_args.begin(), last_args.end());
      const LaunchTimes t = launch.kernel.launch(args, items, kLocalSize);
      times.shading_event_ns += t.event_ns;
      times.shading_wall_ns += t.wall_ns;
      times.launch_event_ns.push_back(t.event_ns);
    }
  return times;
}

// Three planes of `radiance` from `first_plane` on as an RGBA image.
Image FrameRenderer::Impl::readPlanes(std::size_t first_plane, double& readback_ns) const {
  Image image(camera.width_px, camera.height_px, 4);
  image.channel_names = {"R", "G", "B", "A"};
  for (const Band& band : bands) {
    const PixelPlanes& planes = band.planes;
    std::vector<float> words(planes.stride * 3);
    if (!words.empty())
      readback_ns +=
          band.radiance.read(words.data(), words.size() * 4, first_plane * planes.stride * 4);
    const auto pixels = planes.plane(Plane::kPixel);
    for (const PixelList& list : planes.lists)
      tbb::parallel_for(list.offset, list.offset + list.count, [&](std::uint32_t i) {
        const auto out = image.at(static_cast<int>(pixels[i] & 0xFFFFu),
                                  band.top_px + static_cast<int>(pixels[i] >> 16));
        for (std::size_t c = 0; c < 3; ++c) out[c] = words[c * planes.stride + i];
        out[3] = 1.0f;
      });
  }
  return image;
}

FrameTimes FrameRenderer::shade() {
  const TraceScope scope("frame", "shade");
  if (impl_->options.truth) throw Error("a renderer of the ground truth does not shade");
  return impl_->launchAll({});
}

FrameTimes FrameRenderer::addTruthSamples(std::uint32_t sample_begin, std::uint32_t sample_count) {
  const TraceScope scope("frame", "truth samples");
  if (!impl_->options.truth)
    throw Error("samples of the ground truth need a renderer with ShadingOptions::truth");
  return impl_->launchAll({sample_begin, sample_count});
}

Image FrameRenderer::readRadiance(FrameTimes* times) {
  const TraceScope scope("frame", "read back");
  double readback_ns = 0;
  Image image = impl_->readPlanes(0, readback_ns);
  if (times) times->readback_ns = readback_ns;
  return image;
}

Image FrameRenderer::readSquares() {
  if (!impl_->options.truth) throw Error("only the ground truth has squares of its samples");
  double readback_ns = 0;
  return impl_->readPlanes(3, readback_ns);
}

Image FrameRenderer::readCells() {
  Image image(impl_->camera.width_px, impl_->camera.height_px, 1);
  image.channel_names = {"cells"};
  std::ranges::fill(image.pixels, -1.0f);
  impl_->forEachCount([&](const Impl::Band& band, std::uint32_t entry, std::uint32_t word) {
    const std::uint32_t pixel = band.planes.plane(Plane::kPixel)[entry];
    image.at(static_cast<int>(pixel & 0xFFFFu), band.top_px + static_cast<int>(pixel >> 16))[0] =
        static_cast<float>(word & ~kLimitedBit);
  });
  return image;
}

CellCounts FrameRenderer::cellCounts() {
  CellCounts result;
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  double total = 0;
  impl_->forEachCount([&](const Impl::Band&, std::uint32_t, std::uint32_t word) {
    const std::uint32_t cells = word & ~kLimitedBit;
    if (cells == 0) return;
    least = std::min(least, cells);
    result.max = std::max(result.max, cells);
    total += cells;
    ++result.glint_px;
    if (word & kLimitedBit) ++result.guard_hits;
  });
  result.min = result.glint_px > 0 ? least : 0;
  result.mean = result.glint_px > 0 ? total / static_cast<double>(result.glint_px) : 0;
  return result;
}

const PixelPlanes& FrameRenderer::planes() const {
  if (impl_->bands.size() != 1)
    throw Error(
        "the planes of this frame do not lie in one piece: call prepare() first, and choose a size "
        "whose planes fit into the device's largest buffer");
  return impl_->bands.front().planes;
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
  for (const Impl::Band& band : impl_->bands)
    for (const Impl::Launch& launch : band.launches) total += launch.kernel.firstEnqueueNs();
  return total;
}

std::vector<ProgramBuild> FrameRenderer::builds() const {
  std::vector<ProgramBuild> builds;
  for (const Impl::Band& band : impl_->bands)
    for (const Impl::Launch& launch : band.launches) {
      // Programs that were in memory took no time.
      if (std::ranges::find(builds, launch.config, &ProgramBuild::config) != builds.end()) continue;
      builds.push_back({launch.config, launch.program.buildNs(), launch.kernel.firstEnqueueNs(),
                        launch.program.fromDiskCache()});
    }
  return builds;
}

std::size_t FrameRenderer::bufferBytes() const {
  std::size_t bytes = 0;
  for (const Impl::Band& band : impl_->bands)
    for (const Buffer* buffer : {&band.plane_buffer, &band.radiance, &band.counts})
      if (!buffer->empty()) bytes += buffer->bytes();
  return bytes;
}

}  // namespace glintmark
