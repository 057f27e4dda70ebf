#include "host/scene/import/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <optional>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/json_depth.h"
#include "host/scene/import/text_scanner.h"

namespace glintmark {
namespace {

constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
// What a file may require although this program knows nothing of it: how surfaces look, not where
// they are.
constexpr std::string_view kNotGeometry[] = {
    "_materials_",          "_texture_", "_lights_",
    "_technique",           "_xmp",      "AMD_split_roughnessMetallic",
    "KHR_animation_pointer"};
constexpr std::string_view kDecoded[] = {"KHR_mesh_quantization", "KHR_texture_transform",
                                         "KHR_binary_glTF"};

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

int base64Value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

/// Nothing if `text` is not base64.
std::optional<std::string> base64Decoded(std::string_view text) {
  std::string out;
  out.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=' || std::isspace(static_cast<unsigned char>(c))) continue;
    const int value = base64Value(c);
    if (value < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    if (++count % 4 != 1)
      out += static_cast<char>(bits >> (count % 4 == 2 ? 4 : count % 4 == 3 ? 2 : 0));
  }
  return out;
}

int hexValue(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string keyOf(const nlohmann::json& reference) {
  return reference.is_string() ? reference.get<std::string>() : reference.dump();
}

}  // namespace

std::string shown(std::string text) {
  constexpr std::size_t kMost_bytes = 80;
  if (text.size() > kMost_bytes) text = text.substr(0, kMost_bytes) + "...";
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, '?');
  return text;
}

std::string percentDecoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool coded = text[i] == '%' && i + 2 < text.size() && hexValue(text[i + 1]) >= 0 &&
                       hexValue(text[i + 2]) >= 0;
    out += coded ? static_cast<char>(hexValue(text[i + 1]) * 16 + hexValue(text[i + 2])) : text[i];
    if (coded) i += 2;
  }
  return out;
}

GltfDocument::GltfDocument(const std::filesystem::path& file)
    : source_(file.string()), folder_(file.parent_path()) {
  std::string bytes = readFile(file);
  if (bytes.starts_with("glTF")) {
    readGlb(std::move(bytes));
  } else {
    parse(toUtf8(std::move(bytes)));
  }
  if (!root_.is_object()) fail("cannot be read as a mesh: its JSON is no object");
  const auto asset = root_.find("asset");
  if (asset != root_.end() && asset->is_object() && asset->contains("version"))
    version_ = keyOf((*asset)["version"]).starts_with('1') ? 1 : 2;  // some write a number
  const auto meshes = root_.find("meshes");
  if (meshes != root_.end() && meshes->is_object()) version_ = 1;
  checkRequiredExtensions();
}

void GltfDocument::fail(const std::string& reason) const {
  throw Error(fmt::format("{}: {}", source_, reason));
}

void GltfDocument::readGlb(std::string bytes) {
  const std::string broken = "cannot be read as a mesh: ";
  if (bytes.size() < 20) fail(broken + "it ends within the header of its container");
  const std::uint32_t version = wordAt(bytes, 4);
  const std::string_view all(bytes);
  const auto chunk = [&](std::size_t at, std::uint64_t length) {
    if (length > all.size() - at)
      fail(fmt::format("{}it ends within a chunk of {} bytes", broken, length));
    return all.substr(at, length);
  };
  if (version == 1) {
    const std::uint32_t length = wordAt(bytes, 12);
    parse(chunk(20, length));
    const std::size_t body = std::min((std::size_t{20} + length + 3) / 4 * 4, bytes.size());
    binary_ = bytes.substr(body);
    has_binary_ = true;
    return;
  }
  if (version != 2)
    fail(fmt::format("{}its container has version {}, expected 1 or 2", broken, version));
  bool has_json = false;
  std::size_t binary_begin = 0, binary_bytes = 0;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::uint32_t length = wordAt(bytes, at), type = wordAt(bytes, at + 4);
    const std::string_view content = chunk(at + 8, length);
    if (type == kJsonChunk && !has_json) {
      parse(content);
      has_json = true;
    } else if (type == kBinaryChunk && !has_binary_) {
      binary_begin = at + 8;
      binary_bytes = length;
      has_binary_ = true;
    }
    at += 8 + length;
  }
  if (!has_json) fail(broken + "its container holds no JSON");
  bytes.resize(binary_begin + binary_bytes);
  bytes.erase(0, binary_begin);
  binary_ = std::move(bytes);
}

void GltfDocument::parse(std::string_view text) {
  checkJsonDepth(text, source_);
  try {
    root_ = Json::parse(text);
  } catch (const Json::exception& error) {
    std::string reason = error.what();
    std::ranges::replace(reason, '\n', ' ');
    fail("cannot be read as a mesh: " + reason);
  }
}

void GltfDocument::checkRequiredExtensions() const {
  const auto required = root_.find("extensionsRequired");
  if (required == root_.end() || !required->is_array()) return;
  for (const Json& item : *required) {
    if (!item.is_string()) continue;
    const auto name = item.get<std::string>();
    const bool decoded = std::ranges::find(kDecoded, name) != std::end(kDecoded);
    const bool harmless = std::ranges::any_of(
        kNotGeometry, [&](std::string_view part) { return name.find(part) != std::string::npos; });
    if (!decoded && !harmless) failToDecode(name);
  }
}

void GltfDocument::failToDecode(const std::string& name) const {
  fail(fmt::format("requires the extension {}, which is not supported; save it without", name));
}

