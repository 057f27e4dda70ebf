// Specialisation: a scene pays for the effects that it calls for and for no other.
#include <gtest/gtest.h>
#include <stdio.h>

#include <algorithm>
#include <memory>
#include <set>

#include "host/core/error.h"
#include "host/filter/normal_map_generators.h"
#include "host/frame/all_materials.h"
#include "host/frame/effect_module.h"
#include "host/frame/effect_set.h"
#include "host/frame/effects.h"
#include "host/ocl/static_counts.h"
#include "tests/frame/frame_test.h"
#include "tests/tolerances.h"

namespace glintmark {
namespace {

const EffectSet kEverything = EffectSet::all();

// Strips of floor, one material each, so that lanes of one work-item belong to several; every
// effect of the project.
Scene mixedScene() {
  Scene scene = floorScene();
  scene.mesh = {};
  for (std::uint32_t i = 0; i < 40; ++i)
    addFloor(scene, -1.0f + 0.05f * static_cast<float>(i), -0.95f + 0.05f * static_cast<float>(i),
             i % 6);
  Material smooth = scene.materials[0];
  smooth.has_glints = false;
  smooth.params.surface.albedo = {0.4f, 0.3f, 0.2f, 0};
  Material glints = scene.materials[0], grooves = glints, mapped = smooth, rough = smooth,
           metal = smooth;
  glints.has_colour = true;
  glints.params.glints.size_variation = 1;
  grooves.has_grooves = true;
  grooves.params.glints.alpha_l = {0.3f, 0.05f};
  mapped.normal_map = NormalMapSource{
      std::make_shared<NormalMap>(generateNormalMap({.kind = "bumps", .size_px = 32})), 4};
  rough.diffuse_model = DiffuseModel::kRefit;
  metal.compensation = Compensation::kLobe;
  scene.materials = {glints, grooves, mapped, rough, metal, smooth};
  const char* const names[] = {"glints", "grooves", "mapped", "rough", "metal", "smooth"};
  for (std::size_t i = 0; i < scene.materials.size(); ++i) scene.materials[i].name = names[i];

  scene.lights[0].direction.w = 0.05f;
  ConeLight sky{};
  sky.direction = {0.3f, 0.9f, 0.2f, 0.2f};
  sky.irradiance = {0.5f, 0.6f, 0.8f, 0};
  scene.lights.push_back(sky);
  scene.environment = {true, "", 1};
  AreaLight lamp;
  lamp.vertices = {{-1, 1, -2}, {1, 1, -2}, {1, 2, -2}, {-1, 2, -2}};
  lamp.radiance = {2, 2, 2};
  lamp.two_sided = true;
  scene.area_lights = {lamp};
  return scene;
}

struct Shaded {
  Image image;
  BufferUse use;
  std::vector<KernelConfig> configs;
};

Shaded shadeWith(const Scene& mixed, EffectSet set, Programs programs,
                 ShadingOptions options = smallOptions()) {
  const Scene scene = withEffects(mixed, set);
  options = withEffects(options, set);
  options.programs = programs;
  device().resetBufferPeaks();
  FrameRenderer renderer(device(), scene, lookingDown(50), options, 2);
  renderer.prepare();
  renderer.shade();
  return {renderer.readRadiance(), device().bufferUse(), renderer.configs()};
}

TEST(EffectSets, ScenesCallForThem) {
  EXPECT_EQ(effectsOf(mixedScene()), kEverything);
  EXPECT_EQ(effectsOf(floorScene()), EffectSet{Effect::kGlints});
  for (const Effect effect : kEverything.list()) {
    const EffectSet wanted = EffectSet{effect} | effectNeeds(effect);
    EXPECT_EQ(effectsOf(withEffects(mixedScene(), wanted)).without({Effect::kMultiscale}),
              wanted.without({Effect::kMultiscale}))
        << effectName(effect);
  }
  EXPECT_EQ(effectSetName({}), "none");
  EXPECT_EQ(effectSetName({Effect::kLtc, Effect::kGlints}), "glints+ltc");
}

// Nobody calls for an effect that neither asks nor needs others: it would be in every scene.
TEST(EffectSets, EveryEffectSaysWhoCallsForIt) {
  for (const Effect effect : kEverything.list()) {
    const EffectModule& module = effectModule(effect);
    EXPECT_TRUE(module.material_calls || module.scene_calls || !module.needs.empty())
        << effectName(effect);
  }
}

}  // namespace

static void PrintTo(const EffectSet& set, std::ostream* out) {
  *out << effectSetName(set);
}

namespace {

class SetOfEffects : public testing::TestWithParam<EffectSet> {};

// The program with everything compiled in, on the same lists and on pixels in the order of the
// screen, where lanes of a work-item belong to different materials.
TEST_P(SetOfEffects, SpecialisedProgramsGiveTheBitsOfTheProgramWithEverything) {
  const Scene scene = mixedScene();
  const Image own = shadeWith(scene, GetParam(), Programs::kPerMaterial).image;
  EXPECT_TRUE(std::ranges::any_of(own.pixels, [](float v) { return v > 0 && v != 1; }));
  for (const Programs programs : {Programs::kOneForAll, Programs::kFullScreen}) {
    const Shaded all = shadeWith(scene, GetParam(), programs);
    ASSERT_EQ(all.configs.size(), 1u);
    EXPECT_TRUE(all.configs[0].all_materials);
    EXPECT_EQ(own.pixels, all.image.pixels);
  }
}

// Device buffers by purpose: what a set of effects must not have allocated.
TEST_P(SetOfEffects, AllocatesWhatItsEffectsReadAndNoMore) {
  const EffectSet set = GetParam();
  const Shaded own = shadeWith(mixedScene(), set, Programs::kPerMaterial);
  const auto made = [&](BufferPurpose purpose) { return own.use.by_purpose.contains(purpose); };
  EXPECT_EQ(made(BufferPurpose::kNormalMaps), set.has(Effect::kNormals));
  EXPECT_EQ(made(BufferPurpose::kNormalMapLayouts), set.has(Effect::kNormals));
  EXPECT_EQ(made(BufferPurpose::kCosineTable), set.has(Effect::kLtc));
  EXPECT_EQ(made(BufferPurpose::kAreaLights), set.has(Effect::kLtc));
  EXPECT_EQ(made(BufferPurpose::kScattering),
            set.has(Effect::kMultiscatter) || set.has(Effect::kCompensation));
  EXPECT_EQ(made(BufferPurpose::kLightTaps), set.has(Effect::kMultiscatter));
  EXPECT_EQ(made(BufferPurpose::kTaps), set.has(Effect::kMultiscatter));
  EXPECT_FALSE(made(BufferPurpose::kLightPictures));
  EXPECT_FALSE(made(BufferPurpose::kCellCounts));
  EXPECT_FALSE(made(BufferPurpose::kOwners));

  PlaneMask planes = {Plane::kPixel, Plane::kFrame0, Plane::kFrame1};
  if (set.has(Effect::kGlints) || set.has(Effect::kGrooves))
    planes = planes | PlaneMask{Plane::kUInt, Plane::kVInt};
  if (set.has(Effect::kGlints) || set.has(Effect::kGrooves) || set.has(Effect::kNormals))
    planes = planes | PlaneMask{Plane::kUFrac, Plane::kVFrac, Plane::kDudx,
                                Plane::kDvdx,  Plane::kDudy,  Plane::kDvdy};
  if (set.has(Effect::kLtc)) planes = planes | PlaneMask{Plane::kDepth};
  const std::size_t plane_bytes = own.use.by_purpose.at(BufferPurpose::kPlanes).peak;
  const std::size_t radiance_bytes = own.use.by_purpose.at(BufferPurpose::kRadiance).peak;
  EXPECT_EQ(plane_bytes / planes.size(), radiance_bytes / 3);
  EXPECT_EQ(plane_bytes % planes.size(), 0u);
}

// Functions that stand for an effect in the source of a program.
const std::vector<std::pair<Effect, std::vector<std::string>>>& effectFunctions() {
  static const std::vector<std::pair<Effect, std::vector<std::string>>> functions = {
      {Effect::kGlints, {"glintRatio", "hashDirection", "makeFootprint", "microdetailRatio"}},
      {Effect::kGrooves, {"grooveDensity"}},
      {Effect::kColour, {"colourWheel", "cellColour"}},
      {Effect::kNormals, {"filterNormals", "evaluateMappedLight", "evaluateShape", "lobeFromM"}},
      {Effect::kLtc, {"shadeAreaLights", "lookUpLtc", "seeLight", "loadLitPoint"}},
      {Effect::kMultiscale, {"footprintAlpha", "fetchMeanNormal"}},
      {Effect::kMultiscatter, {"addScattered", "scatterLight", "scatterView", "light_taps"}},
      {Effect::kCompensation, {"compensationGain"}}};
  return functions;
}

std::string preprocessed(const KernelConfig& config) {
  const std::string command = "g++ -E -P -x c -I '" + kernelFolder() + "' " +
                              programOptions(config) + " '" + kernelFolder() + "/shade.cl' 2>&1";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  char chunk[4096];
  while (pipe && fgets(chunk, sizeof chunk, pipe.get())) text += chunk;
  return text;
}

// An effect is absent from a program if the material, or the scene, does not call for it.
TEST(Specialisation, ProgramsNameNoFunctionOfAnAbsentEffect) {
  const Scene scene = mixedScene();
  const ShadingOptions options = smallOptions();
  const std::string everything = preprocessed(configForAll(scene, options, 16));
  for (const auto& [effect, names] : effectFunctions())
    for (const std::string& name : names)
      EXPECT_NE(everything.find(name), std::string::npos) << name << " was renamed";

  EffectSet known;
  for (const auto& [effect, names] : effectFunctions()) known = known | EffectSet{effect};
  EXPECT_EQ(effectSetName(known), effectSetName(effectsOf(configForAll(scene, options, 16))));

  for (const EffectSet set :
       {kEverything, kEverything.without({Effect::kLtc, Effect::kMultiscale})}) {
    const Scene stripped = withEffects(scene, set);
    const PlaneMask planes = planesFor(stripped, options);
    for (const Material& material : stripped.materials) {
      KernelConfig config = configFor(material, stripped, options, 16);
      config.planes = planes;
      const std::string source = preprocessed(config);
      EXPECT_NE(source.find("shadePixels"), std::string::npos);
      const EffectSet present = effectsOf(config);
      for (const auto& [effect, names] : effectFunctions()) {
        if (present.has(effect)) continue;
        for (const std::string& name : names)
          EXPECT_EQ(source.find(name), std::string::npos)
              << material.name << ": " << effectName(effect) << ": " << name;
      }
    }
  }
}

// What is off leaves no instruction: the machine code of a material's program is as long,
// whatever the rest of the scene calls for, and shorter than with the effect.
TEST(Specialisation, NeighboursEffectsLeaveNoInstruction) {
  ProgramCache cache(device());
  const Scene mixed = mixedScene();
  const auto counted = [&](EffectSet set, const char* name) {
    const Scene scene = withEffects(mixed, set);
    const auto material = std::ranges::find(scene.materials, name, &Material::name);
    KernelConfig config = configFor(*material, scene, smallOptions(), 16);
    config.planes = planesFor(scene, smallOptions());  // as in the frame
    return staticCounts(cache.get("shade.cl", config), "shade");
  };
  const auto alone = counted({}, "smooth");
  if (!alone) GTEST_SKIP() << "the device does not give its machine code";
  const EffectSet surfaces = kEverything.without({Effect::kLtc, Effect::kMultiscale});
  // Other planes stand before those that are read: their places are other constants.
  const auto expect_alike = [&](EffectSet set, const char* name) {
    EXPECT_NEAR(static_cast<double>(counted(set, name)->kernel_instructions),
                static_cast<double>(alone->kernel_instructions), kPlaneSlotInstructions)
        << name;
  };
  expect_alike(surfaces, "smooth");
  expect_alike({}, "rough");
  const double most = static_cast<double>(alone->kernel_instructions) + kPlaneSlotInstructions;
  for (const char* name : {"glints", "grooves", "mapped", "rough", "metal"})
    EXPECT_GT(static_cast<double>(counted(surfaces, name)->kernel_instructions), most) << name;
  EXPECT_GT(static_cast<double>(counted(kEverything, "smooth")->kernel_instructions), most);
}

INSTANTIATE_TEST_SUITE_P(
    Sets, SetOfEffects,
    testing::Values(EffectSet{}, EffectSet{Effect::kGlints, Effect::kGrooves, Effect::kColour},
                    EffectSet{Effect::kNormals, Effect::kMultiscatter},
                    EffectSet{Effect::kNormals, Effect::kLtc, Effect::kMultiscale}, kEverything),
    [](const auto& set) {
      std::string name = effectSetName(set.param);
      std::ranges::replace(name, '+', '_');
      return name;
    });

TEST(OneForAll, LanesKeepTheImage) {
  ShadingOptions options = smallOptions();
  const Image wide = shadeWith(mixedScene(), kEverything, Programs::kFullScreen, options).image;
  options.lanes = 1;
  EXPECT_EQ(wide.pixels,
            shadeWith(mixedScene(), kEverything, Programs::kFullScreen, options).image.pixels);
}

TEST(OneForAll, MaterialsThatDifferInAChoiceAreAnError) {
  Scene scene = mixedScene();
  scene.materials[5].ggx = true;
  try {
    configForAll(scene, smallOptions(), 16);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'smooth'"), std::string::npos) << error.what();
  }
  scene = mixedScene();
  scene.materials[4].diffuse_model = DiffuseModel::kEon;
  scene.materials[4].params.surface.albedo = {0.5f, 0.5f, 0.5f, 0};
  EXPECT_THROW(configForAll(scene, smallOptions(), 16), Error);
  ShadingOptions counting = smallOptions();
  counting.count_cells = true;
  EXPECT_THROW(configForAll(mixedScene(), counting, 16), Error);
}

TEST(ScreenOrder, EveryEntryOnceWithItsMaterial) {
  const Scene scene = mixedScene();
  FrameRenderer renderer(device(), scene, lookingDown(50), smallOptions(), 2);
  renderer.prepare();
  const PixelPlanes& planes = renderer.planes();
  std::vector<std::uint32_t> owners = entryOwners(planes);
  std::set<std::pair<std::uint32_t, std::uint32_t>> wanted, found;
  for (const PixelList& list : planes.lists)
    for (std::uint32_t i = list.offset; i < list.offset + list.count; ++i)
      wanted.insert({planes.plane(Plane::kPixel)[i], list.material});
  const PixelPlanes ordered = inScreenOrder(planes, owners);
  ASSERT_EQ(ordered.lists.size(), 1u);
  ASSERT_EQ(owners.size(), ordered.stride);
  EXPECT_EQ(ordered.stride % GM_LIST_PADDING, 0u);
  const auto pixels = ordered.plane(Plane::kPixel);
  for (std::uint32_t i = 0; i < ordered.lists[0].count; ++i) found.insert({pixels[i], owners[i]});
  EXPECT_EQ(found, wanted);
  EXPECT_EQ(wanted.size(), planes.covered_px);
}

// Multiple scattering is defined under cone lights; area lights alone must still build and shade.
TEST(Specialisation, AreaLightsAloneOnRoughAndCompensatedMaterials) {
  Scene scene = mixedScene();
  scene.lights.clear();
  scene.environment = {};
  FrameRenderer renderer(device(), scene, lookingDown(50), smallOptions(), 2);
  renderer.prepare();
  renderer.shade();
  for (const KernelConfig& config : renderer.configs()) {
    EXPECT_EQ(config.multiscatter, Multiscatter::kOff);
    EXPECT_EQ(config.metal_compensation, MetalCompensation::kOff);
  }
}

}  // namespace
}  // namespace glintmark
