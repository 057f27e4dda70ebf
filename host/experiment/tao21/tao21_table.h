// The comparisons of [TAO21] Sect. 4 as text, from records of table "tao21".
#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>

#include "host/report/record/table_spec.h"

namespace glintmark {

/// Table "tao21": names, metrics, what the page shows.
const TableSpec& tao21Spec();

/// The scene of the figures that are about no single view.
inline constexpr const char* kTao21SummaryScene = "area_plane";

/// Both methods take this long for a frame of Fig. 6 at 1920x1080 on a GeForce GTX 1070. [TAO21]
/// Sect. 4.2
inline constexpr double kTao21FrameMs = 16;

/// In the order of enum LtcMethod.
inline constexpr std::array<std::string_view, 5> kTao21Methods = {"original", "tao21", "exact",
                                                                  "mixture", "covariance"};

/// Time and error of every method in every view, cases in the order of the records; figures whose
/// records are not valid carry a "!".
std::string tao21TableText(std::span<const Record> records);

/// The figures of case "all", with the paper's, and the cost of more lights and vertices.
std::string tao21SummaryText(std::span<const Record> records);

}  // namespace glintmark
