// Compilers and kernels with faults; see fault_list.h.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "tests/faulty_driver/fault_list.h"
#include "tests/faulty_driver/next_call.h"

namespace faulty {
namespace {

bool holds(const char* options, const char* fault) {
  const auto text = valueOf(fault);
  return text && options && std::strstr(options, text->c_str());
}

std::string failedLog(const std::string& kind) {
  if (kind == "empty") return std::string(1, '\0');
  if (kind == "none") return "";
  if (kind == "long") return std::string(10'000'000, 'w') + " error: far behind\0";
  if (kind == "lines") {
    std::string text;
    for (int i = 0; i < 100000; ++i) text += "shade.cl:1: warning: unused value\n";
    return text + '\0';
  }
  return std::string("\xff\xfe error: \xe9\x01\x1b[31m\0", 17);
}

}  // namespace
}  // namespace faulty

using namespace faulty;

extern "C" {

cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id* devices,
                      const char* options, void(CL_CALLBACK* notify)(cl_program, void*),
                      void* user) {
  misbehave("building");
  if (holds(options, "build")) die();
  while (valueOf("build_stalls")) pause();
  sleep(static_cast<unsigned>(numberOf("build_s")));
  if (valueOf("log")) return CL_BUILD_PROGRAM_FAILURE;
  if (valueOf("unbuilt")) return CL_SUCCESS;
  return REAL(clBuildProgram)(program, count, devices, options, notify, user);
}

cl_int clGetProgramBuildInfo(cl_program program, cl_device_id device, cl_program_build_info fact,
                             size_t bytes, void* out, size_t* needed) {
  if (const auto kind = valueOf("log"); kind && fact == CL_PROGRAM_BUILD_LOG) {
    if (*kind == "refused") return CL_OUT_OF_HOST_MEMORY;
    const std::string text = failedLog(*kind);
    if (needed) *needed = text.size();
    if (out) std::memcpy(out, text.data(), std::min(bytes, text.size()));
    return CL_SUCCESS;
  }
  return REAL(clGetProgramBuildInfo)(program, device, fact, bytes, out, needed);
}

cl_int clGetProgramInfo(cl_program program, cl_program_info fact, size_t bytes, void* out,
                        size_t* needed) {
  const bool is_binary = fact == CL_PROGRAM_BINARIES || fact == CL_PROGRAM_BINARY_SIZES;
  if (is_binary && asked("binary", "refused")) return CL_INVALID_PROGRAM_EXECUTABLE;
  if (asked("binary", "empty") && fact == CL_PROGRAM_BINARY_SIZES)
    return give(size_t{0}, bytes, out, needed);
  if (asked("binary", "empty") && fact == CL_PROGRAM_BINARIES) {
    if (needed) *needed = sizeof(unsigned char*);
    return CL_SUCCESS;
  }
  return REAL(clGetProgramInfo)(program, fact, bytes, out, needed);
}

cl_program clCreateProgramWithBinary(cl_context context, cl_uint count, const cl_device_id* devices,
                                     const size_t* sizes, const unsigned char** binaries,
                                     cl_int* statuses, cl_int* status) {
  if (asked("binary", "other")) {  // whatever it was given
    static const char* source = "kernel void other(global int* out) { out[0] = 1; }";
    if (statuses) std::fill_n(statuses, count, CL_SUCCESS);
    return clCreateProgramWithSource(context, 1, &source, nullptr, status);
  }
  return REAL(clCreateProgramWithBinary)(context, count, devices, sizes, binaries, statuses,
                                         status);
}

cl_kernel clCreateKernel(cl_program program, const char* name, cl_int* status) {
  if (asked("unmade", name)) {
    if (status) *status = CL_INVALID_KERNEL_DEFINITION;
    return nullptr;
  }
  return REAL(clCreateKernel)(program, name, status);
}

cl_int clGetKernelWorkGroupInfo(cl_kernel kernel, cl_device_id device,
                                cl_kernel_work_group_info fact, size_t bytes, void* out,
                                size_t* needed) {
  if (fact == CL_KERNEL_WORK_GROUP_SIZE) {
    if (asked("zero", "groups")) return CL_INVALID_VALUE;
    if (const size_t most = numberOf("groups")) return give(most, bytes, out, needed);
    if (valueOf("kernel_groups"))
      return give(size_t{numberOf("kernel_groups")}, bytes, out, needed);
  }
  return REAL(clGetKernelWorkGroupInfo)(kernel, device, fact, bytes, out, needed);
}

cl_int clGetKernelArgInfo(cl_kernel kernel, cl_uint index, cl_kernel_arg_info fact, size_t bytes,
                          void* out, size_t* needed) {
  if (valueOf("no_arg_info")) return CL_KERNEL_ARG_INFO_NOT_AVAILABLE;
  return REAL(clGetKernelArgInfo)(kernel, index, fact, bytes, out, needed);
}

}  // extern "C"
