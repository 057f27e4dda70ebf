// Cells and cost over the angle between the view and a plane.
#pragma once
#include <string>

#include "host/experiment/session.h"
#include "host/frame/frame_renderer.h"
#include "host/report/picture/heatmap.h"

namespace glintmark {

struct AngleSweep {
  std::string scene, view;  // the view must be an orbit
  ShadingOptions shading;
  HeatmapScale scale = HeatmapScale::kFixed;
  std::string picture, csv;  // files, empty for none
};

/// Renders the view at angles from 90 to 1 degrees, prints a table, writes a strip of heatmaps and
/// a CSV. After Ctrl-C writes what is done and throws Interrupted.
int runAngleSweep(const CommonOptions& common, const AngleSweep& sweep);

}  // namespace glintmark
