// glintmark profile: a scene's kernels, again and again, for whoever looks at them from outside.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "host/cli/command_line.h"
#include "host/cli/shading_flags.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/statistics.h"
#include "host/core/stopwatch.h"
#include "host/experiment/interrupt.h"
#include "host/frame/frame_renderer.h"
#include "host/frame/shading_options.h"
#include "host/ocl/kernel_folder.h"
#include "host/ocl/static_counts.h"
#include "host/ocl/switches.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

constexpr double kMostProfile_s = 86400;

struct ProfileOptions {
  std::string scene, view, folder;
  std::string size = "1920x1080";
  ShadingFlags flags{defaultMethod()};
  double seconds = 10;
};

// The kernels' sources as they are compiled, each program's options and what the compiler made.
void writePrograms(const fs::path& folder, ProgramCache& cache,
                   const std::vector<KernelConfig>& configs) {
  const fs::path kernels = kernelFolder();
  for (const fs::path& file : kernelFiles(kernels)) {
    const fs::path target = folder / "kernels" / file.lexically_relative(kernels);
    fs::create_directories(target.parent_path());
    writeFile(target, readFile(file));
  }
  for (std::size_t i = 0; i < configs.size(); ++i) {
    const Program program = cache.get(kShadePass.file, configs[i]);
    const std::string stem = (folder / fmt::format("{}_{}", kShadePass.name, i)).string();
    writeFile(stem + ".options", "-I kernels " + program.options() + "\n");
    const std::optional<std::string> object = sharedObject(program, kShadePass.name);
    const std::string code = object ? *object : program.binary();
    if (!code.empty()) writeFile(stem + (object ? ".so" : ".bin"), code);
  }
}

int runProfile(const CommandLine& line, const ProfileOptions& options) {
  if (!(options.seconds > 0 && options.seconds <= kMostProfile_s))
    throw Error(
        fmt::format("--seconds {} is not above 0 and at most {}", options.seconds, kMostProfile_s));
  const ImageSize size = parseSize(options.size);
  ShadingOptions shading{
      .width_px = size.width_px, .height_px = size.height_px, .lanes = line.common.lanes};
  options.flags.apply(shading);
  if (!options.folder.empty()) requireWritableFolder(options.folder);
  const Scene scene = openScene(line.common, options.scene, shading);
  const View& view = chosenView(scene, options.view);
  options.flags.noteIdle(scene, shading, line.common.quiet);
  Device device = openDevice(line.common);
  FrameRenderer renderer(device, scene, view, shading, line.common.threads);
  renderer.prepare();
  renderer.shade();         // compiles
  renderer.readRadiance();  // throws if that was all
  ProgramCache cache(device);
  if (!options.folder.empty()) writePrograms(options.folder, cache, renderer.configs());

  const InterruptGuard guard;
  std::vector<double> times_ms;
  for (const Stopwatch watch; times_ms.empty() || watch.elapsedNs() < options.seconds * 1e9;) {
    if (InterruptGuard::interrupted()) break;
    times_ms.push_back(renderer.shade().shading_event_ns * 1e-6);
  }
  if (times_ms.empty()) throw Interrupted("interrupted before the first frame");
  const Summary summary = summarize(times_ms);
  fmt::print("{}/{} {}x{}: {} frames of {} programs, {:.3f} ms (least {:.3f}, 95 % below {:.3f})\n",
             scene.name, view.name, size.width_px, size.height_px, summary.n,
             renderer.configs().size(), summary.median, summary.min, summary.p95);
  if (!options.folder.empty())
    fmt::print("kernels, build options and machine code are in {}\n", options.folder);
  return kExitDone;
}

}  // namespace

void addProfileCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<ProfileOptions>();
  Command command =
      app.subcommand("profile", "A scene's kernels alone, again and again, for profilers");
  command.option("scene", options->scene, "Scene name or .toml file").required().typeName("SCENE");
  command
      .option("-o,--output", options->folder,
              "Folder for kernel sources, build options and machine code")
      .typeName("FOLDER");
  command.option("--view", options->view, "View of the scene (default: its first)");
  command.option("--size", options->size, "Image size (default: 1920x1080)").typeName("WxH");
  options->flags.addGlintOptions(command);
  options->flags.addSurfaceOptions(command);
  command.option("--seconds", options->seconds, "How long (default: 10)").typeName("S");
  command.footer(
      "Everything but the kernels is done before the first of these frames.\n"
      "Examples:\n"
      "  glintmark profile sponza --view grazing -o sponza_code\n"
      "  perf record -g glintmark profile snow --seconds 30\n"
      "  ncu glintmark profile snow --device NVIDIA --seconds 1");
  command.callback([options, &line] {
    line.opens_device = true;
    line.action = [options, &line] { return runProfile(line, *options); };
  });
}

}  // namespace glintmark
