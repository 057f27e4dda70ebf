// Platforms and devices as the OpenCL loader gives them, with their OpenCL handles.
#pragma once
#include <string>
#include <vector>

#include "host/ocl/opencl.h"

namespace glintmark {

struct FoundDevice {
  cl::Platform platform;
  cl::Device device;
  DeviceInfo info;
};

struct FoundPlatforms {
  PlatformList list;
  std::vector<FoundDevice> devices;  // all, in the order of their index
};

FoundPlatforms findPlatforms();

/// Empty where the driver refuses.
std::string platformText(const cl::Platform& platform, cl_platform_info fact);

DeviceInfo describeDevice(const PlatformInfo& platform, const cl::Device& device, int index);

/// The index into `devices` that `selector` means; see Device. Throws DeviceError.
std::size_t chooseDevice(const FoundPlatforms& found, const std::string& selector);

/// See PlatformList; registered in $OCL_ICD_VENDORS, else in /etc/OpenCL/vendors.
std::vector<std::string> brokenDrivers();

}  // namespace glintmark
