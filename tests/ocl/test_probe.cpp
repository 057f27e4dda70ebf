#include "host/ocl/kernel_folder.h"
#include "tests/ocl/ocl_test.h"

namespace glintmark {
namespace {

// Bounds no device passes: they catch a wrong unit or an optimised-away loop.
constexpr double kMinPeak = 0.01;
constexpr double kMaxGflops = 1e6;
constexpr double kMaxGbs = 1e5;
// One core cannot do more than two 16-lane FMA units at 6 GHz.
constexpr double kMaxGflopsPerCore = 2 * 16 * 2 * 6.0;

class ProbeTest : public ProbeKernelsTest {
 protected:
  Device device_;
  ProgramCache cache_{device_};
};

TEST_F(ProbeTest, PeaksArePlausible) {
  for (const int lanes : {1, device_.info().default_lanes}) {
    const DevicePeaks peaks = measurePeaks(device_, cache_, lanes);
    EXPECT_GT(peaks.gflops, kMinPeak);
    EXPECT_LT(peaks.gflops, kMaxGflops);
    EXPECT_GT(peaks.gbs, kMinPeak);
    EXPECT_LT(peaks.gbs, kMaxGbs);
    if (device_.info().is_cpu) {
      EXPECT_LT(peaks.gflops, kMaxGflopsPerCore * device_.info().compute_units);
    }
    RecordProperty("gflops_w" + std::to_string(lanes), std::to_string(peaks.gflops));
    RecordProperty("gbs_w" + std::to_string(lanes), std::to_string(peaks.gbs));
  }
}

TEST_F(ProbeTest, PeaksRefuseAnUnknownWidth) {
  EXPECT_EQ(errorOf([&] { measurePeaks(device_, cache_, 5); }),
            "kernel width 5 is not one of 1, 4, 8 and 16");
}

// A device that computes something else must not be given a peak.
TEST_F(ProbeTest, PeaksCheckTheAnswer) {
  std::string source = readFile(kernels_ / "probes/probe.cl");
  const std::string line = "x7 = fma(x7, va, vb);";
  ASSERT_NE(source.find(line), std::string::npos);
  source.replace(source.find(line), line.size(), "x7 = fma(x7, va, va + vb);");
  writeFile(kernels_ / "probes/probe.cl", source);
  ProgramCache wrong(device_);
  EXPECT_EQ(errorOf([&] { measurePeaks(device_, wrong, 1); }),
            "the FMA probe gave 13 instead of 12 on '" + device_.info().name +
                "', so its peak is unknown");
}

}  // namespace
}  // namespace glintmark
