#include <dlfcn.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "tests/ocl/ocl_test.h"

namespace glintmark {
namespace {

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

TEST(Device, ListsFactsThatHangTogether) {
  const std::vector<DeviceInfo> devices = listDevices();
  ASSERT_FALSE(devices.empty()) << "these tests need an OpenCL device: install pocl-opencl-icd";
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceInfo& info = devices[i];
    EXPECT_EQ(info.index, static_cast<int>(i));
    EXPECT_FALSE(info.name.empty());
    EXPECT_FALSE(info.platform_version.empty());
    EXPECT_FALSE(info.driver_version.empty());
    EXPECT_EQ(info.is_cpu, info.type == "CPU");
    EXPECT_GE(info.compute_units, 1u);
    EXPECT_GT(info.max_alloc_bytes, 0u);
    EXPECT_GE(info.global_mem_bytes, info.max_alloc_bytes);
    const int w = info.default_lanes;
    EXPECT_TRUE(w == 1 || (info.is_cpu && (w == 4 || w == 8 || w == 16))) << w;
    EXPECT_TRUE(!info.is_cpu || w >= static_cast<int>(std::min(16u, info.preferred_float_width)));
  }
}

TEST(Device, IsChosenByIndexNameOrPlatformInAnyCase) {
  const DeviceInfo first = listDevices().at(0);
  EXPECT_EQ(Device("0").info().name, first.name);
  EXPECT_EQ(Device(first.name).info().index, 0);
  EXPECT_EQ(Device(upper(first.name).substr(0, 5)).info().index, 0);
  if (listDevices().size() == 1) {
    EXPECT_EQ(Device(upper(first.platform)).info().index, 0);
  }
}

TEST(Device, EmptySelectorPrefersAGpu) {
  const std::vector<DeviceInfo> devices = listDevices();
  const auto gpu = std::ranges::find(devices, false, &DeviceInfo::is_cpu);
  EXPECT_EQ(Device().info().index, gpu == devices.end() ? 0 : gpu->index);
}

TEST(Device, UnknownSelectorListsWhatThereIs) {
  const DeviceInfo first = listDevices().at(0);
  for (const char* selector : {"no such device", "99", "99999999999999999999"}) {
    try {
      Device device(selector);
      FAIL() << selector << " was accepted";
    } catch (const DeviceError& error) {
      const std::string message = error.what();
      EXPECT_EQ(error.code(), kExitNoDevice);
      EXPECT_NE(message.find("no OpenCL device matches '" + std::string(selector) + "'"),
                std::string::npos)
          << message;
      EXPECT_NE(message.find("0: " + first.name), std::string::npos) << message;
      EXPECT_NE(message.find(first.platform), std::string::npos) << message;
    }
  }
}

TEST(Device, IsUsableAfterAMove) {
  Device device;
  const std::string name = device.info().name;
  Device moved = std::move(device);
  EXPECT_EQ(moved.info().name, name);
  EXPECT_NO_THROW(Buffer(moved, 16, BufferPurpose::kProbe));
}

TEST(Device, GivesSomeOfItsComputeUnits) {
  const Device device;
  const unsigned all = device.info().compute_units;
  Device part = device.part(1);
  EXPECT_EQ(part.info().compute_units, 1u);
  EXPECT_NO_THROW(Buffer(part, 16, BufferPurpose::kProbe));
  EXPECT_THROW(device.part(0), DeviceError);
  EXPECT_THROW(device.part(all + 1), DeviceError);
}

// The loader reads OCL_ICD_VENDORS once per process, hence a process of its own.
TEST(DeviceDeathTest, NoPlatformIsAnEmptyListAndASentenceThatNamesThePackage) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto without_platform = [] {
    setenv("OCL_ICD_VENDORS", "/nonexistent", 1);
    if (!listDevices().empty()) std::exit(10);
    try {
      Device device;
    } catch (const DeviceError& error) {
      std::fprintf(stderr, "%s\n", error.what());
      std::exit(error.code());
    }
    std::exit(11);
  };
  EXPECT_EXIT(without_platform(), testing::ExitedWithCode(kExitNoDevice),
              "no OpenCL device found: no OpenCL driver is installed; the package pocl-opencl-icd "
              "provides one");
}

// A CUDA toolkit brings a loader of its own, which must not be the one that is linked.
TEST(Device, LoaderIsTheDistributions) {
  ASSERT_FALSE(listDevices().empty());
  void* symbol = dlsym(RTLD_DEFAULT, "clGetPlatformIDs");
  Dl_info where{};
  ASSERT_TRUE(symbol && dladdr(symbol, &where));
  const std::string path = std::filesystem::canonical(where.dli_fname).string();
  EXPECT_EQ(path.find("cuda"), std::string::npos) << path;
  EXPECT_TRUE(path.starts_with("/usr/lib") || path.starts_with("/lib")) << path;
}

}  // namespace
}  // namespace glintmark
