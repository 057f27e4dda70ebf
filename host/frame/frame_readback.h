// What the kernels wrote, as images in the order of the screen.
#pragma once
#include <cstdint>

#include "host/core/image.h"
#include "host/frame/frame_pass.h"

namespace glintmark {

/// Cells visited, over the pixels of glint materials that some light reaches.
struct CellCounts {
  std::uint32_t min = 0, max = 0;
  double mean = 0;
  double paid_mean = 0;        // cells that lanes worked through side by side, idle ones included
  std::size_t glint_px = 0;    // pixels that ran the glint loop
  std::size_t guard_hits = 0;  // pixels whose walk a limit cut short
};

/// The three result planes as RGBA: alpha 1 where covered, background 0. Adds the time of the
/// transfer [ns].
Image readPlanes(const FramePass& pass, double& readback_ns);

/// Cells per pixel as one channel, -1 where no glint material covers. Throws Error if they were not
/// counted; so does countCells.
Image readCellImage(const FramePass& pass);
CellCounts countCells(const FramePass& pass);

}  // namespace glintmark
