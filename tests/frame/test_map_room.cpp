// Normal maps for which there is no room are refused before they are made.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "host/core/error.h"
#include "host/core/free_memory.h"
#include "host/filter/normal_map_generators.h"
#include "host/filter/normal_moments.h"
#include "host/frame/effect/normal_maps.h"
#include "host/frame/map_room.h"
#include "host/ocl/switches.h"
#include "tests/frame/frame_test.h"

namespace glintmark {
namespace {

// A floor with a map that has a size, but no normals yet.
Scene plannedFloor(int size_px) {
  return mappedFloor({"stone", size_px, size_px, {}});
}

std::string refusal(int size_px, NormalMethod method, double device_gb) {
  ShadingOptions options = smallOptions();
  options.normal_method = method;
  try {
    requireRoomForMaps(plannedFloor(size_px), options, false, [&] {
      DeviceInfo info;
      info.name = "small device";
      info.max_alloc_bytes = static_cast<unsigned long long>(device_gb * 1e9);
      return info;
    });
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void expectParts(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
}

// 4096 x 4096 x 4/3 texels of two float4 are 0.72 GB.
TEST(MapRoom, ABufferThatTheDeviceDoesNotAllowIsNamed) {
  EXPECT_EQ(refusal(4096, NormalMethod::kLean, 0.72), "");
  const std::string text = refusal(4096, NormalMethod::kLean, 0.5);
  expectParts(text, {"'stone' of 4096x4096", "normal method lean", "0.7 GB in one buffer",
                     "'small device' allows at most 0.5 GB", "at most 3423x3423 texels",
                     "toksvig, which needs 0.4 GB"});
  // What it says fits does.
  EXPECT_EQ(refusal(3423, NormalMethod::kLean, 0.5), "");
  EXPECT_EQ(refusal(4096, NormalMethod::kToksvig, 0.5), "");
}

TEST(MapRoom, MixturesNeedMoreThanTheirTexels) {
  KernelConfig config;
  config.normal_method = NormalMethod::kGmm;
  config.lobes = 4;
  const TextureNeed need = textureNeed(1024, 1024, config);
  EXPECT_EQ(need.buffer_bytes, ((std::uint64_t{1} << 22) - 1) / 3 * 4 * 16);
  EXPECT_GT(need.host_bytes, need.buffer_bytes);
  config.half_texels = true;
  EXPECT_EQ(textureNeed(1024, 1024, config).buffer_bytes, need.buffer_bytes / 2);
  for (const NormalMethod method :
       {NormalMethod::kMip, NormalMethod::kFixed, NormalMethod::kLeadr, NormalMethod::kFournier,
        NormalMethod::kVmfLobes, NormalMethod::kAnisotropic}) {
    config.normal_method = method;
    const TextureNeed other = textureNeed(64, 64, config);
    NormalTextures textures(device());
    config.lobes = 4;
    const auto map = std::make_shared<const NormalMap>(generateNormalMap({"disk", 64}));
    EXPECT_EQ(textures.get(map, config).texels.bytes(), other.buffer_bytes) << choiceName(method);
    EXPECT_GE(other.host_bytes, other.buffer_bytes) << choiceName(method);
  }
}

// Of /proc/self/status [bytes].
double statusBytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key + ":")) return 1024 * std::stod(line.substr(key.size() + 1));
  return 0;
}

TEST(MapRoom, MomentsTakeAsMuchAsIsSaid) {
  const NormalMap map = generateNormalMap({"disk", 2048});
  const auto peak = [](const auto& make) {
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
    const double before_bytes = statusBytes("VmRSS");
    [[maybe_unused]] const MipTexels made = make();
    return statusBytes("VmHWM") - before_bytes;
  };
  KernelConfig config;
  config.normal_method = NormalMethod::kToksvig;
  const auto said = [&] {
    return static_cast<double>(textureNeed(map.width_px, map.height_px, config).host_bytes);
  };
  EXPECT_NEAR(peak([&] { return meanNormals(map); }) / said(), 1, 0.12);
  config.normal_method = NormalMethod::kLean;
  EXPECT_NEAR(peak([&] { return leanMoments(map); }) / said(), 1, 0.12);
}

TEST(MapRoom, MemoryThatIsNotThereIsNamed) {
  const std::uint64_t free_bytes = freeMemoryBytes();
  if (free_bytes == 0 || free_bytes > std::uint64_t{60} << 30)
    GTEST_SKIP() << "every map fits this machine";
  const std::string text = refusal(16384, NormalMethod::kAnisotropic, 1e3);
  expectParts(text, {"'stone' of 16384x16384", "normal method anisotropic with 4 lobes",
                     "GB are free", "give the map at most"});
}

// The same kind of question costs small scenes nothing: no device is asked.
TEST(MapRoom, SmallMapsAskNobody) {
  requireRoomForMaps(plannedFloor(512), smallOptions(), false,
                     []() -> DeviceInfo { throw Error("asked"); });
  EXPECT_THROW(requireRoomForMaps(plannedFloor(8192), smallOptions(), false,
                                  []() -> DeviceInfo { throw Error("asked"); }),
               Error);
}

}  // namespace
}  // namespace glintmark
