// kernels/sample/glints.cl in a program that knows OpenCL and nothing of glintmark's host:
// shade_hits HITS KERNELS LANES METHOD. Fails where a bit differs from what HITS says.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/sample/hits_file.h"

namespace {

void check(cl_int status, const char* what) {
  if (status != CL_SUCCESS)
    throw std::runtime_error(std::string(what) + ": OpenCL error " + std::to_string(status));
}

cl_device_id deviceNamed(const char* name) {
  cl_platform_id platforms[16];
  cl_uint platform_count = 0;
  check(clGetPlatformIDs(16, platforms, &platform_count), "platforms");
  for (cl_uint p = 0; p < platform_count && p < 16; ++p) {
    cl_device_id devices[16];
    cl_uint device_count = 0;
    if (clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, 16, devices, &device_count) != CL_SUCCESS)
      continue;
    for (cl_uint d = 0; d < device_count && d < 16; ++d) {
      char found[256] = {};
      check(clGetDeviceInfo(devices[d], CL_DEVICE_NAME, sizeof found, found, nullptr), "a name");
      if (std::strncmp(found, name, sizeof found) == 0) return devices[d];
    }
  }
  throw std::runtime_error(std::string("no device is called ") + name);
}

std::string readAll(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file || text.empty()) throw std::runtime_error("cannot read " + path);
  return text;
}

cl_kernel buildKernel(cl_context context, cl_device_id device, const std::string& folder,
                      const std::string& lanes, const std::string& method) {
  const std::string source = readAll(folder + "/sample/glints.cl");
  const char* text = source.c_str();
  cl_int status = CL_SUCCESS;
  const cl_program program = clCreateProgramWithSource(context, 1, &text, nullptr, &status);
  check(status, "clCreateProgramWithSource");
  const std::string options = "-I " + folder + " -D WIDTH=" + lanes + " -D GLINT_METHOD=" + method;
  if (clBuildProgram(program, 1, &device, options.c_str(), nullptr, nullptr) != CL_SUCCESS) {
    std::vector<char> log(1 << 16);
    clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, log.size() - 1, log.data(),
                          nullptr);
    throw std::runtime_error(std::string("the sample does not compile:\n") + log.data());
  }
  const cl_kernel kernel = clCreateKernel(program, "shadeHits", &status);
  check(status, "clCreateKernel");
  return kernel;
}

// Radiance of every hit, arrays of r, g and b.
std::vector<std::uint32_t> shade(const HitsHeader& header, const std::uint32_t* hits,
                                 const std::string& folder, const std::string& lanes,
                                 const std::string& method) {
  cl_device_id device = deviceNamed(header.device);
  cl_int status = CL_SUCCESS;
  const cl_context context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, &status);
  check(status, "clCreateContext");
  const cl_command_queue queue = clCreateCommandQueue(context, device, 0, &status);
  check(status, "clCreateCommandQueue");
  const cl_kernel kernel = buildKernel(context, device, folder, lanes, method);
  const auto upload = [&](const void* data, std::size_t bytes) {
    const cl_mem buffer = clCreateBuffer(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, bytes,
                                         const_cast<void*>(data), &status);
    check(status, "clCreateBuffer");
    return buffer;
  };
  std::vector<std::uint32_t> radiance(3 * std::size_t{header.count});
  const cl_mem hit_buffer = upload(hits, std::size_t{kHitArrays} * header.count * 4);
  const cl_mem material = upload(header.material, header.material_bytes);
  const cl_mem out =
      clCreateBuffer(context, CL_MEM_WRITE_ONLY, radiance.size() * 4, nullptr, &status);
  check(status, "clCreateBuffer");
  check(clSetKernelArg(kernel, 0, sizeof(cl_mem), &hit_buffer), "hits");
  check(clSetKernelArg(kernel, 1, sizeof(cl_mem), &material), "material");
  check(clSetKernelArg(kernel, 2, sizeof header.irradiance, header.irradiance), "irradiance");
  check(clSetKernelArg(kernel, 3, sizeof(cl_mem), &out), "radiance");
  check(clSetKernelArg(kernel, 4, sizeof header.count, &header.count), "count");
  if (header.table_floats > 0) {
    const std::uint32_t* table = hits + (std::size_t{kHitArrays} + 3) * header.count;
    const cl_mem table_buffer = upload(table, std::size_t{header.table_floats} * 4);
    check(clSetKernelArg(kernel, 5, sizeof(cl_mem), &table_buffer), "the method's table");
  }
  const std::size_t items = header.count / std::stoul(lanes);
  check(clEnqueueNDRangeKernel(queue, kernel, 1, nullptr, &items, nullptr, 0, nullptr, nullptr),
        "the launch");
  check(clEnqueueReadBuffer(queue, out, CL_TRUE, 0, radiance.size() * 4, radiance.data(), 0,
                            nullptr, nullptr),
        "reading back");
  return radiance;
}

int run(char** argv) {
  const std::string text = readAll(argv[1]);
  HitsHeader header;
  std::memcpy(&header, text.data(), sizeof header);
  const std::size_t words = std::size_t{header.count} * (kHitArrays + 3) + header.table_floats;
  if (text.size() != sizeof header + words * 4)
    throw std::runtime_error(std::string(argv[1]) + " is no file of write_hits");
  std::vector<std::uint32_t> arrays(words);
  std::memcpy(arrays.data(), text.data() + sizeof header, words * 4);
  const std::uint32_t* wanted = arrays.data() + std::size_t{kHitArrays} * header.count;
  const std::vector<std::uint32_t> radiance =
      shade(header, arrays.data(), argv[2], argv[3], argv[4]);
  std::size_t different = 0;
  for (std::size_t i = 0; i < radiance.size(); ++i) different += radiance[i] != wanted[i];
  std::printf("%u hits, %zu of %zu values differ from the frame\n", header.count, different,
              radiance.size());
  return different == 0 && header.count > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: shade_hits HITS KERNELS LANES METHOD\n");
    return 2;
  }
  try {
    return run(argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "shade_hits: %s\n", error.what());
    return 1;
  }
}
