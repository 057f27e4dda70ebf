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
#include "host/ocl/compiler_watch.h"
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

std::optional<cl::Program> buildFromBinary(const Device::Impl& device, const std::string& binary,
                                           const std::string& options) {
  try {
    const cl::Program::Binaries binaries = {{binary.begin(), binary.end()}};
    cl::Program program(device.context, {device.device}, binaries);
    program.build({device.device}, options.c_str());
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

  cl::Program buildFromSource(const std::string& file, const std::string& options,
                              std::uint64_t hash) {
    try {
      cl::Program program(device.context, sourceText(folder, file, hash));
      program.build({device.device}, options.c_str());
      return program;
    } catch (const cl::BuildError& error) {
      const auto log = error.getBuildLog();
      throw reportFailedBuild(
          {file, folder, options, log.empty() ? std::string() : log[0].second, info.name});
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
  const CompilerWatch compiler_watch(file);
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
