// Wavefront OBJ files.
#pragma once
#include <string>

#include "host/scene/import/mesh_source.h"

namespace glintmark {

/// Polygons of the text of an OBJ file; a part is a material. Faces of smoothing group 0 or off are
/// flat where they name no normals; a face is without uvs unless all its corners have one. `source`
/// names the file. Throws Error with its line. [Wavefront, "Advanced Visualizer", appendix B1]
MeshSource readObj(std::string text, const std::string& source);

}  // namespace glintmark
