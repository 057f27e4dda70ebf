#include <fmt/format.h>

#include <algorithm>

#include "host/ocl/driver_visit.h"
#include "host/ocl/opencl.h"

namespace glintmark {
namespace {

const Program::Impl& fromCache(const std::shared_ptr<Program::Impl>& impl) {
  if (!impl) throw Error("an empty program was used; it must come from a program cache");
  return *impl;
}

// Drivers may keep no names, although the build asked for them (-cl-kernel-arg-info).
std::vector<std::string> parameterNames(const cl::Kernel& kernel) {
  std::vector<std::string> names;
  try {
    const auto count = kernel.getInfo<CL_KERNEL_NUM_ARGS>();
    for (cl_uint i = 0; i < count; ++i) {
      std::string name = kernel.getArgInfo<CL_KERNEL_ARG_NAME>(i);
      while (!name.empty() && name.back() == '\0') name.pop_back();  // C++ bindings before 2.0.10
      if (name.empty()) return {};
      names.push_back(std::move(name));
    }
  } catch (const cl::Error&) {
    return {};
  }
  return names;
}

// The larger groups that a device takes may still be too large for one of its kernels.
std::size_t maxLocalSize(const cl::Kernel& kernel, const BuiltProgram& built) {
  std::size_t of_kernel = 0;
  try {
    of_kernel = kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(built.device);
  } catch (const cl::Error&) {
    return built.max_local_size;
  }
  if (of_kernel == 0 || built.max_local_size == 0) return std::max(of_kernel, built.max_local_size);
  return std::min(of_kernel, built.max_local_size);
}

}  // namespace

Kernel Program::kernel(const std::string& name) const {
  BuiltProgram& built = *fromCache(impl_).built;
  std::shared_ptr<Kernel::Impl>& kernel = built.kernels[name];
  if (kernel) return Kernel(kernel);
  const DriverVisit visit(fmt::format("compiling kernel '{}' of {}", name, built.file),
                          kCompilerPatience);
  try {
    auto made = std::make_shared<Kernel::Impl>();
    made->kernel = cl::Kernel(built.program, name.c_str());
    made->queue = built.queue;
    made->name = name;
    made->parameter_names = parameterNames(made->kernel);
    made->clock = built.clock;
    made->max_local_size = maxLocalSize(made->kernel, built);
    kernel = std::move(made);
  } catch (const cl::Error& error) {
    built.kernels.erase(name);
    if (error.err() == CL_INVALID_KERNEL_NAME)
      throw Error(fmt::format("kernel file '{}' has no kernel '{}'; it has {}", built.file, name,
                              built.program.getInfo<CL_PROGRAM_KERNEL_NAMES>()));
    throw openClError(fmt::format("making kernel '{}' of '{}'", name, built.file), error);
  }
  return Kernel(kernel);
}

double Program::buildNs() const {
  return fromCache(impl_).build_ns;
}

bool Program::fromDiskCache() const {
  return fromCache(impl_).from_disk_cache;
}

const std::string& Program::options() const {
  return fromCache(impl_).built->options;
}

std::string Program::binary() const {
  return programBinary(fromCache(impl_).built->program);
}

}  // namespace glintmark
