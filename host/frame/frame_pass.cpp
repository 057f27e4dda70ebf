#include "host/frame/frame_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "host/core/error.h"
#include "host/core/float4.h"
#include "host/core/stopwatch.h"
#include "host/core/trace.h"
#include "host/frame/all_materials.h"
#include "host/frame/effect/lights.h"
#include "host/frame/effect_module.h"
#include "host/frame/effects.h"
#include "host/ocl/upload.h"

namespace glintmark {
namespace {

constexpr std::size_t kLocalSize = 64;

struct AllMaterials {
  Buffer buffer;
};

}  // namespace

FramePass::FramePass(const PassKernel& kernel, Device& device, const Scene& scene, const View& view,
                     const ShadingOptions& options, int thread_count,
                     std::shared_ptr<NormalTextures> textures)
    : kernel_(kernel),
      view_name_(view.name),
      device_(device),
      scene_(scene),
      options_(options),
      cache_(device),
      textures_(textures ? std::move(textures) : std::make_shared<NormalTextures>(device)),
      rasterizer_(thread_count),
      camera_(makeCamera(view, options.width_px, options.height_px)),
      lanes_(options.lanes > 0 ? options.lanes : device.info().default_lanes),
      resources_(device, scene, options_, *textures_, camera_.eye) {
  if (kernel_.truth) options_.programs = Programs::kPerMaterial;
}

PlaneMask FramePass::planes() const {
  return kernel_.truth ? truthPlanesFor(scene_, options_) : planesFor(scene_, options_);
}

void FramePass::makeBands() {
  // The planes are the largest buffer, unless there are fewer of them than of results.
  const std::size_t words = std::max(planes().size(), kernel_.result_planes);
  const std::size_t row_bytes = words * 4 * static_cast<std::size_t>(camera_.width_px);
  const std::size_t padding_bytes = words * 4 * GM_LIST_PADDING * scene_.materials.size();
  const std::size_t stated = device_.info().max_alloc_bytes;
  const std::size_t limit = stated > 0 ? stated : std::numeric_limits<std::size_t>::max();
  const std::size_t rows = limit > padding_bytes ? (limit - padding_bytes) / row_bytes : 0;
  const int band_rows = static_cast<int>(
      std::clamp<std::size_t>(rows, 1, static_cast<std::size_t>(camera_.height_px)));

  for (int top = 0; top < camera_.height_px; top += band_rows) {
    Band band;
    band.top_px = top;
    band.camera = camera_;
    band.camera.height_px = std::min(band_rows, camera_.height_px - top);
    band.camera.ray_origin = camera_.ray(0, top);
    bands_.push_back(std::move(band));
  }
}

void FramePass::makeLights() {
  const bool cuts = options_.light_cut != LightCut::kAll && !kernel_.truth;
  const std::vector<LightParams> prepared =
      cuts ? prepareLightTree(scene_.lights) : prepareLights(scene_.lights);
  light_count_ = static_cast<uint>(prepared.size());
  lights_ = upload(device_, prepared, BufferPurpose::kLights);
}

void FramePass::makeBuffers(Band& band, FrameTimes& times) {
  const PixelPlanes& planes = band.planes;
  const std::size_t plane_bytes = planes.mask.size() * planes.stride * 4;
  if (plane_bytes == 0) return;  // an empty frame launches nothing
  band.plane_buffer =
      Buffer::wrapHost(device_, band.planes.storage.data(), plane_bytes, BufferPurpose::kPlanes);
  times.upload_ns += band.plane_buffer.write(planes.storage.data(), plane_bytes);
  band.results =
      Buffer(device_, planes.stride * 4 * kernel_.result_planes, BufferPurpose::kRadiance);
  band.results.fill(kernel_.truth ? 0 : kUnwrittenWord);
  if (!options_.count_cells) return;
  band.counts = Buffer(device_, 2 * planes.stride * 4, BufferPurpose::kCellCounts);
  band.counts.fill(kUnwrittenWord);
}

// Rasterizes into the planes' own memory, and puts them into the order that the programs want.
void FramePass::rasterize(Band& band) {
  rasterizer_.render(scene_.mesh, band.camera, scene_.cull_back_faces, planes(), band.planes);
  if (options_.programs == Programs::kPerMaterial) return;
  std::vector<std::uint32_t> owners = entryOwners(band.planes);
  if (options_.programs == Programs::kFullScreen) band.planes = inScreenOrder(band.planes, owners);
  band.owners = upload(device_, owners, BufferPurpose::kOwners);
}

KernelConfig FramePass::configOf(const Material& material) const {
  if (kernel_.truth) return truthConfigFor(material, scene_, options_, lanes_);
  if (options_.programs != Programs::kPerMaterial) return configForAll(scene_, options_, lanes_);
  return configFor(material, scene_, options_, lanes_);
}

Buffer FramePass::materialBuffer(const Material& material, const KernelConfig& config) {
  if (!config.all_materials)
    return upload(device_, std::vector{preparedMaterial(material, config)},
                  BufferPurpose::kMaterials);
  return resources_
      .kept<AllMaterials>(
          [&] { return AllMaterials{uploadMaterials(device_, scene_, options_, config.width)}; })
      .buffer;
}

Buffer FramePass::frameParams(const Band& band, const PixelList& list, const KernelConfig& config) {
  FrameParams params{};
  params.ray_origin = toFloat4(band.camera.ray_origin);
  params.ray_dx = toFloat4(band.camera.ray_dx);
  params.ray_dy = toFloat4(band.camera.ray_dy);
  params.light_count = light_count_;
  params.list_offset = list.offset;
  params.list_count = list.count;
  params.plane_stride = static_cast<uint>(band.planes.stride);
  for (const Effect effect : effectsOf(config).list())
    if (const EffectModule& module = effectModule(effect); module.describe)
      module.describe(resources_, config, params);
  return upload(device_, std::vector{params}, BufferPurpose::kFrameParams);
}

ShadeArguments FramePass::argumentsOf(const Band& band, const PixelList& list,
                                      const KernelConfig& config) {
  const Material& material = scene_.materials[list.material];
  ShadeArguments arguments({.planes = band.plane_buffer,
                            .frame = frameParams(band, list, config),
                            .material = materialBuffer(material, config),
                            .lights = lights_});
  for (const Effect effect : effectsOf(config).list())
    if (const EffectModule& module = effectModule(effect); module.add_arguments)
      module.add_arguments(resources_, material, config, arguments);
  if (config.all_materials) arguments.add("owners", band.owners);
  arguments.add(kernel_.result, band.results);
  if (config.count_cells) arguments.add("cell_counts", band.counts);
  for (const char* number : kernel_.numbers) arguments.add(number, std::uint32_t{0});
  return arguments;
}

FramePass::Launch FramePass::makeLaunch(const Band& band, const PixelList& list) {
  KernelConfig config = configOf(scene_.materials[list.material]);
  config.planes = band.planes.mask;
  Program program = cache_.get(kernel_.file, config);
  build_ns_ += program.buildNs();
  Kernel kernel = program.kernel(kernel_.name);
  ShadeArguments arguments = argumentsOf(band, list, config);
  arguments.requireNamesOf(kernel);
  return {list, config, std::move(program), std::move(kernel), std::move(arguments)};
}

void FramePass::makeLaunches(Band& band) {
  band.launches.clear();
  for (const PixelList& list : band.planes.lists) {
    band.launches.push_back(makeLaunch(band, list));
    const KernelConfig& config = band.launches.back().config;
    if (std::ranges::find(configs_, config) == configs_.end()) configs_.push_back(config);
  }
}

FrameTimes FramePass::prepare() {
  const TraceScope scope("frame", "prepare");
  FrameTimes times;
  if (bands_.empty()) makeBands();  // later calls reuse their memory
  makeLights();
  configs_.clear();
  for (Band& band : bands_) {
    const Stopwatch watch;
    {
      const TraceScope raster_scope("frame", "rasterize");
      rasterize(band);
    }
    times.raster_ns += watch.elapsedNs();
    makeBuffers(band, times);
    makeLaunches(band);
  }
  requirePixels();
  return times;
}

void FramePass::requirePixels() const {
  if (options_.may_show_nothing) return;
  if (!std::ranges::all_of(bands_, [](const Band& band) { return band.planes.lists.empty(); }))
    return;
  throw Error(fmt::format(
      "view {} of {} covers no pixel of {}x{}, expected a camera that looks at the scene's meshes",
      view_name_, scene_.name, camera_.width_px, camera_.height_px));
}

void FramePass::setNumber(std::string_view name, std::uint32_t value) {
  for (Band& band : bands_)
    for (Launch& launch : band.launches) launch.arguments.set(name, value);
}

void FramePass::clearResults() {
  for (Band& band : bands_)
    if (!band.results.empty()) band.results.fillZero();
}

FrameTimes FramePass::launch() {
  FrameTimes times;
  for (Band& band : bands_)
    for (Launch& launch : band.launches) {
      const auto width = static_cast<std::size_t>(launch.config.width);
      const std::size_t items = (launch.list.count + width - 1) / width;
      const LaunchTimes t = launch.kernel.launch(launch.arguments.values(), items, kLocalSize);
      times.shading_event_ns += t.event_ns;
      times.shading_wall_ns += t.wall_ns;
      times.launch_event_ns.push_back(t.event_ns);
    }
  return times;
}

}  // namespace glintmark
