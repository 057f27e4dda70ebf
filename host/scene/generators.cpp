#include "host/scene/generators.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

namespace glintmark {
namespace {

struct Generator {
  const char* name;
  MeshMaker (*read)(SceneTable& mesh);
};
constexpr std::array<Generator, 8> kGenerators = {{{"arcade", readArcade},
                                                   {"car", readCar},
                                                   {"disc", readDisc},
                                                   {"gown", readGown},
                                                   {"knot", readKnot},
                                                   {"plane", readPlane},
                                                   {"sheet", readSheet},
                                                   {"terrain", readTerrain}}};

}  // namespace

MeshMaker readGenerator(const std::string& name, SceneTable& mesh) {
  std::vector<std::string> known;
  for (const Generator& generator : kGenerators) {
    if (name == generator.name) return generator.read(mesh);
    known.emplace_back(generator.name);
  }
  mesh.fail("generator", fmt::format("is '{}', known are {}", name, fmt::join(known, ", ")));
}

}  // namespace glintmark
