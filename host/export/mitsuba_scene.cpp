#include "host/export/mitsuba_scene.h"

#include "host/core/atomic_file.h"
#include "host/export/mitsuba_parts.h"

namespace glintmark {
namespace {

void writeCamera(MitsubaScene& to, int width_px, int height_px) {
  const View& view = to.view;
  XmlText& xml = to.xml;
  xml.open("sensor", {{"type", "perspective"}});
  xml.leaf("string", {{"name", "fov_axis"}, {"value", "y"}});
  xml.leaf("float", {{"name", "fov"}, {"value", fmt::format("{}", view.fov_y_deg)}});
  xml.leaf("float", {{"name", "near_clip"}, {"value", fmt::format("{}", view.near_plane)}});
  xml.leaf("float", {{"name", "far_clip"}, {"value", "1e9"}});
  xml.open("transform", {{"name", "to_world"}});
  xml.leaf(
      "lookat",
      {{"origin", rgbText(view.eye)}, {"target", rgbText(view.target)}, {"up", rgbText(view.up)}});
  xml.close();
  xml.open("sampler", {{"type", "independent"}});
  xml.leaf("integer", {{"name", "sample_count"}, {"value", "$spp"}});
  xml.leaf("integer", {{"name", "seed"}, {"value", "$seed"}});
  xml.close();
  xml.open("film", {{"type", "hdrfilm"}});
  xml.leaf("integer", {{"name", "width"}, {"value", fmt::format("{}", width_px)}});
  xml.leaf("integer", {{"name", "height"}, {"value", fmt::format("{}", height_px)}});
  xml.leaf("string", {{"name", "pixel_format"}, {"value", "rgb"}});
  xml.leaf("string", {{"name", "component_format"}, {"value", "float32"}});
  xml.leaf("rfilter", {{"type", "box"}});
  xml.close();
  xml.close();
}

std::string readmeText(const MitsubaScene& to) {
  std::string text = fmt::format(
      "# {}/{} for Mitsuba 3\n\nWritten by `glintmark export`. Pictures are linear radiance:\n\n"
      "    mitsuba -m scalar_rgb -D spp=256 -D seed=1 scene.xml -o picture.exr\n\n",
      to.scene.name, to.view.name);
  if (to.reflected_share != 1)
    text += fmt::format(
        "Materials reflect {:.4g} of what they ought to and lights emit {:.4g} times as much, "
        "which "
        "is\nthe same picture: Mitsuba blends two lobes by halves, and allows no reflectance above "
        "1.\n\n",
        to.reflected_share, 1 / to.reflected_share);
  text += "What has no counterpart:\n\n";
  for (const std::string& note : to.notes) text += "- " + note + ".\n";
  return text;
}

}  // namespace

std::vector<std::string> exportMitsuba(const Scene& scene, const View& view, int width_px,
                                       int height_px, const std::filesystem::path& folder) {
  MitsubaScene to{.scene = scene, .view = view, .folder = folder};
  shareOutReflectance(to);
  to.xml.open("scene", {{"version", "3.0.0"}});
  to.xml.leaf("default", {{"name", "spp"}, {"value", "256"}});
  to.xml.leaf("default", {{"name", "seed"}, {"value", "0"}});
  // Light from the lamps alone, as here, and lamps that are not seen.
  to.xml.open("integrator", {{"type", "direct"}});
  to.xml.leaf("boolean", {{"name", "hide_emitters"}, {"value", "true"}});
  to.xml.close();
  writeCamera(to, width_px, height_px);
  writeMaterials(to);
  writeMeshes(to);
  writeLights(to);
  to.xml.close();
  writeFile(folder / "README.md", readmeText(to));
  writeFile(folder / "scene.xml", to.xml.text());
  return to.notes;
}

}  // namespace glintmark
