// Cell counts of one view.
#pragma once
#include <string>

#include "host/core/image.h"
#include "host/frame/frame_renderer.h"

namespace glintmark {

struct CountedCells {
  Image cells;  // per pixel, -1 where no glint material covers
  CellCounts counts;
};

/// Renders the view with the counting build; `options.count_cells` is switched on. Throws Error if
/// the scene has no glint material, since there would be nothing to count.
CountedCells countCells(Device& device, const Scene& scene, const View& view,
                        ShadingOptions options, int thread_count);

/// What a method visits: "cells", "draws" or "particles".
std::string visitedUnit(GlintMethod method);

}  // namespace glintmark