const GltfDocument::Json& GltfDocument::object(const char* collection,
                                               const Json& reference) const {
  const auto all = root_.find(collection);
  const Json* found = nullptr;
  if (all != root_.end() && all->is_array() && reference.is_number_integer()) {
    const auto index = reference.get<std::int64_t>();
    if (index >= 0 && static_cast<std::size_t>(index) < all->size()) found = &(*all)[index];
  } else if (all != root_.end() && all->is_object() && reference.is_string()) {
    const auto named = all->find(reference.get<std::string>());
    if (named != all->end()) found = &*named;
  }
  if (found == nullptr || !found->is_object())
    fail(fmt::format("cannot be read as a mesh: there is no {} in its {}", shown(keyOf(reference)),
                     collection));
  return *found;
}

std::string_view GltfDocument::buffer(const Json& reference) {
  const std::string key = keyOf(reference);
  const Json& description = object("buffers", reference);
  const std::string uri = text(description, "uri");
  const bool in_container = has_binary_ && (version_ == 1 ? uri.empty() || key == "binary_glTF"
                                                          : uri.empty() && key == "0");
  if (!in_container && !buffers_.contains(key)) {
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
      if (uri.empty() && extension(description, name) != nullptr) failToDecode(name);
    if (uri.empty()) fail(fmt::format("buffer {} has neither a uri nor bytes in the file", key));
    buffers_[key] = uriBytes(uri);
  }
  const std::string_view bytes = in_container ? binary_ : buffers_[key];
  // Its byteLength may say more than is there: what matters is that views fit.
  return bytes;
}

std::string_view GltfDocument::view(const Json& reference) {
  const Json& description = object("bufferViews", reference);
  const auto owner = description.find("buffer");
  if (owner == description.end())
    fail(fmt::format("buffer view {} names no buffer", keyOf(reference)));
  const std::string_view bytes = buffer(*owner);
  const std::uint64_t begin = whole(description, "byteOffset", 0);
  const std::uint64_t length = whole(description, "byteLength", 0);
  if (begin > bytes.size() || length > bytes.size() - begin)
    fail(fmt::format("buffer view {} of {} bytes from {} does not fit its buffer of {} bytes",
                     keyOf(reference), length, begin, bytes.size()));
  return bytes.substr(begin, length);
}

std::filesystem::path GltfDocument::uriFile(const std::string& uri) const {
  if (uri.starts_with("data:")) return {};
  std::string path = uri.starts_with("file://") ? uri.substr(7) : uri;
  const std::size_t colon = path.find(':');
  if (colon != std::string::npos && colon > 1 && path.compare(colon, 3, "://") == 0)
    fail(fmt::format("names {}, expected files beside it", shown(uri)));
  const std::filesystem::path decoded = folder_ / percentDecoded(path);
  std::error_code error;
  // Some programs write blanks and signs as they are.
  const bool plain =
      !std::filesystem::exists(decoded, error) && std::filesystem::exists(folder_ / path, error);
  return plain ? folder_ / path : decoded;
}

std::string GltfDocument::uriBytes(const std::string& uri) const {
  if (!uri.starts_with("data:")) {
    const std::filesystem::path file = uriFile(uri);
    std::error_code error;
    if (!std::filesystem::exists(file, error))
      fail(fmt::format("names the file {}, which is not there", shown(percentDecoded(uri))));
    return readFile(file);
  }
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos) fail("has a data URI without data");
  const std::string_view head = std::string_view(uri).substr(0, comma);
  const std::string_view body = std::string_view(uri).substr(comma + 1);
  if (!head.ends_with(";base64")) return percentDecoded(body);
  std::optional<std::string> bytes = body.find('%') == std::string_view::npos
                                         ? base64Decoded(body)
                                         : base64Decoded(percentDecoded(body));
  if (!bytes) fail("has a data URI that is not base64");
  return std::move(*bytes);
}

std::uint64_t GltfDocument::whole(const Json& object, const char* key,
                                  std::uint64_t fallback) const {
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  if (found->is_number_unsigned()) return found->get<std::uint64_t>();
  const double value = found->is_number_float() ? found->get<double>() : -1;
  if (!(value >= 0 && value < 9e15) ||
      value != static_cast<double>(static_cast<std::uint64_t>(value)))
    fail(fmt::format("{} is {}, expected a whole number of at least 0", key, shown(found->dump())));
  return static_cast<std::uint64_t>(value);
}

double GltfDocument::number(const Json& object, const char* key, double fallback) const {
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  if (!found->is_number())
    fail(fmt::format("{} is {}, expected a number", key, shown(found->dump())));
  return found->get<double>();
}

void GltfDocument::numbers(const Json& object, const char* key, std::size_t count,
                           double* values) const {
  const auto found = object.find(key);
  if (found == object.end()) return;
  const bool right = found->is_array() && found->size() == count &&
                     std::ranges::all_of(*found, [](const Json& v) { return v.is_number(); });
  if (!right) fail(fmt::format("{} is not {} numbers", key, count));
  for (std::size_t i = 0; i < count; ++i) values[i] = (*found)[i].get<double>();
}

std::string GltfDocument::text(const Json& object, const char* key) const {
  const auto found = object.find(key);
  if (found == object.end()) return "";
  if (!found->is_string())
    fail(fmt::format("{} is {}, expected a text", key, shown(found->dump())));
  return found->get<std::string>();
}

const GltfDocument::Json* GltfDocument::extension(const Json& object, const char* name) {
  const auto all = object.find("extensions");
  if (all == object.end() || !all->is_object()) return nullptr;
  const auto found = all->find(name);
  return found != all->end() && found->is_object() ? &*found : nullptr;
}

}  // namespace glintmark
