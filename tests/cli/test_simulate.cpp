// simulate: what it prints and writes, and what impossible options get.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "host/core/atomic_file.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/folder_lock.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

ProcessResult simulate(const std::vector<std::string>& options) {
  std::vector<std::string> arguments = {"simulate", "--quiet"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return runGlintmark(arguments);
}

// Fails with one sentence that has every one of `parts`.
void expectRefusedSimulation(const std::vector<std::string>& options,
                             const std::vector<std::string>& parts) {
  const ProcessResult result = simulate(options);
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  for (const std::string& part : parts)
    EXPECT_NE(result.err.find(part), std::string::npos) << "no '" << part << "' in " << result.err;
}

TEST(Simulate, ImpossibleOptionsAreRefused) {
  expectRefusedSimulation({"--surface", "wood"}, {"'wood'", "diffuse, metal, dielectric"});
  expectRefusedSimulation({"--model", "wood"}, {"'wood'", "heights, smith"});
  // What would do nothing.
  expectRefusedSimulation({"--model", "smith", "--correlation", "5"},
                          {"--correlation is for --model heights"});
  expectRefusedSimulation({"--ior", "1.4"}, {"--ior is for metals and dielectrics"});
  expectRefusedSimulation({"--surface", "dielectric", "--k", "1"}, {"--k is for metals alone"});
  expectRefusedSimulation({"--surface", "metal", "--f0", "0.9", "--k", "3"},
                          {"--f0 stands in place of --ior and --k"});
  expectRefusedSimulation({"--f0", "0.9"}, {"reflectance f0", "metals"});
  expectRefusedSimulation({"--surface", "metal", "--f0", "0"}, {"reflectance f0 0", "0.001 to 1"});
  expectRefusedSimulation({"--surface", "metal", "--tint", "0.5"}, {"tint", "f0"});
  expectRefusedSimulation({"--model", "smith", "--surface", "dielectric"},
                          {"Smith's walk", "diffuse surfaces and metals"});
  for (const char* alpha : {"0", "-1", "3", "nan"})
    expectRefusedSimulation({"--alpha", alpha}, {"roughness along x", "0.0001 to 2"});
  expectRefusedSimulation({"--alpha", "0.5", "7"}, {"roughness along y 7", "0.0001 to 2"});
  for (const char* angle : {"90", "-1", "inf"})
    expectRefusedSimulation({"--incidence", angle}, {"incidence", "0 to 89.95"});
  expectRefusedSimulation({"--azimuth", "500"}, {"azimuth", "500"});
  for (const char* rays : {"-1", "1e30", "nan"})
    expectRefusedSimulation({"--rays", rays}, {"--rays", "1 to 2^48"});
  expectRefusedSimulation({"--rays", "0"}, {"0 rays", "at least 1"});
  expectRefusedSimulation({"--rays", "many"}, {"--rays", "many"});
  for (const char* orders : {"0", "7"})
    expectRefusedSimulation({"--orders", orders}, {"orders", orders, "1 to 6"});
  expectRefusedSimulation({"--surface", "dielectric", "--ior", "1"},
                          {"index of refraction 1", "air"});
  expectRefusedSimulation({"--surface", "dielectric", "--ior", "0"},
                          {"index of refraction", "0.05 to 20"});
  expectRefusedSimulation({"--surface", "metal", "--k", "-1"}, {"imaginary", "-1", "0 to 1000"});
  expectRefusedSimulation({"--albedo", "1.5"}, {"--albedo 1.5", "0 to 1"});
  expectRefusedSimulation({"--albedo", "0.5", "--surface", "metal"}, {"--albedo", "Fresnel"});
  expectRefusedSimulation({"--correlation", "20", "--rays", "10"},
                          {"correlation length 20", "1.5 to 8"});
}

TEST(Simulate, OutputsThatCannotBeWrittenAreRefusedBeforeAnyWork) {
  const TempFolder folder;
  for (const char* option : {"-o", "--csv", "--checkpoint"})
    expectRefusedSimulation({option, folder / "missing/a.png"}, {"missing"});
  expectRefusedSimulation({"-o", folder / "a.jpg"}, {"a.jpg", ".png"});
  EXPECT_EQ(folder.entryCount(), 0u);
}

TEST(Simulate, CarriesOnFromItsOwnCheckpointsOnly) {
  const TempFolder folder;
  const std::string file = folder / "run.sim";
  expectRefusedSimulation({"--resume"}, {"--resume", "--checkpoint FILE"});
  // Without a file to carry on from it starts afresh.
  ASSERT_EQ(simulate({"--rays", "1048576", "--checkpoint", file, "--resume"}).exit_code, 0);
  EXPECT_EQ(folder.entryCount(), 1u);  // no lock is left
  const std::string whole = readFile(file);
  expectRefusedSimulation({"--resume", "--checkpoint", file, "--alpha", "0.5"},
                          {"run.sim", "another run", "alpha=0.8", "alpha=0.5"});
  expectRefusedSimulation({"--resume", "--checkpoint", file, "--rays", "1000"},
                          {"run.sim", "1048576", "1000"});
  const ProcessResult more =
      simulate({"--resume", "--checkpoint", file, "--rays", "1050000", "--csv", folder / "a.csv"});
  EXPECT_EQ(more.exit_code, 0) << more.err;
  EXPECT_NE(more.out.find("1050000 rays"), std::string::npos);
  ASSERT_EQ(simulate({"--rays", "1050000", "--csv", folder / "b.csv"}).exit_code, 0);
  EXPECT_EQ(readFile(folder / "a.csv"), readFile(folder / "b.csv"));
  writeFile(file, whole.substr(0, whole.size() - 9));
  expectRefusedSimulation({"--resume", "--checkpoint", file}, {"run.sim", "damaged"});
  writeFile(file, "a letter");
  expectRefusedSimulation({"--resume", "--checkpoint", file}, {"run.sim", "not a checkpoint"});
}

TEST(Simulate, ACheckpointBelongsToOneRun) {
  const TempFolder folder;
  const std::string file = folder / "run.sim";
  const FolderLock held(file + ".lock", file, "wait");
  expectRefusedSimulation({"--rays", "1000", "--checkpoint", file},
                          {"run.sim", "in use by another run", "--checkpoint"});
}

TEST(Simulate, SaysRoughnessAndBalanceAndDrawsPictures) {
  const TempFolder folder;
  for (const char* surface : {"diffuse", "metal", "dielectric"}) {
    const std::string picture = folder / (std::string(surface) + ".png");
    std::vector<std::string> options = {"--surface", surface, "--rays", "20000", "-o", picture};
    if (surface == std::string("metal")) options.insert(options.end(), {"--k", "3"});
    const ProcessResult result = simulate(options);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    for (const char* part : {"energy above", "counted 1.000000000 of the rays", "nominal",
                             "effective", "slope variance"})
      EXPECT_NE(result.out.find(part), std::string::npos) << part << " in " << result.out;
    const Image image = readImage(picture);
    EXPECT_GT(image.width, 400);
    EXPECT_NE(*std::ranges::max_element(image.pixels), *std::ranges::min_element(image.pixels));
  }
}

TEST(Simulate, AlbedoScalesOrders) {
  const ProcessResult black = simulate({"--rays", "20000", "--albedo", "0"});
  EXPECT_NE(black.out.find("escaped 0.000000, absorbed 1.000000"), std::string::npos) << black.out;
  const ProcessResult white = simulate({"--rays", "20000", "--albedo", "1"});
  EXPECT_NE(white.out.find("absorbed 0.000000"), std::string::npos) << white.out;
}

// Energies by order of a run's --csv; those that leave above.
std::vector<double> energiesAbove(const std::string& file) {
  std::istringstream lines(readFile(file));
  std::string line;
  std::getline(lines, line);
  std::vector<double> energies;
  while (std::getline(lines, line)) energies.push_back(std::stod(line.substr(line.find(',') + 1)));
  return energies;
}

TEST(Simulate, SmithsWalkNeedsNoSurface) {
  const TempFolder folder;
  const ProcessResult walk = simulate({"--model", "smith", "--rays", "200000", "--incidence", "75",
                                       "--csv", folder / "smith.csv", "-o", folder / "smith.png"});
  ASSERT_EQ(walk.exit_code, 0) << walk.err;
  EXPECT_TRUE(walk.out.starts_with("smith diffuse alpha=0.8,0.8 incidence=75")) << walk.out;
  EXPECT_NE(walk.out.find("counted 1.000000000 of the rays"), std::string::npos) << walk.out;
  EXPECT_EQ(walk.out.find("slope variance"), std::string::npos) << walk.out;
  EXPECT_GT(readImage(folder / "smith.png").width, 400);
  // Heights return more of what comes in low than Smith's theory has it.
  ASSERT_EQ(simulate({"--rays", "200000", "--incidence", "75", "--csv", folder / "heights.csv"})
                .exit_code,
            0);
  const std::vector<double> smith = energiesAbove(folder / "smith.csv"),
                            heights = energiesAbove(folder / "heights.csv");
  ASSERT_EQ(smith.size(), 4u);
  ASSERT_EQ(heights.size(), 4u);
  EXPECT_NEAR(heights[0] - smith[0], 0.015, 0.008);
  // A surface that is all but flat has one bounce.
  const ProcessResult flat = simulate(
      {"--model", "smith", "--alpha", "0.0001", "--rays", "20000", "--csv", folder / "flat.csv"});
  ASSERT_EQ(flat.exit_code, 0) << flat.err;
  EXPECT_EQ(energiesAbove(folder / "flat.csv"), (std::vector<double>{1, 0, 0, 0}));
}

TEST(Simulate, ModelsDoNotShareCheckpoints) {
  const TempFolder folder;
  const std::string file = folder / "run.sim";
  ASSERT_EQ(simulate({"--model", "smith", "--rays", "1048576", "--checkpoint", file}).exit_code, 0);
  expectRefusedSimulation({"--resume", "--checkpoint", file},
                          {"run.sim", "another run (smith diffuse", "this one is diffuse"});
  ASSERT_EQ(simulate({"--model", "smith", "--rays", "1050000", "--checkpoint", file, "--resume",
                      "--csv", folder / "a.csv"})
                .exit_code,
            0);
  ASSERT_EQ(
      simulate({"--model", "smith", "--rays", "1050000", "--csv", folder / "b.csv"}).exit_code, 0);
  EXPECT_EQ(readFile(folder / "a.csv"), readFile(folder / "b.csv"));
}

}  // namespace
}  // namespace glintmark
