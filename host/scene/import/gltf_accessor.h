// The numbers of a glTF accessor.
#pragma once
#include <string>
#include <string_view>

#include "host/scene/import/gltf_document.h"

namespace glintmark {

class GltfAccessor {
 public:
  /// Every component type, normalised or not, with strides and sparse values. Throws Error, naming
  /// the accessor, for a type that is none and for elements beyond their buffer view. The document
  /// must live as long.
  GltfAccessor(GltfDocument& document, const GltfDocument::Json& reference);

  GltfAccessor(const GltfAccessor&) = delete;
  GltfAccessor& operator=(const GltfAccessor&) = delete;

  std::size_t count() const { return count_; }
  int components() const { return components_; }
  /// False where the file holds none of its elements, which are zeros then.
  bool isStored() const { return is_stored_; }
  /// Component `c` of element `i` as the format defines it: signed normalised numbers in [-1, 1].
  double at(std::size_t i, int c) const;
  /// Element `i` of whole numbers of at least 0. Throws Error for other component types.
  std::uint32_t index(std::size_t i) const;

 private:
  void placeSparse(GltfDocument& document, const GltfDocument::Json& sparse);
  std::size_t elementBytes() const;

  std::string name_;
  std::string source_;
  std::string_view bytes_;
  std::string own_;  // where values were placed among those of the view, or there is none
  std::size_t count_ = 0, stride_ = 0;
  int components_ = 1, type_ = 0;
  bool normalised_ = false, is_stored_ = false;
};

}  // namespace glintmark
