// What devices say of themselves, spoilt as fault_list.h has it.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "tests/faulty_driver/fault_list.h"
#include "tests/faulty_driver/next_call.h"

namespace faulty {
namespace {

struct NamedFact {
  cl_device_info fact;
  const char* name;
};

constexpr NamedFact kFacts[] = {
    {CL_DEVICE_HOST_UNIFIED_MEMORY, "unified"},
    {CL_DEVICE_MAX_CLOCK_FREQUENCY, "clock"},
    {CL_DEVICE_PREFERRED_VECTOR_WIDTH_FLOAT, "vector"},
    {CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT, "vector"},
    {CL_DEVICE_GLOBAL_MEM_CACHE_SIZE, "cache"},
    {CL_DEVICE_PROFILING_TIMER_RESOLUTION, "timer"},
    {CL_DEVICE_LOCAL_MEM_SIZE, "local"},
    {CL_DEVICE_MAX_COMPUTE_UNITS, "units"},
    {CL_DEVICE_MAX_WORK_GROUP_SIZE, "groups"},
    {CL_DEVICE_MAX_WORK_ITEM_SIZES, "items"},
    {CL_DEVICE_GLOBAL_MEM_SIZE, "memory"},
    {CL_DEVICE_MAX_MEM_ALLOC_SIZE, "buffer"},
    {CL_DEVICE_ADDRESS_BITS, "bits"},
    {CL_DEVICE_ENDIAN_LITTLE, "little"},
    {CL_DEVICE_AVAILABLE, "available"},
    {CL_DEVICE_COMPILER_AVAILABLE, "compiler"},
    {CL_DEVICE_SINGLE_FP_CONFIG, "float"},
    {CL_DEVICE_TYPE, "type"},
};

std::string factName(cl_device_info fact) {
  for (const NamedFact& named : kFacts)
    if (named.fact == fact) return named.name;
  return "";
}

// "fact=NAME:VALUE": in as many bytes as are asked for, each word of them.
bool giveFact(const std::string& name, std::size_t bytes, void* out) {
  const auto value = valueOfPart("fact", name);
  if (!value || !out) return false;
  const std::uint64_t number = std::strtoull(value->c_str(), nullptr, 0);
  const std::size_t word = std::min<std::size_t>(bytes, sizeof number);
  for (std::size_t at = 0; word > 0 && at + word <= bytes; at += word)
    std::memcpy(static_cast<char*>(out) + at, &number, word);
  return true;
}

std::string oddName(const std::string& kind) {
  if (kind == "blank") return std::string(" \t \0", 4);
  if (kind == "open") return "no end";  // without a NUL
  if (kind == "cut") return std::string("first\0second\0", 13);
  if (kind == "long") return std::string(100000, 'x') + '\0';
  if (kind == "latin") return std::string("caf\xe9 \xff\xfe\0", 8);
  if (kind == "lines") return std::string("one\ntwo\r\x1b[31mred\x1b[0m\0", 21);
  return std::string("<a href=\"x\">&'\\ {} %s\0", 22);
}

cl_int giveText(const std::string& text, std::size_t bytes, void* out, std::size_t* needed) {
  if (needed) *needed = text.size();
  if (!out) return CL_SUCCESS;
  if (bytes < text.size()) return CL_INVALID_VALUE;
  std::memcpy(out, text.data(), text.size());
  return CL_SUCCESS;
}

// A driver that takes another size than the type's, gives half of it, or does not say how much it
// needs.
cl_int spoiltSize(cl_device_id device, cl_device_info fact, std::size_t bytes, void* out,
                  std::size_t* needed) {
  const auto call = REAL(clGetDeviceInfo);
  if (asked("facts", "wide") && out && bytes <= 8) return CL_INVALID_VALUE;
  const cl_int status = call(device, fact, bytes, out, needed);
  if (asked("facts", "sizeless") && needed && status == CL_SUCCESS) *needed = 0;
  if (asked("facts", "narrow") && out && bytes == 8 && status == CL_SUCCESS)
    std::memset(static_cast<char*>(out) + 4, 0xAB, 4);
  return status;
}

}  // namespace
}  // namespace faulty

using namespace faulty;

extern "C" cl_int clGetDeviceInfo(cl_device_id device, cl_device_info fact, size_t bytes, void* out,
                                  size_t* needed) {
  const std::string name = factName(fact);
  if (asked("refuse", name)) return CL_INVALID_VALUE;
  if (const auto kind = valueOf("name"); kind && fact == CL_DEVICE_NAME)
    return giveText(oddName(*kind), bytes, out, needed);
  if (const auto text = valueOf("c_version"); text && fact == CL_DEVICE_OPENCL_C_VERSION)
    return giveText(*text + '\0', bytes, out, needed);
  if (giveFact(name, bytes, out)) return CL_SUCCESS;
  const bool is_size = fact == CL_DEVICE_GLOBAL_MEM_SIZE || fact == CL_DEVICE_MAX_MEM_ALLOC_SIZE;
  if (is_size && asked("zero", "memory")) return give(cl_ulong{0}, bytes, out, needed);
  if (const cl_ulong memory = numberOf("memory"); is_size && memory > 0)
    return give(fact == CL_DEVICE_GLOBAL_MEM_SIZE ? memory : memory / 4, bytes, out, needed);
  if (fact == CL_DEVICE_MAX_COMPUTE_UNITS && asked("zero", "units"))
    return give(cl_uint{0}, bytes, out, needed);
  if (fact == CL_DEVICE_MAX_CLOCK_FREQUENCY && asked("zero", "clock"))
    return give(cl_uint{0}, bytes, out, needed);
  if (name == "vector" && asked("zero", "vector")) return give(cl_uint{0}, bytes, out, needed);
  if (fact == CL_DEVICE_MAX_WORK_GROUP_SIZE) {
    if (asked("zero", "groups")) return give(size_t{0}, bytes, out, needed);
    if (const size_t most = numberOf("groups")) return give(most, bytes, out, needed);
  }
  return spoiltSize(device, fact, bytes, out, needed);
}
