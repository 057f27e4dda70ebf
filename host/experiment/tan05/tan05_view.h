// One view of table "tan05": every way to filter normals against the ground truth, in turn.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "host/core/image.h"
#include "host/experiment/bench_run.h"
#include "host/frame/frame_renderer.h"

namespace glintmark {

/// One column of the comparison.
struct Tan05Method {
  const char* name;
  NormalMethod method;
  MixtureOrder order = MixtureOrder::kColours;
  int peaks = 7;
  int probes_across = 0;  // 0: the default
  int lobes = 0;          // 0: the material's
};
/// In the order in which they are measured and printed; "one_row" are mixtures by one row of
/// probes, a trilinear lookup where a footprint is round, as the paper's; "unaligned" are mixtures
/// fitted without regard to their neighbours, [TAN05] Figs. 5 and 6; "peaks_4" has four peaks,
/// "lobes_8" eight lobes.
const std::vector<Tan05Method>& tan05Methods();
/// Those that take as many lobes as the materials of `scene` have.
std::vector<Tan05Method> tan05MethodsOf(const Scene& scene);

struct Tan05Settings {
  ShadingOptions shading;  // 500 x 500, the paper's
  int truth_spp = 64;
};
Tan05Settings tan05Settings(const BenchRun& run);

/// Frames of a zoom-out, and how much farther each is than the last.
inline constexpr int kZoomFrames = 4;
inline constexpr double kZoomStep = 1.02;

const std::vector<std::string>& tan05ViewMetrics();
/// Of a view at some distance: errors only, means over kShifts_px.
const std::vector<std::string>& tan05DistanceMetrics();

/// What one scene's views share: the scene and its filtered maps.
struct Tan05Scene {
  Tan05Scene(BenchRun& run, const std::string& name);
  Scene scene;
  std::shared_ptr<NormalTextures> textures;
};

/// Records by method's name, and a strip: truth, methods, and below them their differences.
struct Tan05View {
  std::map<std::string, std::vector<Record>> records;
  Image picture;
};

/// `view` farther away by `factor`, its orbit's distance or its eye's.
View atDistance(const View& view, double factor);

/// Times, errors and frame-to-frame errors of a view; cases are named scene/view/method.
Tan05View measureTan05View(BenchRun& run, const Tan05Scene& scene, const View& view,
                           const Tan05Settings& settings);
/// Errors alone, means over the shifts; `view_name` stands in the cases' names.
Tan05View measureTan05Distance(BenchRun& run, const Tan05Scene& scene, const View& view,
                               const std::string& view_name, const Tan05Settings& settings);

}  // namespace glintmark
