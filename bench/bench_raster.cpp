// How fast is the rasterizer? Curves over image size and triangle count, and Embree's primary rays
// measured alternately on the same mesh.
//
//   bench_raster [--compare_only] [Google Benchmark options]
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include "bench/embree_primary_rays.h"
#include "host/core/statistics.h"
#include "host/raster/rasterizer.h"
#include "tests/raster/test_meshes.h"

namespace glintmark::bench {
namespace {

// What a scene with glints alone reads: 44 bytes per pixel.
constexpr PlaneMask kGlintPlanes{Plane::kPixel, Plane::kUInt,   Plane::kVInt,  Plane::kUFrac,
                                 Plane::kVFrac, Plane::kDudx,   Plane::kDvdx,  Plane::kDudy,
                                 Plane::kDvdy,  Plane::kFrame0, Plane::kFrame1};
constexpr int kCarTriangles = 570'000;
constexpr int kRounds = 15;

// A screen-filling curved surface of about `triangles` triangles; of two, a plane.
const TriangleMesh& meshOf(int triangles) {
  static std::map<int, TriangleMesh> meshes;
  const auto [at, is_new] = meshes.try_emplace(triangles);
  if (!is_new) return at->second;
  if (triangles == 2)
    test::addQuad(at->second, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, {0, 0}, {100, 100});
  else
    at->second = test::wavyTorus(static_cast<int>(std::lround(std::sqrt(triangles / 2.0))));
  return at->second;
}

// The plane fills the screen; the torus nearly does, from close above its tube.
Camera cameraFor(int triangles, int width_px, int height_px) {
  const View view = triangles == 2 ? test::lookAt({0, -2.5, 2}, {0, 0, 0})
                                   : test::lookAt({0, -1.6, 1.7}, {0, -0.2, 0});
  return makeCamera(view, width_px, height_px);
}

void render(benchmark::State& state, int triangles, int width_px, int height_px) {
  const TriangleMesh& mesh = meshOf(triangles);
  const Camera camera = cameraFor(triangles, width_px, height_px);
  Rasterizer rasterizer;
  PixelPlanes planes;
  RasterStats sum;
  rasterizer.render(mesh, camera, false, kGlintPlanes, planes);  // warm: buffers exist
  for (auto _ : state) {
    const RasterStats stats = rasterizer.render(mesh, camera, false, kGlintPlanes, planes);
    sum.setup_ns += stats.setup_ns;
    sum.visibility_ns += stats.visibility_ns;
    sum.resolve_ns += stats.resolve_ns;
  }
  const auto rate = [&](std::size_t n) {
    return benchmark::Counter(double(n), benchmark::Counter::kIsIterationInvariantRate);
  };
  const auto mean_ms = [&](double ns) {
    return benchmark::Counter(ns * 1e-6, benchmark::Counter::kAvgIterations);
  };
  state.counters["pixels/s"] = rate(planes.covered_px);
  state.counters["triangles/s"] = rate(mesh.triangleCount());
  state.counters["setup_ms"] = mean_ms(sum.setup_ns);
  state.counters["visibility_ms"] = mean_ms(sum.visibility_ns);
  state.counters["resolve_ms"] = mean_ms(sum.resolve_ns);
}

void renderSize(benchmark::State& state) {
  render(state, kCarTriangles, static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
}
BENCHMARK(renderSize)
    ->ArgNames({"width", "height"})
    ->Args({640, 360})
    ->Args({1280, 720})
    ->Args({1920, 1080})
    ->Args({3840, 2160})
    ->Args({7680, 4320})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void renderTriangles(benchmark::State& state) {
  render(state, static_cast<int>(state.range(0)), 1920, 1080);
}
BENCHMARK(renderTriangles)
    ->ArgName("triangles")
    ->Arg(2)
    ->Arg(2'000)
    ->Arg(32'000)
    ->Arg(100'000)
    ->Arg(262'000)
    ->Arg(kCarTriangles)
    ->Arg(2'000'000)
    ->Arg(5'000'000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

template <class Body>
double milliseconds(const Body& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

// Every round measures each contestant once, so that a slow moment of the machine hits them all.
void compareWithEmbree() {
  const TriangleMesh& mesh = meshOf(kCarTriangles);
  const Camera camera = cameraFor(kCarTriangles, 1920, 1080);
  const test::EmbreeOracle embree(mesh, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_HIGH);
  Rasterizer rasterizer;
  PixelPlanes planes;
  std::vector<std::uint32_t> ids, embree_ids;
  struct Contestant {
    const char* name;
    std::function<void()> run;
    std::vector<double> times_ms{};
  };
  const auto trace = [&](RayMode mode) {
    return [&, mode] { traceEmbree(embree, camera, mode, embree_ids); };
  };
  std::vector<Contestant> contestants = {
      {"visibility and resolve, 11 planes",
       [&] { rasterizer.render(mesh, camera, false, kGlintPlanes, planes); }},
      {"visibility only", [&] { rasterizer.renderVisibility(mesh, camera, false, ids); }},
      {"Embree rtcIntersect1", trace(RayMode::kSingle)},
      {"Embree rtcIntersect16", trace(RayMode::kPacket16)},
      {"Embree rtcIntersect1M", trace(RayMode::kStream)}};
  for (int round = -2; round < kRounds; ++round)
    for (Contestant& c : contestants) {
      const double time_ms = milliseconds(c.run);
      if (round >= 0) c.times_ms.push_back(time_ms);
    }

  const double full_ms = summarize(contestants[0].times_ms).median;
  const double visibility_ms = summarize(contestants[1].times_ms).median;
  fmt::print("{} triangles, 1920x1080, {} px covered, {} rounds\n", mesh.triangleCount(),
             planes.covered_px, kRounds);
  fmt::print("{:36} {:>9} {:>9} {:>9} {:>12} {:>16}\n", "", "min ms", "median", "p95",
             "over all 11", "over visibility");
  for (const Contestant& c : contestants) {
    const Summary s = summarize(c.times_ms);
    fmt::print("{:36} {:9.2f} {:9.2f} {:9.2f} {:11.2f}x {:15.2f}x\n", c.name, s.min, s.median,
               s.p95, s.median / full_ms, s.median / visibility_ms);
  }
  std::size_t different = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) different += ids[i] != embree_ids[i];
  fmt::print("pixels where the triangle differs from Embree's: {} of {}\n\n", different,
             ids.size());
}

}  // namespace
}  // namespace glintmark::bench

int main(int argc, char** argv) {
  const bool compare_only = argc > 1 && std::strcmp(argv[1], "--compare_only") == 0;
  glintmark::bench::compareWithEmbree();
  if (compare_only) return 0;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
