#include "host/experiment/count_cells.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/error.h"

namespace glintmark {

CountedCells countCells(Device& device, const Scene& scene, const View& view,
                        ShadingOptions options, int thread_count) {
  if (std::ranges::none_of(scene.materials, &Material::has_glints)) {
    throw Error(fmt::format("scene '{}' has no glint material, so there are no cells to count",
                            scene.name));
  }
  options.count_cells = true;
  FrameRenderer renderer(device, scene, view, options, thread_count);
  renderer.prepare();
  renderer.shade();
  return {renderer.readCells(), renderer.cellCounts()};
}

std::string visitedUnit(GlintMethod method) {
  switch (method) {
    case GlintMethod::kDeliotBelcour:
    case GlintMethod::kDeliotCorrected:
      return "draws";
    case GlintMethod::kKemppinen:
      return "particles";
    default:
      return "cells";
  }
}

}  // namespace glintmark
