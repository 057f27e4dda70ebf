// Materials of glTF files.
#pragma once
#include <glm/glm.hpp>

#include "host/scene/import/gltf_document.h"
#include "host/scene/part_mesh.h"

namespace glintmark {

/// Which of a primitive's uvs a material's textures lie on, and how: those of its normal map, else
/// of its base colour, else of its roughness. [KHR_texture_transform]
struct GltfUv {
  int set = 0;
  glm::dmat2 matrix{1};
  glm::dvec2 offset{0};
};

GltfUv gltfUv(const GltfDocument& document, const GltfDocument::Json& material);

/// What our materials know of it; textures other than the normal map are named as not used.
FileMaterial gltfMaterial(GltfDocument& document, const GltfDocument::Json& material);

}  // namespace glintmark
