#include "host/ocl/platforms.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "host/core/atomic_file.h"
#include "host/ocl/driver_death.h"
#include "host/ocl/driver_text.h"
#include "host/ocl/driver_visit.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVendorFolder = "/etc/OpenCL/vendors";
constexpr const char* kAdvice = "the package pocl-opencl-icd provides one for any processor";

std::string lowered(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// Why the library that a file of the loader's names cannot be loaded; nothing if it can.
std::optional<std::string> loadFault(const fs::path& icd) {
  std::string library;
  try {
    library = readFile(icd);
  } catch (const Error& error) {
    return error.what();
  }
  library = library.substr(0, library.find_first_of("\r\n"));
  // Never closed: drivers do not expect to be unloaded.
  if (dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL)) return std::nullopt;
  const char* why = dlerror();
  return why ? why : "it cannot be loaded";
}

std::vector<cl::Platform> allPlatforms(std::string& problem) {
  cl_uint count = 0;
  const cl_int status = clGetPlatformIDs(0, nullptr, &count);
  std::vector<cl_platform_id> ids(status == CL_SUCCESS ? count : 0);
  if (!ids.empty() && clGetPlatformIDs(count, ids.data(), nullptr) != CL_SUCCESS) ids.clear();
  std::vector<cl::Platform> platforms;
  for (cl_platform_id id : ids) platforms.emplace_back(id);
  if (!platforms.empty()) return platforms;
  if (status != CL_SUCCESS && status != CL_PLATFORM_NOT_FOUND_KHR)
    problem = fmt::format("the OpenCL loader fails with {}", openClErrorName(status));
  else
    problem = fmt::format("no OpenCL driver is installed; {}", kAdvice);
  for (const std::string& broken : brokenDrivers())
    problem = fmt::format("no OpenCL driver can be loaded; {}", broken);
  return platforms;
}

// PoCL has those alone that this variable names.
std::string whyNoDevices(const std::string& platform) {
  const char* chosen = std::getenv("POCL_DEVICES");
  return chosen && platform.find("Portable Computing Language") != std::string::npos
             ? fmt::format("it has no devices, POCL_DEVICES is '{}'", shownText(chosen))
             : "it has no devices";
}

std::vector<cl::Device> devicesOf(const cl::Platform& platform, const std::string& name,
                                  std::string& problem) {
  cl_uint count = 0;
  cl_int status = clGetDeviceIDs(platform(), CL_DEVICE_TYPE_ALL, 0, nullptr, &count);
  std::vector<cl_device_id> ids(status == CL_SUCCESS ? count : 0);
  if (!ids.empty())
    status = clGetDeviceIDs(platform(), CL_DEVICE_TYPE_ALL, count, ids.data(), nullptr);
  if (status == CL_DEVICE_NOT_FOUND || (status == CL_SUCCESS && count == 0))
    problem = whyNoDevices(name);
  else if (status != CL_SUCCESS)
    problem = fmt::format("its driver fails with {}", openClErrorName(status));
  if (!problem.empty()) return {};
  std::vector<cl::Device> devices;
  for (cl_device_id id : ids) devices.emplace_back(id, false);
  return devices;
}

// "0: NAME (PLATFORM), 1: …", each with what is wrong with it.
std::string known(const FoundPlatforms& found, const std::vector<std::size_t>& indices) {
  std::string text;
  for (const std::size_t i : indices) {
    const DeviceInfo& info = found.devices[i].info;
    text += fmt::format("{}{}: {} ({})", text.empty() ? "" : ", ", i, info.name, info.platform);
    if (!info.problem.empty()) text += ", but " + info.problem;
  }
  return text;
}

