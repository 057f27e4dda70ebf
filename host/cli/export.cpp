// glintmark export: a view of a scene for another renderer.
#include <fmt/format.h>

#include <memory>

#include "host/cli/command_line.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/export/mitsuba_scene.h"

namespace glintmark {
namespace {

struct ExportOptions {
  std::string scene, view, folder, size = "1920x1080";
};

int runExport(const CommonOptions& common, const ExportOptions& options) {
  const ImageSize size = parseSize(options.size);
  const Scene scene = openScene(common, options.scene);
  const View& view = chosenView(scene, options.view);
  requireWritableFolder(options.folder);
  const std::vector<std::string> notes =
      exportMitsuba(scene, view, size.width_px, size.height_px, options.folder);
  if (!common.quiet)
    for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);
  fmt::print("{}/{} {}x{}: {} triangles, {} lights, written to {}\n", scene.name, view.name,
             size.width_px, size.height_px, scene.mesh.triangleCount(),
             scene.lights.size() + scene.area_lights.size(), options.folder);
  return kExitDone;
}

}  // namespace

void addExportCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<ExportOptions>();
  Command command =
      app.subcommand("export", "One view of a scene for Mitsuba 3, with what it cannot say named");
  command.option("scene", options->scene, "Scene name or .toml file").required().typeName("SCENE");
  command.option("-o,--output", options->folder, "Folder of scene.xml, meshes, maps and a README")
      .required()
      .typeName("FOLDER");
  command.option("--view", options->view, "View of the scene (default: its first)");
  command.option("--size", options->size, "Image size (default: 1920x1080)").typeName("WxH");
  command.footer(
      "Examples:\n"
      "  glintmark export area_cloth --view far -o cloth --size 160x90\n"
      "  mitsuba -m scalar_rgb cloth/scene.xml -o cloth.exr\n"
      "  python3 bench/compare_mitsuba.py area_cloth --view far");
  command.callback([options, &line] {
    line.action = [options, &line] { return runExport(line.common, *options); };
  });
}

}  // namespace glintmark
