// A glTF file: its JSON and its buffers.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace glintmark {

/// A text of a file as messages show it: 80 bytes at most, and none that steers a terminal.
std::string shown(std::string text);

/// glTF 1.0 or 2.0, as JSON or in a GLB container of version 1 or 2. Functions throw Error, naming
/// the file and what in it is wrong. [Khronos, "glTF 2.0 Specification"]
class GltfDocument {
 public:
  using Json = nlohmann::json;

  explicit GltfDocument(const std::filesystem::path& file);

  GltfDocument(const GltfDocument&) = delete;
  GltfDocument& operator=(const GltfDocument&) = delete;

  const Json& root() const { return root_; }
  /// 1: objects are named by text; 2: by their place in an array.
  int version() const { return version_; }
  const std::string& source() const { return source_; }
  [[noreturn]] void fail(const std::string& reason) const;
  /// Fails for data that only an extension could read.
  [[noreturn]] void failToDecode(const std::string& extension) const;

  /// The object of a collection ("accessors") that `reference` names.
  const Json& object(const char* collection, const Json& reference) const;
  /// The bytes of a buffer view.
  std::string_view view(const Json& reference);
  /// The bytes that a URI names: data in itself, or a file beside this one.
  std::string uriBytes(const std::string& uri) const;
  /// The file that a URI names; empty for data in itself.
  std::filesystem::path uriFile(const std::string& uri) const;

  /// A whole number of at least 0 below `key`, or the fallback where there is none.
  std::uint64_t whole(const Json& object, const char* key, std::uint64_t fallback) const;
  double number(const Json& object, const char* key, double fallback) const;
  /// `count` numbers below `key`; the vector is as before where there are none.
  void numbers(const Json& object, const char* key, std::size_t count, double* values) const;
  /// A text below `key`, empty where there is none.
  std::string text(const Json& object, const char* key) const;
  /// An extension of an object, null where it has none of that name.
  static const Json* extension(const Json& object, const char* name);

 private:
  void readGlb(std::string bytes);
  void parse(std::string_view text);
  void checkRequiredExtensions() const;
  std::string_view buffer(const Json& reference);

  std::string source_;
  std::filesystem::path folder_;
  Json root_;
  int version_ = 2;
  bool has_binary_ = false;
  std::string binary_;                          // of a GLB
  std::map<std::string, std::string> buffers_;  // those loaded so far, by reference
};

/// Text with %XX in place of bytes, as URIs write them, undone.
std::string percentDecoded(std::string_view text);

}  // namespace glintmark
