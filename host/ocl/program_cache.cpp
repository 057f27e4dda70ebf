#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

#include "host/core/atomic_file.h"
#include "host/core/disk_cache.h"
#include "host/core/stopwatch.h"
#include "host/core/trace.h"
#include "host/ocl/build_failure.h"
#include "host/ocl/driver_visit.h"
#include "host/ocl/kernel_folder.h"
#include "host/ocl/opencl.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

// The hash of all sources in the text makes drivers with a cache of their own, which may not look
// into included files, see every change; #line makes their messages name the file.
std::string sourceText(const fs::path& folder, const std::string& file, std::uint64_t hash) {
  return fmt::format("#line 1 \"{}\"  // {:016x}\n{}", file, hash, readFile(folder / file));
}

// Drivers may say that all is well with a program that is not built. The bindings ask for the log
// of a good build as well, and fail with those that refuse it.
cl_int buildProgram(const cl::Program& program, const cl::Device& device,
                    const std::string& options) {
  const cl_device_id id = device();
  const cl_int status = clBuildProgram(program(), 1, &id, options.c_str(), nullptr, nullptr);
  if (status != CL_SUCCESS) return status;
  cl_build_status built = CL_BUILD_SUCCESS;
  const bool known = clGetProgramBuildInfo(program(), id, CL_PROGRAM_BUILD_STATUS, sizeof built,
                                           &built, nullptr) == CL_SUCCESS;
  return known && built != CL_BUILD_SUCCESS ? CL_BUILD_PROGRAM_FAILURE : CL_SUCCESS;
}

// Empty if the driver refuses it.
std::string buildLog(const cl::Program& program, const cl::Device& device) {
  std::size_t bytes = 0;
  if (clGetProgramBuildInfo(program(), device(), CL_PROGRAM_BUILD_LOG, 0, nullptr, &bytes) !=
      CL_SUCCESS)
    return "";
  std::string log(bytes, '\0');
  if (clGetProgramBuildInfo(program(), device(), CL_PROGRAM_BUILD_LOG, bytes, log.data(),
                            nullptr) != CL_SUCCESS)
    return "";
  return log;
}

std::optional<cl::Program> buildFromBinary(const Device::Impl& device, const std::string& binary,
                                           const std::string& options) {
  try {
    const cl::Program::Binaries binaries = {{binary.begin(), binary.end()}};
    cl::Program program(device.context, {device.device}, binaries);
    if (buildProgram(program, device.device, options) != CL_SUCCESS) return std::nullopt;
    return program;
  } catch (const cl::Error&) {
    return std::nullopt;  // stale or damaged: the caller builds from source
  }
}

// Drivers such as PoCL keep what they compile themselves.
DiskCache programsOnDisk() {
  const char* chosen = std::getenv("GLINTMARK_PROGRAM_CACHE");
  return chosen && std::string_view(chosen) == "off" ? DiskCache::off()
                                                     : DiskCache::fromEnvironment();
}

}  // namespace

std::string programBinary(const cl::Program& program) {
  try {
    const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
    return binaries.empty() ? std::string() : std::string(binaries[0].begin(), binaries[0].end());
  } catch (const cl::Error&) {
    return {};
  }
}

struct ProgramCache::Impl {
  explicit Impl(Device& opened) : info(opened.info()) {
    device.device = opened.impl().device;
    device.context = opened.impl().context;
    device.queue = opened.impl().queue;
    device.clock = opened.impl().clock;
  }

  ~Impl() {
    const DriverCall call("releasing programs");
    memory.clear();
    device = Device::Impl{};
  }

  cl::Program buildFromSource(const std::string& file, const std::string& options,
                              std::uint64_t hash) {
    try {
      cl::Program program(device.context, sourceText(folder, file, hash));
      const cl_int status = buildProgram(program, device.device, options);
      if (status == CL_BUILD_PROGRAM_FAILURE)
        throw reportFailedBuild(
            {file, folder, options, buildLog(program, device.device), info.name});
      if (status != CL_SUCCESS) throw cl::Error(status, "clBuildProgram");
      return program;
    } catch (const cl::Error& error) {
      throw openClError(fmt::format("building kernel file '{}'", file), error);
    }
  }

  Program build(const std::string& file, const std::string& own_options);

  DeviceInfo info;
  Device::Impl device;
  std::string folder = kernelFolder();
  KernelHash kernel_hash{folder};
  DiskCache disk = programsOnDisk();
  std::map<std::string, std::shared_ptr<BuiltProgram>> memory;  // by key
};

Program ProgramCache::Impl::build(const std::string& file, const std::string& own_options) {
  const Stopwatch watch;
  if (!fs::is_regular_file(fs::path(folder) / file))
    throw Error(fmt::format("kernel file '{}' is not in the kernel folder '{}'", file, folder));

  std::string options = own_options + " -cl-std=CL1.2 -cl-kernel-arg-info";
  if (info.correctly_rounded_divide_sqrt) options += " -cl-fp32-correctly-rounded-divide-sqrt";
  const std::uint64_t hash = kernel_hash.get();
  const std::string name = fmt::format("{}\n{}\n{}\n{}\n", file, options, info.name, info.platform);
  const std::string key =
      fmt::format("{}{}\n{}\n{:016x}\n", name, info.platform_version, info.driver_version, hash);
  auto program = std::make_shared<Program::Impl>();
  program->built = memory[key];
  if (program->built) return Program(program);

  const TraceScope scope("build", file);
  const DriverVisit visit("compiling " + file, kCompilerPatience);
  const IncludePath include(folder);
  options += " -I " + include.path();
  std::optional<cl::Program> built;
  if (const auto binary = disk.load(name, key)) built = buildFromBinary(device, *binary, options);
  program->from_disk_cache = built.has_value();
  if (!built) built = buildFromSource(file, options, hash);
  program->built = std::make_shared<BuiltProgram>(BuiltProgram{*built,
                                                               device.device,
                                                               device.queue,
                                                               file,
                                                               options,
                                                               {},
                                                               device.clock,
                                                               info.max_work_group_size});
  memory[key] = program->built;
  program->build_ns = watch.elapsedNs();
  // After the clock has stopped: asking PoCL for a binary compiles every kernel once more.
  if (!program->from_disk_cache && !disk.isOff()) disk.store(name, key, programBinary(*built));
  return Program(program);
}

ProgramCache::ProgramCache(Device& device) : impl_(std::make_shared<Impl>(device)) {}

Program ProgramCache::get(const std::string& file, const KernelConfig& config) {
  return impl_->build(file, programOptions(config));
}

Program ProgramCache::getWithOptions(const std::string& file, const std::string& options) {
  return impl_->build(file, options);
}

}  // namespace glintmark
