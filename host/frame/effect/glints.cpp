// Microdetails in two dimensions, drawn per grid cell. [ZK16]
#include <algorithm>
#include <cmath>

#include "host/core/glint_grids.h"
#include "host/frame/effect/glint_table.h"
#include "host/frame/effect_module.h"

namespace glintmark {
namespace {

constexpr double kMostUvOffset = 2011;  // kernels/glint/footprint.clh
constexpr double kShallowCells = 0x1p30;

// Are there cells beyond 2^32 along an axis? A quarter of that is kept for what lies around a
// pixel.
bool isDeep(const TriangleMesh& mesh, const MaterialParams& material) {
  const GlintMaterial glints = withGlintGrids(material).glints;
  const auto cells = [&](double uv, float gamma) {
    return std::ldexp((std::abs(uv) + kMostUvOffset) * gamma, -glints.finest_level);
  };
  return std::ranges::any_of(mesh.uvs, [&](const glm::dvec2& uv) {
    return cells(uv.x, glints.gamma.x) >= kShallowCells ||
           cells(uv.y, glints.gamma.y) >= kShallowCells;
  });
}

// Which methods tell cells apart then; the others' recur.
bool knowsDeepUv(GlintMethod method) {
  return method == GlintMethod::kZk16 || method == GlintMethod::kExact ||
         method == GlintMethod::kDistributed;
}

// Grooves are glints to the kernels. The ground truth keeps to what glints are on average.
void chooseGlints(const ProgramCall& call, KernelConfig& config) {
  const Material& material = call.material;
  const bool area_lights = !call.scene.area_lights.empty();
  config.glint = material.has_glints && call.options.glints && !call.truth &&
                 (config.cone_lights || area_lights);
  config.area_glints = config.glint && area_lights;
  config.size_variation = config.glint && material.params.glints.size_variation > 0;
  config.count_cells = config.glint && call.options.count_cells;
  setKnobs(call.options, &KernelConfig::glint, config);
  config.deep_uv =
      config.glint && knowsDeepUv(config.method) && isDeep(call.scene.mesh, material.params);
}

void chooseGlintsForAll(std::span<const KernelConfig> own, const ShadingOptions& options,
                        KernelConfig& all) {
  all.size_variation = all.area_glints = true;
  all.deep_uv = std::ranges::any_of(own, &KernelConfig::deep_uv);
  setKnobs(options, &KernelConfig::glint, all);
}

}  // namespace

const EffectModule& glintsEffect() {
  static const EffectModule module = {
      .material_calls =
          [](const Material& material) { return material.has_glints && !material.has_grooves; },
      .strip_material =
          [](Material& material) {
            if (!material.has_grooves) material.has_glints = false;
          },
      .choose = chooseGlints,
      .planes = {Plane::kUInt, Plane::kVInt, Plane::kUFrac, Plane::kVFrac, Plane::kDudx,
                 Plane::kDvdx, Plane::kDudy, Plane::kDvdy},
      .choose_for_all = chooseGlintsForAll,
      .add_arguments =
          [](FrameResources& frame, const Material&, const KernelConfig& config,
             ShadeArguments& arguments) {
            if (const auto table =
                    glintTable(frame.device, config, BufferPurpose::kSlopeDictionary))
              arguments.add("glint_table", *table);
          }};
  return module;
}

}  // namespace glintmark
