// The same call further down, for a driver with faults.
#pragma once
#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#include <CL/cl.h>
#include <dlfcn.h>

#include <cstddef>
#include <cstring>
#include <string>

namespace faulty {

/// The loader's, which programs like mpirun load for themselves only.
template <typename Function>
Function nextCall(Function, const char* name) {
  static void* const loader = dlopen("libOpenCL.so.1", RTLD_NOW | RTLD_LOCAL);
  void* const next = dlsym(RTLD_NEXT, name);
  return reinterpret_cast<Function>(next ? next : dlsym(loader, name));
}
#define REAL(call) ::faulty::nextCall(&call, #call)

/// Gives `value` as an info call does.
template <typename T>
cl_int give(const T& value, std::size_t bytes, void* out, std::size_t* needed) {
  if (needed) *needed = sizeof value;
  if (!out) return CL_SUCCESS;
  if (bytes < sizeof value) return CL_INVALID_VALUE;
  std::memcpy(out, &value, sizeof value);
  return CL_SUCCESS;
}

/// Ends the process by the signal of a bad access, whatever handler the driver below has set.
void die();

/// The function's name in the source.
std::string nameOf(cl_kernel kernel);

/// What `at=WHEN:DEED` asks for; WHEN is looking, opening, building, launching, reading or closing.
void misbehave(const char* when);

}  // namespace faulty
