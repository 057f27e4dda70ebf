// The comparisons of [TAN05] with the paper's figures, as text from records of table "tan05".
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/report/record/table_spec.h"

namespace glintmark {

/// Table "tan05": names, metrics, what the page shows.
const TableSpec& tan05Spec();

/// The paper's colour error of a case "scene/view/method", or nothing. [TAN05] Figs. 4, 7 and 8
std::optional<double> tan05PaperError(std::string_view case_name);
/// The paper's frames per second at 500x500 on a GeForce 6800 GT, or nothing. [TAN05] Sect. 5
std::optional<double> tan05PaperFps(std::string_view case_name);

/// Factors on a view's distance at which errors are taken, of the disk texels a pixel: none a power
/// of two or whole, so that pixels and texels of no level are in step.
inline constexpr double kTan05Distances[] = {1.3, 2.7, 5.3, 9.1, 13.7, 23.3, 45.7};
/// How cases name the view at a distance: "near_9.1".
std::string tan05DistanceView(double factor);
/// Its inverse; nothing of another view.
std::optional<double> tan05DistanceOf(std::string_view view);
inline constexpr std::string_view kTan05DistanceBase = "near";

/// The paper's time for the mixtures of a 512x512 map, four lobes: five minutes [ms].
inline constexpr double kTan05FitMs = 300000;

/// Views, one line per method, paper's figures beside ours.
std::string tan05TableText(std::span<const Record> records);
/// Errors over distance, one column per method.
std::string tan05DistanceText(std::span<const Record> records);
/// What holds over all views, and time over the knobs.
std::string tan05SummaryText(std::span<const Record> records);

}  // namespace glintmark
