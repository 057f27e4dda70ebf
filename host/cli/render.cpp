// glintmark render: one picture of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "host/cli/command_line.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/trace.h"
#include "host/experiment/zoom_strip.h"
#include "host/frame/frame_renderer.h"
#include "host/frame/shading_options.h"
#include "host/ocl/device_clock.h"
#include "host/ocl/switches.h"
#include "host/report/picture/aov.h"
#include "host/report/picture/image_io.h"
#include "host/report/picture/star.h"
#include "host/report/picture/tonemap.h"
#include "host/report/record/trace_file.h"

namespace glintmark {
namespace {

// Closest to placed microdetails (docs/accuracy.md); what is measured keeps the paper's.
constexpr GlintMethod kRenderMethod = GlintMethod::kDistributed;

struct RenderOptions {
  std::string scene, view, output, aov_output, trace;
  std::string size = "1920x1080", method = choiceName(kRenderMethod);
  int zoom = 0;  // octaves; 0: one picture
  bool no_glints = false;
  bool star = false, star_chosen = false;
  std::optional<double> exposure;
};

void printTimes(const std::string& what, const FrameTimes& raster, const FrameTimes& shading,
                double readback_ns, Timer timer) {
  const bool by_wall = timer == Timer::kWall;
  fmt::print("{}: raster {:.1f} ms, upload {:.1f} ms, shading {:.1f} ms{}, readback {:.1f} ms\n",
             what, raster.raster_ns * 1e-6, raster.upload_ns * 1e-6,
             (by_wall ? shading.shading_wall_ns : shading.shading_event_ns) * 1e-6,
             by_wall ? " by the wall clock" : "", readback_ns * 1e-6);
}

// PNG gets the scene's post effects. EXR holds radiance for measuring, with the star only on
// demand.
void writeRendered(Image radiance, const RenderOptions& options, const PostEffects& post,
                   const std::string& extension) {
  const bool is_png = extension == ".png";
  const double exposure = options.exposure.value_or(post.exposure);
  if (options.star_chosen ? options.star : is_png && post.star) {
    applyStar(radiance, {.threshold = 1 / exposure});  // exposed radiance 1
  }
  if (is_png) {
    writePng(toneMap(radiance, {.exposure = exposure}), options.output);
  } else {
    writeExr(radiance, options.output);
  }
}

// Pixels with a value that is not finite.
std::size_t brokenPixels(const Image& radiance) {
  std::size_t broken = 0;
  for (int y = 0; y < radiance.height; ++y)
    for (int x = 0; x < radiance.width; ++x)
      broken += !std::ranges::all_of(radiance.at(x, y), [](float v) { return std::isfinite(v); });
  return broken;
}

bool coversNothing(const Image& radiance) {
  for (int y = 0; y < radiance.height; ++y)
    for (int x = 0; x < radiance.width; ++x)
      if (radiance.at(x, y)[3] != 0) return false;
  return true;
}

int runZoom(const CommonOptions& common, const RenderOptions& options,
            const ShadingOptions& shading) {
  if (std::filesystem::path(options.output).extension() != ".png")
    throw Error(fmt::format("--output '{}' must end in .png: a zoom is a strip of pictures",
                            options.output));
  if (!options.aov_output.empty() || !options.trace.empty())
    throw Error("--zoom makes many pictures; it does not go with --aov or --trace");
  const Scene scene = openScene(common, options.scene);
  const View& view = chosenView(scene, options.view);
  Device device = openDevice(common);
  const double exposure = options.exposure.value_or(scene.post.exposure);
  writePng(zoomStrip(device, scene, view, shading, options.zoom, exposure, common.threads),
           options.output);
  return kExitDone;
}

int runRender(const CommandLine& line, const RenderOptions& options) {
  const CommonOptions& common = line.common;
  const std::string extension = requireImageExtension(options.output);
  requireWritableFile(options.output);
  if (!options.aov_output.empty()) {
    if (requireImageExtension(options.aov_output) != ".exr") {
      throw Error(
          fmt::format("--aov '{}' must end in .exr: planes are floats", options.aov_output));
    }
    requireWritableFile(options.aov_output);
  }
  if (options.exposure && !(*options.exposure > 0)) {
    throw Error(fmt::format("--exposure {} is not a positive number", *options.exposure));
  }
  if (!options.trace.empty()) requireWritableFile(options.trace);
  const ImageSize size = parseSize(options.size);
  ShadingOptions shading{.width_px = size.width_px,
                         .height_px = size.height_px,
                         .lanes = common.lanes,
                         .method = parseMethod(options.method),
                         .glints = !options.no_glints};
  if (options.zoom != 0) return runZoom(common, options, shading);
  const Scene scene = openScene(common, options.scene);
  const View& view = chosenView(scene, options.view);
  Device device = openDevice(common);
  if (!options.trace.empty()) startTrace();
  FrameRenderer renderer(device, scene, view, shading, common.threads);

  FrameTimes prepared, shaded, read;
  Image radiance;
  {
    const TraceScope scope("frame", "frame");
    prepared = renderer.prepare();
    shaded = renderer.shade();
    radiance = renderer.readRadiance(&read);
  }
  if (!options.trace.empty()) writeTrace(options.trace, describeRun(line, device));
  const std::size_t broken = brokenPixels(radiance);
  if (coversNothing(radiance))
    fmt::print(stderr, "note: view {} of {} covers no pixel, so the picture is empty\n", view.name,
               scene.name);
  writeRendered(std::move(radiance), options, scene.post, extension);
  if (!options.aov_output.empty()) writeExr(planesToImage(renderer.planes()), options.aov_output);
  printTimes(fmt::format("{}/{} {}x{}", scene.name, view.name, size.width_px, size.height_px),
             prepared, shaded, read.readback_ns, device.clock().timer());
  if (broken > 0) {
    fmt::print(stderr,
               "glintmark: {} pixels of the picture are not finite: some value of the scene is too "
               "large for single precision\n",
               broken);
    return kExitCheckFailed;
  }
  return kExitDone;
}

}  // namespace

void addRenderCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<RenderOptions>();
  Command command = app.subcommand("render", "Renders one view of a scene to EXR or PNG");
  command.option("scene", options->scene, "Scene name or .toml file").required().typeName("SCENE");
  command.option("-o,--output", options->output, "Picture: .png tone-mapped, .exr radiance")
      .required()
      .typeName("FILE");
  command.option("--view", options->view, "View of the scene (default: its first)");
  command.option("--size", options->size, "Image size (default: 1920x1080)").typeName("WxH");
  command.option("--aov", options->aov_output, "Every rasterized plane as channels of one EXR")
      .typeName("FILE");
  command.option("--trace", options->trace, "Chrome/Perfetto trace of host and device")
      .typeName("FILE");
  command.option("--method", options->method, methodHelp(choiceName(kRenderMethod)));
  command
      .option("--zoom", options->zoom,
              "Strip of pictures over so many octaves, through ever narrower fields of view")
      .typeName("OCTAVES");
  command.flag("--no-glints", options->no_glints, "Smooth lobes in place of glints");
  const CommandOption star = command.flag("--star,!--no-star", options->star,
                                          "Star-shaped glare (default: the scene's for PNG)");
  command.option("--exposure", options->exposure, "Scale before tone mapping").typeName("X");
  command.footer(
      "Examples:\n"
      "  glintmark render snow -o snow.png --view grazing\n"
      "  glintmark render sand -o sand.exr --star --size 3840x2160\n"
      "  glintmark render screen_plane -o zoom.png --zoom 20 --size 128x128\n"
      "  glintmark render car -o car.png --aov planes.exr --set material.paint.log_density=7\n"
      "  glintmark render snow -o snow.png --trace trace.json    (open it at ui.perfetto.dev)");
  command.callback([options, star, &line] {
    options->star_chosen = star.given();
    line.action = [options, &line] { return runRender(line, *options); };
  });
}

}  // namespace glintmark