std::vector<std::size_t> allIndices(const FoundPlatforms& found) {
  std::vector<std::size_t> indices(found.devices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = i;
  return indices;
}

// Why there is no device at all, platform by platform.
std::string whyNone(const PlatformList& list) {
  std::string text = list.problem;
  for (const PlatformInfo& platform : list.platforms)
    text += fmt::format("{}'{}': {}", text.empty() ? "" : ", ", platform.name, platform.problem);
  if (list.problem.empty()) text += fmt::format("; {}", kAdvice);
  return text;
}

std::size_t firstChoice(const FoundPlatforms& found) {
  const auto usable = [&](bool gpu) {
    return std::ranges::find_if(found.devices, [gpu](const FoundDevice& f) {
      return f.info.problem.empty() && (!gpu || !f.info.is_cpu);
    });
  };
  auto chosen = usable(true);
  if (chosen == found.devices.end()) chosen = usable(false);
  if (chosen == found.devices.end())
    throw DeviceError(
        fmt::format("no OpenCL device can be used; there are {}", known(found, allIndices(found))));
  return static_cast<std::size_t>(chosen - found.devices.begin());
}

// Devices whose own name is `wanted`, or failing these, those whose or whose platform's name holds
// it.
std::vector<std::size_t> matching(const FoundPlatforms& found, const std::string& wanted) {
  std::vector<std::size_t> same, like;
  for (std::size_t i = 0; i < found.devices.size(); ++i) {
    const std::string name = lowered(found.devices[i].info.name);
    if (name == wanted) same.push_back(i);
    if (name.find(wanted) != std::string::npos ||
        lowered(found.devices[i].info.platform).find(wanted) != std::string::npos)
      like.push_back(i);
  }
  return same.empty() ? like : same;
}

}  // namespace

std::vector<std::string> brokenDrivers() {
  const char* chosen = std::getenv("OCL_ICD_VENDORS");
  const fs::path folder = chosen && *chosen ? chosen : kVendorFolder;
  std::vector<std::string> broken;
  std::error_code error;
  if (fs::is_regular_file(folder, error)) {  // one driver alone
    if (const auto fault = loadFault(folder))
      broken.push_back(shownText(fmt::format("{}: {}", folder.string(), *fault)));
    return broken;
  }
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() != ".icd") continue;
    if (const auto fault = loadFault(it->path()))
      broken.push_back(shownText(fmt::format("{}: {}", it->path().string(), *fault)));
  }
  std::ranges::sort(broken);
  if (error && error != std::errc::no_such_file_or_directory)
    broken.push_back(fmt::format("{}: {}", folder.string(), error.message()));
  return broken;
}

FoundPlatforms findPlatforms() {
  const DriverVisit visit("looking for OpenCL devices", kLaunchPatience);
  const DriverDeath death;
  FoundPlatforms found;
  for (const cl::Platform& platform : allPlatforms(found.list.problem)) {
    PlatformInfo info;
    info.name = platformText(platform, CL_PLATFORM_NAME);
    info.version = platformText(platform, CL_PLATFORM_VERSION);
    info.vendor = platformText(platform, CL_PLATFORM_VENDOR);
    if (info.name.empty()) info.name = "(no name)";
    for (const cl::Device& device : devicesOf(platform, info.name, info.problem)) {
      const int index = static_cast<int>(found.devices.size());
      info.devices.push_back(describeDevice(info, device, index));
      found.devices.push_back({platform, device, info.devices.back()});
    }
    found.list.platforms.push_back(std::move(info));
  }
  return found;
}

std::size_t chooseDevice(const FoundPlatforms& found, const std::string& selector) {
  if (found.devices.empty())
    throw DeviceError(fmt::format("no OpenCL device found: {}", whyNone(found.list)));
  if (selector.empty()) return firstChoice(found);

  std::size_t index = 0;
  const char* end = selector.data() + selector.size();
  const auto parsed = std::from_chars(selector.data(), end, index);
  const bool is_index =
      parsed.ptr == end && parsed.ec == std::errc() && index < found.devices.size();
  if (is_index) return index;

  const std::vector<std::size_t> matches = matching(found, lowered(selector));
  if (matches.size() == 1) return matches.front();
  if (matches.size() > 1)
    throw DeviceError(fmt::format("'{}' is the name of several OpenCL devices, {}; choose by index",
                                  selector, known(found, matches)));
  throw DeviceError(fmt::format("no OpenCL device matches '{}'; there are {}", selector,
                                known(found, allIndices(found))));
}

}  // namespace glintmark
