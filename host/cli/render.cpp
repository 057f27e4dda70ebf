// glintmark render: one picture of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "host/cli/command_line.h"
#include "host/cli/picture_verdict.h"
#include "host/cli/shading_flags.h"
#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/core/progress.h"
#include "host/core/trace.h"
#include "host/experiment/run_inputs.h"
#include "host/experiment/zoom_strip.h"
#include "host/frame/background.h"
#include "host/frame/displaced_truth.h"
#include "host/frame/frame_renderer.h"
#include "host/frame/ground_truth.h"
#include "host/frame/shading_options.h"
#include "host/ocl/device_clock.h"
#include "host/ocl/switches.h"
#include "host/raster/rasterizer.h"
#include "host/report/metrics.h"
#include "host/report/picture/aov.h"
#include "host/report/picture/cryptomatte.h"
#include "host/report/picture/image_io.h"
#include "host/report/picture/picture_facts.h"
#include "host/report/picture/star.h"
#include "host/report/picture/tonemap.h"
#include "host/report/record/trace_file.h"
#include "host/scene/view_path.h"

namespace glintmark {
namespace {

constexpr int kMostTruthSpp = 1 << 20;
constexpr int kMostFrames = 100000;
// Closest to placed microdetails (docs/accuracy.md); what is measured keeps the paper's.
constexpr GlintMethod kRenderMethod = GlintMethod::kDistributed;

struct RenderOptions {
  std::string scene, view, output, aov_output, trace;
  std::string size = "1920x1080";
  ShadingFlags flags{choiceName(kRenderMethod)};
  int truth_spp = 0;  // 0: a frame
  bool displaced = false;
  int frames = 0;  // of a path; 0: one picture, without a number
  std::string path;
  double step = 0.1;
  bool frames_given = false, step_given = false;
  int zoom = 0;  // octaves; 0: one picture
  bool truth_given = false, zoom_given = false;
  bool no_glints = false;
  bool star = false, star_chosen = false;
  bool background = false, background_chosen = false;
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

bool isPng(const RenderOptions& options) {
  return requireImageExtension(options.output) == ".png";
}

bool showsBackground(const RenderOptions& options, const Scene& scene) {
  const bool chosen = options.background_chosen ? options.background : isPng(options);
  return chosen && scene.environment.map != nullptr;
}

// PNG gets the scene's post effects and what lies behind it. EXR holds radiance for measuring, with
// either only on demand.
void writeRendered(Image radiance, const RenderOptions& options, const Scene& scene,
                   const View& view, const PictureFacts& facts) {
  const bool is_png = isPng(options);
  const PostEffects& post = scene.post;
  const double exposure = options.exposure.value_or(post.exposure);
  if (options.star_chosen ? options.star : is_png && post.star) {
    applyStar(radiance, {.threshold = 1 / exposure});  // exposed radiance 1
  }
  if (showsBackground(options, scene)) placeBackground(radiance, scene, view);
  if (is_png) {
    writePng(toneMap(radiance, {.exposure = exposure}), options.output, facts);
  } else {
    writeExr(radiance, options.output, facts);
  }
}

// The exit code of a picture, which is written whatever is wrong with it.
int writeJudged(Image radiance, const RenderOptions& options, const Scene& scene, const View& view,
                const PictureFacts& facts) {
  const PictureFault fault = judgePicture(radiance, scene, view, showsBackground(options, scene));
  writeRendered(std::move(radiance), options, scene, view, facts);
  return fault == PictureFault::kNone ? kExitDone : kExitCheckFailed;
}

int runZoom(const CommonOptions& common, const RenderOptions& options,
            const ShadingOptions& shading) {
  if (std::filesystem::path(options.output).extension() != ".png")
    throw Error(fmt::format("--output '{}' must end in .png: a zoom is a strip of pictures",
                            options.output));
  if (!options.aov_output.empty() || !options.trace.empty())
    throw Error("--zoom makes many pictures; it does not go with --aov or --trace");
  const Scene scene = openScene(common, options.scene, shading);
  const View& view = chosenView(scene, options.view);
  options.flags.noteIdle(scene, shading, common.quiet);
  Device device = openDevice(common);
  const double exposure = options.exposure.value_or(scene.post.exposure);
  bool is_finite = true, is_lit = false;
  const auto judge = [&](const Image& radiance) {
    is_finite = is_finite && isSane(radiance);
    is_lit = is_lit || hasLight(radiance);
  };
  writePng(zoomStrip(device, scene, view, shading, options.zoom, exposure, common.threads, judge),
           options.output);
  if (is_finite && is_lit) return kExitDone;
  fmt::print(stderr, "note: {} of view {} of {}\n",
             is_finite ? "no picture has any light" : "some pictures are not finite", view.name,
             scene.name);
  return kExitCheckFailed;
}

void checkRenderOptions(const RenderOptions& options) {
  const std::string extension = requireImageExtension(options.output);
  if (!options.aov_output.empty()) {
    if (requireImageExtension(options.aov_output) != ".exr") {
      throw Error(
          fmt::format("--aov '{}' must end in .exr: planes are floats", options.aov_output));
    }
  }
  if (options.exposure && !(*options.exposure > 0)) {
    throw Error(fmt::format("--exposure {} is not a positive number", *options.exposure));
  }
  announceOutputs(
      {{"-o", options.output}, {"--aov", options.aov_output}, {"--trace", options.trace}});
  if (options.zoom_given && options.zoom == 0)
    throw Error("--zoom 0 is no zoom; leave it out, or say over how many octaves");
  if (options.truth_given && (options.truth_spp < 1 || options.truth_spp > kMostTruthSpp))
    throw Error(fmt::format("--truth {} is not from 1 to {} samples a pixel", options.truth_spp,
                            kMostTruthSpp));
  if (options.displaced && (options.truth_spp == 0 || options.frames_given))
    throw Error("--displaced is a kind of one truth; it goes with --truth, not with --frames");
  if (options.frames_given && (options.frames < 1 || options.frames > kMostFrames))
    throw Error(fmt::format("--frames {} is not from 1 to {}", options.frames, kMostFrames));
  if (options.frames_given != !options.path.empty())
    throw Error("--frames and --path go together: so many pictures along a path");
  if (options.step_given && !options.frames_given)
    throw Error("--step is from picture to picture; it needs --frames and --path");
  if (options.exposure && extension == ".exr" && !options.star)
    throw Error("--exposure is for .png pictures and for --star; .exr holds the radiance itself");
  if (options.zoom != 0 && (options.frames_given || options.truth_spp > 0))
    throw Error("--zoom makes a strip of frames; it does not go with --truth or --frames");
  if (options.zoom != 0 && (options.star || options.background))
    throw Error("--zoom shows the meshes alone; it does not go with --star or --background");
  if (options.frames_given && !(options.aov_output.empty() && options.trace.empty()))
    throw Error("--path makes no planes and no trace; leave --aov and --trace out");
  if (options.truth_spp > 0 && !(options.aov_output.empty() && options.trace.empty()))
    throw Error("--truth makes no planes and no trace; leave --aov and --trace out");
}

// Supersampled radiance; says how far from it the samples may be.
Image renderedTruth(const CommandLine& line, Device& device, const Scene& scene, const View& view,
                    const ShadingOptions& shading, int spp) {
  const bool has_glints = std::ranges::any_of(scene.materials, &Material::has_glints);
  if (has_glints && shading.glints && !line.common.quiet)
    fmt::print(stderr, "note: the truth shades glints as the smooth lobe that is their mean\n");
  Progress progress(line.common.quiet);
  TruthImages truth = renderTruth(
      device, scene, view, shading, spp,
      [&](int done) { progress.show(done, spp, "samples a pixel"); }, line.common.threads);
  progress.clear();
  double mean = 0, error = 0;
  for (std::size_t i = 0; i < truth.standard_error.pixels.size(); ++i) {
    mean += truth.mean.pixels[i / 3 * 4 + i % 3];
    error += truth.standard_error.pixels[i];
  }
  fmt::print("{}/{} {}x{}: {} samples a pixel, mean standard error {:.2g} of the mean\n",
             scene.name, view.name, shading.width_px, shading.height_px, spp,
             mean > 0 ? error / mean : 0.0);
  return std::move(truth.mean);
}

Image renderedRelief(const CommandLine& line, const Scene& scene, const View& view,
                     const ShadingOptions& shading, int spp) {
  Progress progress(line.common.quiet);
  Image truth = renderDisplacedTruth(
      scene, view, {.width_px = shading.width_px, .height_px = shading.height_px, .spp = spp},
      [&](int rows) { progress.show(rows, shading.height_px, "rows"); });
  progress.clear();
  fmt::print("{}/{} {}x{}: {} samples a pixel of the displaced surface\n", scene.name, view.name,
             shading.width_px, shading.height_px, spp);
  return truth;
}

// "a_0007.png" of "a.png": as many digits as the last number has, four at least.
std::string numbered(const std::string& output, int frame, int frames) {
  const std::filesystem::path path(output);
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(frames - 1).size());
  const std::string name =
      fmt::format("{}_{:0{}}{}", path.stem().string(), frame, digits, path.extension().string());
  return (path.parent_path() / name).string();
}

// A picture for every step of a path; says how much changes from one to the next. Some of them may
// be empty or black, not all.
int renderPath(const CommandLine& line, const RenderOptions& options, Device& device,
               const Scene& scene, const View& view, const ShadingOptions& shading,
               const PictureFacts& facts) {
  const ViewPath path = parseViewPath(options.path);
  viewOnPath(view, path, options.step * (options.frames - 1));  // refuses what cannot be reached
  Progress progress(line.common.quiet);
  double sum = 0, largest = 0;
  bool some_broken = false, some_right = false;
  Image before;
  for (int frame = 0; frame < options.frames; ++frame) {
    progress.show(frame, options.frames, "frames");
    const View moved = viewOnPath(view, path, options.step * frame);
    Image radiance;
    if (options.truth_spp > 0) {
      radiance =
          renderTruth(device, scene, moved, shading, options.truth_spp, {}, line.common.threads)
              .mean;
    } else {
      FrameRenderer renderer(device, scene, moved, shading, line.common.threads);
      renderer.prepare();
      renderer.shade();
      radiance = renderer.readRadiance();
    }
    const PictureFault fault =
        judgePicture(radiance, scene, moved, showsBackground(options, scene));
    some_broken |= fault == PictureFault::kNotFinite;
    some_right |= fault == PictureFault::kNone;
    Image display = toneMap(radiance, {.exposure = options.exposure.value_or(scene.post.exposure)});
    if (frame > 0) {
      const double change = colourError(before, display);
      sum += change;
      largest = std::max(largest, change);
    }
    before = std::move(display);
    RenderOptions one = options;
    one.output = numbered(options.output, frame, options.frames);
    writeRendered(std::move(radiance), one, scene, moved, facts);
  }
  progress.clear();
  fmt::print("{}/{} {}x{}: {} frames along {}", scene.name, view.name, shading.width_px,
             shading.height_px, options.frames, options.path);
  if (options.frames > 1)
    fmt::print(", frame-to-frame error {:.4g} on average, {:.4g} at most",
               sum / (options.frames - 1), largest);
  fmt::print("\n");
  return some_right && !some_broken ? kExitDone : kExitCheckFailed;
}

// All planes, also those that no kernel of the frame reads.
void writePlanes(const Scene& scene, const Camera& camera, int threads, const std::string& file,
                 PictureFacts facts) {
  PixelPlanes planes;
  Rasterizer(threads).render(scene.mesh, camera, scene.cull_back_faces, PlaneMask::all(), planes);
  std::vector<std::string> materials;
  for (const Material& material : scene.materials) materials.push_back(material.name);
  for (auto& fact : matteFacts(materials)) facts.push_back(std::move(fact));
  const PlaneRows planes_by_row(planes);
  const auto rows = [&](int first, int count) {
    Image image = planes_by_row.read(first, count);
    addMaterialMatte(image, materials);
    return image;
  };
  writeExr({planes.width_px, planes.height_px, rows(0, 1).channel_names, rows}, file, facts);
}

int runRender(const CommandLine& line, const RenderOptions& options) {
  const CommonOptions& common = line.common;
  checkRenderOptions(options);
  const ImageSize size = parseSize(options.size);
  if (!options.aov_output.empty()) requireMemoryForPlanes(size.width_px, size.height_px);
  ShadingOptions shading{.width_px = size.width_px,
                         .height_px = size.height_px,
                         .lanes = common.lanes,
                         .glints = !options.no_glints,
                         .may_show_nothing = true};
  options.flags.apply(shading);
  if (options.zoom != 0) return runZoom(common, options, shading);
  const Scene scene = openScene(common, options.scene, shading, options.truth_spp > 0);
  if (options.background && scene.environment.map == nullptr)
    throw Error(
        fmt::format("scene {} has no environment that --background could show", scene.name));
  const View& view = chosenView(scene, options.view);
  options.flags.noteIdle(scene, shading, common.quiet, options.truth_spp > 0);
  Device device = openDevice(common);
  RunInfo run = describeRun(line, device);
  run.inputs = hashInputs(common, {options.scene});
  if (options.frames_given)
    return renderPath(line, options, device, scene, view, shading, factsOf(run));
  if (options.truth_spp > 0) {
    Image radiance = options.displaced
                         ? renderedRelief(line, scene, view, shading, options.truth_spp)
                         : renderedTruth(line, device, scene, view, shading, options.truth_spp);
    return writeJudged(std::move(radiance), options, scene, view, factsOf(run));
  }
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
  if (!options.trace.empty()) writeTrace(options.trace, run);
  const int code = writeJudged(std::move(radiance), options, scene, view, factsOf(run));
  if (!options.aov_output.empty())
    writePlanes(scene, makeCamera(view, size.width_px, size.height_px), common.threads,
                options.aov_output, factsOf(run));
  printTimes(fmt::format("{}/{} {}x{}", scene.name, view.name, size.width_px, size.height_px),
             prepared, shaded, read.readback_ns, device.clock().timer());
  return code;
}

constexpr char kRenderExamples[] =
    "Examples:\n"
    "  glintmark render snow -o snow.png --view grazing\n"
    "  glintmark render sand -o sand.exr --star --size 3840x2160\n"
    "  glintmark render screen_plane -o zoom.png --zoom 20 --size 128x128\n"
    "  glintmark render car -o car.png --aov planes.exr --set material.metal.log_density=7\n"
    "  glintmark render disk -o truth.exr --truth 256 && glintmark render disk -o lean.exr \\\n"
    "    --normal-method lean && glintmark diff lean.exr truth.exr -o error.png\n"
    "  glintmark render disk --view oblique -o relief.exr --truth 64 --displaced\n"
    "  glintmark render snow -o snow.png --frames 24 --path orbit --step 0.5\n"
    "  glintmark render snow -o snow.png --trace trace.json    # open it at ui.perfetto.dev";

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
  options->flags.addGlintOptions(command);
  options->flags.addSurfaceOptions(command);
  const CommandOption truth =
      command
          .option("--truth", options->truth_spp,
                  "The ground truth by so many samples a pixel, in place of any method")
          .typeName("N");
  const CommandOption frames =
      command.option("--frames", options->frames, "So many pictures along --path, FILE_0000 and on")
          .typeName("N");
  command.option("--path", options->path, "orbit, dolly or pan: how the view moves")
      .typeName("PATH");
  const CommandOption step =
      command
          .option("--step", options->step,
                  "From picture to picture: degrees, or per cent of the distance (default: 0.1)")
          .typeName("X");
  const CommandOption zoom =
      command
          .option("--zoom", options->zoom,
                  "Strip of pictures over so many octaves, through ever narrower fields of view")
          .typeName("OCTAVES");
  command.flag("--displaced", options->displaced,
               "With --truth: heights of the map stand up from a flat mesh, hide and shade");
  command.flag("--no-glints", options->no_glints, "Smooth lobes in place of glints");
  const CommandOption star = command.flag("--star,!--no-star", options->star,
                                          "Star-shaped glare (default: the scene's for PNG)");
  const CommandOption background =
      command.flag("--background,!--no-background", options->background,
                   "The environment behind the meshes (default: for PNG)");
  command.option("--exposure", options->exposure, "Scale before tone mapping").typeName("X");
  command.footer(kRenderExamples);
  command.callback([options, star, background, frames, step, truth, zoom, &line] {
    options->truth_given = truth.given();
    options->zoom_given = zoom.given();
    options->step_given = step.given();
    options->star_chosen = star.given();
    options->background_chosen = background.given();
    options->frames_given = frames.given();
    line.opens_device = true;
    line.action = [options, &line] { return runRender(line, *options); };
  });
}

}  // namespace glintmark
