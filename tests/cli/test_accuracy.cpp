// glintmark accuracy on tiny pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "host/core/atomic_file.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/records.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

std::vector<std::string> accuracyArguments(const TempFolder& folder, const std::string& effect,
                                           const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"accuracy", effect, "--quiet", "--size",    "48x27",
                                        "--reps",   "1",    "-o",      folder / "r"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// Medians of one metric by case.
std::map<std::string, double> figuresOf(const TempFolder& folder, const std::string& metric) {
  std::map<std::string, double> figures;
  for (const Record& record : readResults(folder / "r/results.json").records) {
    EXPECT_TRUE(record.valid) << record.case_ << " " << record.metric << ": " << record.note;
    if (record.metric == metric) figures[record.case_] = record.value.median;
  }
  return figures;
}

TEST(Accuracy, ModelsAndSimulations) {
  const TempFolder folder;
  const auto arguments = accuracyArguments(
      folder, "msbrdf",
      {"--rays", "100000", "--json", folder / "copy.json", "--csv", folder / "copy.csv"});
  const ProcessResult result = runGlintmark(arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_EQ(result.err, "");

  std::map<std::string, std::set<std::string>> metrics;
  std::map<std::string, double> errors;
  double optimal = 0;
  for (const Record& record : readResults(folder / "r/results.json").records) {
    EXPECT_EQ(record.table, "accuracy");
    EXPECT_TRUE(record.valid) << record.case_ << " " << record.metric << ": " << record.note;
    metrics[record.case_].insert(record.metric);
    if (record.metric == "error") errors[record.case_] = record.value.median;
    if (record.metric == "pareto") optimal += record.value.median;
    EXPECT_EQ(record.config.at("rays"), "100000");
  }
  for (const char* name : {"msbrdf/model=lambert", "msbrdf/model=published", "msbrdf/model=refit",
                           "msbrdf/model=eon", "msbrdf/model=fitted", "msbrdf/rays=1e5"}) {
    for (const char* metric : {"error", "truth_stderr", "time_ratio", "time_ms", "pareto", "bias",
                               "rel_mse", "colour_error"})
      EXPECT_TRUE(metrics[name].contains(metric)) << name << " " << metric;
  }
  EXPECT_EQ(metrics.size(), 6u);
  EXPECT_GE(optimal, 1);
  // Lambert knows nothing of roughness: even so few rays tell that it is worse.
  EXPECT_GT(errors["msbrdf/model=lambert"], errors["msbrdf/model=eon"]);
  EXPECT_EQ(readFile(folder / "copy.json"), readFile(folder / "r/results.json"));

  const std::string table = readFile(folder / "r/table.txt");
  EXPECT_NE(table.find("The default of msbrdf has an error of"), std::string::npos) << table;
  EXPECT_NE(table.find("Not measured, being beyond --rays 100000: rays=1e6"), std::string::npos)
      << table;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;

  // A dot for each setting and for each kind's key in the legend: the default, a knob's other
  // models and one simulation.
  const std::string chart = readFile(folder / "r/accuracy_msbrdf.svg");
  EXPECT_TRUE(chart.starts_with("<svg ")) << chart.substr(0, 80);
  EXPECT_TRUE(chart.ends_with("</svg>\n"));
  EXPECT_EQ(countOf(chart, "<circle "), 6u + 3u) << chart;
  for (const char* name : {">msbrdf<", ">default<", ">sampled rival<"})
    EXPECT_EQ(countOf(chart, name), 1u) << name << " in " << chart;
  EXPECT_EQ(readImage(folder / "r/accuracy_msbrdf.png").width, 662);

  // All is there already: nothing is measured again, and nothing doubled.
  const std::string log = readFile(folder / "r/records.jsonl");
  const std::string results = readFile(folder / "r/results.csv");
  auto resume = arguments;
  resume.push_back("--resume");
  EXPECT_EQ(runGlintmark(resume).exit_code, 0);
  EXPECT_EQ(readFile(folder / "r/records.jsonl"), log);
  EXPECT_EQ(readFile(folder / "r/results.csv"), results);
}

TEST(Accuracy, FramesAgainstASupersampledTruth) {
  const TempFolder folder;
  // A small map and few lanes: fitted and compiled fast.
  const ProcessResult result = runGlintmark(accuracyArguments(
      folder, "gmm",
      {"--scene", "disk/oblique", "--width", "4", "--set", "material.silver.normal_map.size_px=64",
       "--knob", "lobes", "--knob", "texels", "--knob", "method", "--knob", "supersamples"}));
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  auto errors = figuresOf(folder, "error"), ratios = figuresOf(folder, "time_ratio"),
       truth = figuresOf(folder, "truth_stderr");
  EXPECT_EQ(errors.size(), 20u);
  // The default is one measurement under every knob.
  for (const char* name : {"gmm/lobes=4", "gmm/texels=float"}) {
    EXPECT_EQ(ratios[name], 1) << name;
    EXPECT_EQ(errors[name], errors["gmm/lobes=4"]) << name;
  }
  EXPECT_LT(errors["gmm/lobes=4"], errors["gmm/method=mip"]);
  EXPECT_LT(errors["gmm/lobes=4"], errors["gmm/method=fixed"]);
  // Samples that the truth has not used come closer and closer to it.
  EXPECT_LT(errors["gmm/supersamples=16"], errors["gmm/supersamples=1"]);
  EXPECT_LT(errors["gmm/supersamples=64"], errors["gmm/supersamples=16"]);
  EXPECT_GT(truth["gmm/lobes=4"], 0);
  EXPECT_GT(ratios["gmm/supersamples=64"], ratios["gmm/supersamples=4"]);
  std::istringstream lines(readFile(folder / "r/table.txt"));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(Accuracy, GlintsAgainstPlacedMicrodetails) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark(accuracyArguments(folder, "glints",
                                     {"--scene", "screen_plane/grazing", "--width", "8", "--knob",
                                      "method", "--knob", "truth", "--knob", "grids"}));
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  auto errors = figuresOf(folder, "error"), noise = figuresOf(folder, "truth_stderr");
  auto variances = figuresOf(folder, "variance_ratio"), dark = figuresOf(folder, "dark_share");
  auto true_dark = figuresOf(folder, "truth_dark_share");
  // Each method, and for it and three forms of the truth eighteen kinds of pixels and the near one.
  const auto methods = static_cast<std::size_t>(std::ranges::count_if(errors, [](const auto& one) {
    return one.first.starts_with("glints/method=") && one.first.find("lambda") == std::string::npos;
  }));
  EXPECT_GE(methods, 2u);
  EXPECT_EQ(errors.size(), methods + 2 + (methods + 3) * 19);
  EXPECT_EQ(errors["glints/grids=2"], errors["glints/method=zk16"]);
  // Draws of the number and placed microdetails agree as two samples do, in all that is compared.
  for (const char* aspect : {"1", "4", "16"}) {
    for (const char* lambda : {"0.1", "0.5", "2", "10", "100", "1000"}) {
      const std::string name =
          std::string("glints/truth=binomial/aspect=") + aspect + "/lambda=" + lambda;
      EXPECT_LT(errors[name], 2.5 * noise[name]) << name;
      // 512 pixels of each.
      EXPECT_NEAR(dark[name], true_dark[name], 0.1) << name;
      EXPECT_NEAR(variances[name], 1, 0.6) << name;
    }
  }
  // What averages whole cells has too little variance, and lights pixels that are dark.
  for (const char* method : {"zk16", "exact"}) {
    const std::string name = std::string("glints/method=") + method + "/aspect=1/lambda=";
    EXPECT_GT(errors[name + "0.5"], 0.4) << method;
    EXPECT_LT(errors[name + "100"], errors[name + "2"]) << method;
    EXPECT_LT(variances[name + "10"], 0.6) << method;
    EXPECT_LT(dark[name + "0.5"], 0.4) << method;
    EXPECT_GT(true_dark[name + "0.5"], 0.5) << method;
  }
  // Lobes have half of the variance.
  EXPECT_NEAR(variances["glints/truth=lobes/aspect=1/lambda=10"], 0.5, 0.15);
  for (const char* metric :
       {"lobes_error", "tent_error", "largest_of_bound", "truth_largest_of_bound", "correlation",
        "truth_correlation", "motion_ratio", "error_swing", "variance_swing", "dark_swing",
        "largest_swing", "correlation_swing", "motion_swing", "zoom_ratio", "zoom_swing",
        "octave_correlation", "bias"})
    EXPECT_TRUE(figuresOf(folder, metric).contains("glints/method=exact/aspect=4/lambda=2"))
        << metric;
  // Figures by replicate carry their spread.
  for (const Record& record : readResults(folder / "r/results.json").records)
    if (record.case_ == "glints/method=zk16/aspect=1/lambda=2" &&
        record.metric == "variance_ratio") {
      EXPECT_EQ(record.value.n, 8u);
      EXPECT_GT(record.value.stddev, 0);
    }
  std::istringstream lines(readFile(folder / "r/table.txt"));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(Accuracy, KnobsOfGlintsHaveErrorsOfTheirOwn) {
  const TempFolder folder;
  const ProcessResult result = runGlintmark(accuracyArguments(
      folder, "glints", {"--scene", "screen_plane/grazing", "--width", "8", "--knob", "ka"}));
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  auto errors = figuresOf(folder, "error"), motion = figuresOf(folder, "motion_ratio");
  EXPECT_EQ(errors.size(), 7u);
  // A footprint cut short shows the same cells for longer.
  EXPECT_GT(errors["glints/ka=1"], 1.3 * errors["glints/ka=16"]);
  EXPECT_LT(motion["glints/ka=1"], motion["glints/ka=16"]);
}

TEST(Accuracy, AreaLightsAndMonteCarlo) {
  const TempFolder folder;
  const ProcessResult result = runGlintmark(
      accuracyArguments(folder, "ltc",
                        {"--scene", "area_plane/front", "--scene", "area_glass/middle", "--width",
                         "4", "--knob", "horizon", "--knob", "edges", "--knob", "mc_samples"}));
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  auto errors = figuresOf(folder, "error");
  EXPECT_EQ(errors.size(), 3 * 11u) << "of both scenes together, and of each";
  for (const char* edges : {"acos", "rational"})
    EXPECT_NEAR(errors[std::string("ltc/edges=") + edges] / errors["ltc/edges=polynomial"], 1, 0.01)
        << edges;
  // The mean squared error of samples that the truth has not used goes with one over their number.
  EXPECT_NEAR(errors["ltc/mc_samples=4"] / errors["ltc/mc_samples=64"], 16, 6);
  EXPECT_GT(errors["ltc/mc_samples=1"], errors["ltc/mc_samples=4"]);
  for (const char* samples : {"1", "64"}) {
    const auto of = [&](const std::string& group) {
      return errors[group + "/mc_samples=" + samples];
    };
    EXPECT_NEAR(std::pow(of("ltc"), 2) / (of("ltc/area_plane/front") * of("ltc/area_glass/middle")),
                1, 1e-3);
  }
  // The more samples at the default's error, the longer: of one rival one figure in each group.
  auto times = figuresOf(folder, "time_at_default_error");
  EXPECT_EQ(times["ltc/mc_samples=1"], times["ltc/mc_samples=64"]);
  EXPECT_GT(times["ltc/area_plane/front/mc_samples=64"], 0);
  EXPECT_EQ(times["ltc/horizon=clipped"], 1);
  EXPECT_NE(readFile(folder / "r/table.txt").find("For the default's error mc_samples takes"),
            std::string::npos);
}

TEST(Accuracy, UnknownNamesListTheKnownOnes) {
  const TempFolder folder;
  const ProcessResult effect = runGlintmark(accuracyArguments(folder, "snow", {}));
  EXPECT_EQ(effect.exit_code, 2);
  EXPECT_NE(
      effect.err.find("unknown effect 'snow'; effects are glints, ltc, gmm, curvature, msbrdf"),
      std::string::npos)
      << effect.err;
  const ProcessResult scene = runGlintmark(accuracyArguments(folder, "gmm", {"--scene", "snow"}));
  EXPECT_EQ(scene.exit_code, 2);
  EXPECT_NE(scene.err.find("unknown scene 'snow'; scenes are disk/near"), std::string::npos)
      << scene.err;
  const ProcessResult knob = runGlintmark(accuracyArguments(folder, "gmm", {"--knob", "ka"}));
  EXPECT_EQ(knob.exit_code, 2);
  EXPECT_NE(knob.err.find("unknown knob 'ka'; knobs are lobes, alignment, probes"),
            std::string::npos)
      << knob.err;
  const ProcessResult rays = runGlintmark(accuracyArguments(folder, "msbrdf", {"--rays", "10"}));
  EXPECT_EQ(rays.exit_code, 2);
  EXPECT_NE(rays.err.find("--rays 10 is not from 100000"), std::string::npos) << rays.err;
  const ProcessResult size = runGlintmark(accuracyArguments(folder, "gmm", {"--size", "0x5"}));
  EXPECT_EQ(size.exit_code, 2);
  // Nothing was begun.
  EXPECT_FALSE(std::filesystem::exists(folder / "r"));
}

}  // namespace
}  // namespace glintmark
