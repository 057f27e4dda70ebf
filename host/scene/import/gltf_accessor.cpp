#include "host/scene/import/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

#include "host/core/error.h"
#include "host/core/free_memory.h"

namespace glintmark {
namespace {

enum ComponentType : int {
  kByte = 5120,
  kUByte,
  kShort,
  kUShort,
  kInt,
  kUInt,
  kFloat,
  kDouble = 5130
};

std::size_t bytesOf(int type) {
  switch (type) {
    case kByte:
    case kUByte:
      return 1;
    case kShort:
    case kUShort:
      return 2;
    case kInt:
    case kUInt:
    case kFloat:
      return 4;
    case kDouble:
      return 8;
    default:
      return 0;
  }
}

template <typename T>
T valueAt(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

int componentsOf(const std::string& type) {
  constexpr std::pair<const char*, int> kNames[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  for (const auto& [name, count] : kNames)
    if (type == name) return count;
  return 0;
}

/// Throws unless `count` elements of `element` bytes every `stride` bytes from `begin` on fit.
void checkFit(std::string_view bytes, std::uint64_t begin, std::uint64_t count,
              std::uint64_t stride, std::uint64_t element, const std::string& what) {
  const std::uint64_t size = bytes.size();
  const bool fits = count == 0 || (begin <= size && element <= size - begin &&
                                   (count - 1) <= (size - begin - element) / stride);
  if (!fits)
    throw Error(fmt::format("{}: {} elements of {} bytes do not fit the buffer view of {} bytes",
                            what, count, element, size));
}

}  // namespace

GltfAccessor::GltfAccessor(GltfDocument& document, const GltfDocument::Json& reference)
    : source_(document.source()) {
  const GltfDocument::Json& accessor = document.object("accessors", reference);
  name_ = fmt::format("{}: accessor {}", source_, reference.dump());
  type_ = static_cast<int>(document.whole(accessor, "componentType", 0));
  components_ = componentsOf(document.text(accessor, "type"));
  if (bytesOf(type_) == 0 || components_ == 0)
    throw Error(fmt::format("{} has component type {} and type '{}', which glTF does not know",
                            name_, type_, document.text(accessor, "type")));
  count_ = document.whole(accessor, "count", 0);
  const auto normalised = accessor.find("normalized");
  normalised_ = normalised != accessor.end() && normalised->is_boolean() && normalised->get<bool>();
  stride_ = document.whole(accessor, "byteStride", 0);  // of glTF 1
  const std::uint64_t begin = document.whole(accessor, "byteOffset", 0);
  const auto view = accessor.find("bufferView");
  if (view != accessor.end()) {
    const GltfDocument::Json& description = document.object("bufferViews", *view);
    bytes_ = document.view(*view);
    stride_ = document.whole(description, "byteStride", stride_);
  }
  is_stored_ = view != accessor.end() || accessor.contains("sparse");
  if (stride_ == 0) stride_ = elementBytes();
  if (view != accessor.end()) {
    checkFit(bytes_, begin, count_, stride_, elementBytes(), name_);
    if (count_ > 0) bytes_.remove_prefix(begin);
  } else {
    if (count_ > 0xFFFFFFFFu)
      throw Error(fmt::format("{} counts {} elements, too many", name_, count_));
    requireMemory(count_ * elementBytes(), name_);
    stride_ = elementBytes();
    own_.resize(count_ * stride_);
    bytes_ = own_;
  }
  if (const auto sparse = accessor.find("sparse"); sparse != accessor.end() && sparse->is_object())
    placeSparse(document, *sparse);
}

std::size_t GltfAccessor::elementBytes() const {
  return bytesOf(type_) * static_cast<std::size_t>(components_);
}

void GltfAccessor::placeSparse(GltfDocument& document, const GltfDocument::Json& sparse) {
  const std::size_t element = elementBytes();
  if (own_.empty() && count_ > 0) {
    own_.resize(count_ * element);
    for (std::size_t i = 0; i < count_; ++i)
      std::memcpy(own_.data() + i * element, bytes_.data() + i * stride_, element);
    stride_ = element;
  }
  bytes_ = own_;
  const auto indices = sparse.find("indices"), values = sparse.find("values");
  if (indices == sparse.end() || values == sparse.end() || !indices->contains("bufferView") ||
      !values->contains("bufferView"))
    throw Error(name_ + " is sparse without indices and values");
  const std::uint64_t count = document.whole(sparse, "count", 0);
  const int type = static_cast<int>(document.whole(*indices, "componentType", 0));
  const std::size_t width = bytesOf(type);
  if (type != kUByte && type != kUShort && type != kUInt)
    throw Error(fmt::format("{} has sparse indices of component type {}", name_, type));
  const std::string_view where = document.view((*indices)["bufferView"]);
  const std::string_view what = document.view((*values)["bufferView"]);
  const std::uint64_t where_begin = document.whole(*indices, "byteOffset", 0);
  const std::uint64_t what_begin = document.whole(*values, "byteOffset", 0);
  checkFit(where, where_begin, count, width, width, name_ + " (sparse)");
  checkFit(what, what_begin, count, element, element, name_ + " (sparse)");
  for (std::uint64_t i = 0; i < count; ++i) {
    const char* const at = where.data() + where_begin + i * width;
    const std::uint64_t target = type == kUByte    ? valueAt<std::uint8_t>(at)
                                 : type == kUShort ? valueAt<std::uint16_t>(at)
                                                   : valueAt<std::uint32_t>(at);
    if (target >= count_)
      throw Error(fmt::format("{} has a sparse value for element {} of {}", name_, target, count_));
    std::memcpy(own_.data() + target * element, what.data() + what_begin + i * element, element);
  }
}

double GltfAccessor::at(std::size_t i, int c) const {
  const char* const bytes =
      bytes_.data() + i * stride_ + bytesOf(type_) * static_cast<std::size_t>(c);
  const auto scaled = [&](double value, double most) {
    return normalised_ ? std::max(value / most, -1.0) : value;
  };
  switch (type_) {
    case kByte:
      return scaled(valueAt<std::int8_t>(bytes), 127);
    case kUByte:
      return scaled(valueAt<std::uint8_t>(bytes), 255);
    case kShort:
      return scaled(valueAt<std::int16_t>(bytes), 32767);
    case kUShort:
      return scaled(valueAt<std::uint16_t>(bytes), 65535);
    case kInt:
      return scaled(valueAt<std::int32_t>(bytes), 2147483647.0);
    case kUInt:
      return scaled(valueAt<std::uint32_t>(bytes), 4294967295.0);
    case kFloat:
      return static_cast<double>(valueAt<float>(bytes));
    default:
      return valueAt<double>(bytes);
  }
}

std::uint32_t GltfAccessor::index(std::size_t i) const {
  const char* const bytes = bytes_.data() + i * stride_;
  if (type_ == kUByte) return valueAt<std::uint8_t>(bytes);
  if (type_ == kUShort) return valueAt<std::uint16_t>(bytes);
  if (type_ == kUInt) return valueAt<std::uint32_t>(bytes);
  throw Error(fmt::format(
      "{} holds indices of component type {}, expected whole numbers without sign", name_, type_));
}

}  // namespace glintmark
