// How fast is the rasterizer? Curves over image size and triangle count; with --embree, and nothing
// else, Embree's primary rays measured alternately on the same mesh.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <ctime>
#include <functional>
#include <map>
#include <vector>

#include "bench/device_bench.h"
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

// Time by the wall and by the processor, the latter summed over all threads: other programs on the
// machine disturb it less.
struct Duration {
  double wall_ms = 0, cpu_ms = 0;
};

double clockMilliseconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

template <class Body>
Duration measure(const Body& body) {
  const Duration start{clockMilliseconds(CLOCK_MONOTONIC),
                       clockMilliseconds(CLOCK_PROCESS_CPUTIME_ID)};
  body();
  return {clockMilliseconds(CLOCK_MONOTONIC) - start.wall_ms,
          clockMilliseconds(CLOCK_PROCESS_CPUTIME_ID) - start.cpu_ms};
}

struct Contestant {
  const char* name;
  std::function<void()> run;
  std::vector<double> wall_ms{}, cpu_ms{};
};

// Every round measures each contestant once, so that a slow moment of the machine hits them all.
void race(std::vector<Contestant>& contestants) {
  for (int round = -2; round < kRounds; ++round)
    for (Contestant& c : contestants) {
      const Duration time = measure(c.run);
      if (round < 0) continue;
      c.wall_ms.push_back(time.wall_ms);
      c.cpu_ms.push_back(time.cpu_ms);
    }
}

void printTimes(const std::vector<Contestant>& contestants) {
  fmt::print("{:36} {:>9} {:>9} {:>9} {:>11} {:>11}\n", "", "min ms", "median", "p95", "min CPU ms",
             "median CPU");
  for (const Contestant& c : contestants) {
    const Summary wall = summarize(c.wall_ms), cpu = summarize(c.cpu_ms);
    fmt::print("{:36} {:9.2f} {:9.2f} {:9.2f} {:11.2f} {:11.2f}\n", c.name, wall.min, wall.median,
               wall.p95, cpu.min, cpu.median);
  }
}

void printRatio(const char* what, const Contestant& slower, const Contestant& faster) {
  fmt::print("{:66} {:5.2f}x wall median {:5.2f}x CPU min\n", what,
             summarize(slower.wall_ms).median / summarize(faster.wall_ms).median,
             summarize(slower.cpu_ms).min / summarize(faster.cpu_ms).min);
}

void compareWithEmbree() {
  const TriangleMesh& mesh = meshOf(kCarTriangles);
  const Camera camera = cameraFor(kCarTriangles, 1920, 1080);
  const test::EmbreeOracle embree(mesh, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_HIGH);
  Rasterizer rasterizer;
  EmbreeRenderer embree_renderer;
  PixelPlanes planes, embree_planes;
  std::vector<std::uint32_t> ids, embree_ids;
  const auto trace = [&](RayMode mode) {
    return [&, mode] { traceEmbree(embree, camera, mode, embree_ids); };
  };
  std::vector<Contestant> contestants = {
    {"visibility and resolve, 11 planes",
     [&] { rasterizer.render(mesh, camera, false, kGlintPlanes, planes); }},
    {"visibility only", [&] { rasterizer.renderVisibility(mesh, camera, false, ids); }},
    {"rtcIntersect16 and the same 11 planes",
     [&] { embree_renderer.render(embree, mesh, camera, kGlintPlanes, embree_planes); }},
    {"rtcIntersect16", trace(RayMode::kPacket16)},
    {"rtcIntersect1", trace(RayMode::kSingle)},
#if GLINTMARK_RAY_STREAMS
    {"rtcIntersect1M", trace(RayMode::kStream)},
#endif
  };
  race(contestants);

  fmt::print("{} triangles, 1920x1080, {} px covered, {} rounds\n", mesh.triangleCount(),
             planes.covered_px, kRounds);
  printTimes(contestants);
  const auto &full = contestants[0], &visibility = contestants[1], &embree_full = contestants[2],
             &embree_rays = contestants[3];
  printRatio("same work, rays alone: rtcIntersect16 / visibility only", embree_rays, visibility);
  printRatio("same work, all planes: rtcIntersect16 and planes / rasterizer", embree_full, full);
  printRatio("more work here: rtcIntersect16 / visibility and resolve", embree_rays, full);
  std::size_t different = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) different += ids[i] != embree_ids[i];
  fmt::print("pixels where the triangle differs from Embree's: {} of {}\n\n", different,
             ids.size());
}

}  // namespace
}  // namespace glintmark::bench

int main(int argc, char** argv) {
  using namespace glintmark::bench;
  if (argc > 1 && std::strcmp(argv[1], "--embree") == 0) {
    compareWithEmbree();
    return 0;
  }
  return runHostBenchmarks(argc, argv, [] {});
}
