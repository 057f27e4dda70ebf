// What the OpenCL tests share: a cache folder and a kernel folder of their own.
#pragma once
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <string>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/ocl/compute.h"
#include "host/ocl/device.h"

namespace glintmark {

/// The project's own.
inline const std::filesystem::path kKernels =
    std::filesystem::path(GLINTMARK_SOURCE_DIR) / "kernels";

/// A folder that is gone with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "glintmark-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw Error("cannot make a temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The message of the Error that `act` throws, "" if it throws none.
template <typename Act>
std::string errorOf(Act&& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Runs with an empty program cache and a kernel folder that holds tiny.cl.
class OclTest : public testing::Test {
 protected:
  OclTest() {
    cache_ = folder_.path() / "cache";
    kernels_ = folder_.path() / "kernels";
    std::filesystem::create_directory(kernels_);
    writeFile(kernels_ / "tiny.clh", "#define STEP 3u\n");
    writeFile(kernels_ / "tiny.cl", kTiny);
    setenv("GLINTMARK_CACHE_DIR", cache_.c_str(), 1);
    setenv("GLINTMARK_KERNELS", kernels_.c_str(), 1);
  }
  ~OclTest() override {
    unsetenv("GLINTMARK_CACHE_DIR");
    unsetenv("GLINTMARK_KERNELS");
  }

  /// Element 0 after `program`'s kernel "count" ran over 64 zeros.
  static std::uint32_t runCount(Device& device, const Program& program) {
    Buffer values(device, 64 * 4, BufferPurpose::kProbe);
    values.fillZero();
    const KernelArg args[] = {values, std::uint32_t{64}};
    program.kernel("count").launch(args, 64, 16);
    std::uint32_t first = 0;
    values.read(&first, 4);
    return first;
  }

  static constexpr const char* kTiny = R"(#include "tiny.clh"
__kernel void count(__global uint* values, uint n) {
  if (get_global_id(0) < n) values[get_global_id(0)] += STEP;
}
__kernel void scalars(__global float* out, int i, uint u, float f) {
  out[0] = (float)i;
  out[1] = (float)u;
  out[2] = f;
}
)";

  TemporaryFolder folder_;
  std::filesystem::path cache_, kernels_;
};

/// The same with the project's probes.
class ProbeKernelsTest : public OclTest {
 protected:
  ProbeKernelsTest() {
    const std::filesystem::path project = std::filesystem::path(GLINTMARK_SOURCE_DIR) / "kernels";
    std::filesystem::copy(project / "probes", kernels_ / "probes");
    for (const char* file :
         {"config.clh", "types.h", "area/area_config.clh", "glint/glint_config.clh",
          "normals/normal_config.clh", "scatter/scatter_config.clh"}) {
      std::filesystem::create_directories((kernels_ / file).parent_path());
      std::filesystem::copy(project / file, kernels_ / file);
    }
  }
};

}  // namespace glintmark
