// Procedural meshes. Each reader takes its parameters from [mesh] at once and builds later, so that
// a mistake in the file shows before any work is done. uvs are in scene units, about isometric.
#pragma once
#include <functional>
#include <string>

#include "host/scene/part_mesh.h"
#include "host/scene/scene_table.h"

namespace glintmark {

using MeshMaker = std::function<PartMesh()>;

/// Reads the parameters of generator `name` from `mesh`. Throws Error for an unknown name.
MeshMaker readGenerator(const std::string& name, SceneTable& mesh);

MeshMaker readPlane(SceneTable& mesh);    // part "plane"
MeshMaker readTerrain(SceneTable& mesh);  // part "ground"
MeshMaker readSheet(SceneTable& mesh);    // part "sheet"
MeshMaker readDisc(SceneTable& mesh);     // parts "disc" and "rim"
MeshMaker readKnot(SceneTable& mesh);     // part "knot"
MeshMaker readGown(SceneTable& mesh);     // parts "skirt", "bodice"
MeshMaker readCar(SceneTable& mesh);      // parts: see generate_car.cpp
MeshMaker readArcade(SceneTable& mesh);   // parts: see generate_arcade.cpp

}  // namespace glintmark
