// The comparisons of [TAO21] Sect. 4 as text, from records of table "tao21".
#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>

#include "host/report/record/record.h"

namespace glintmark {

/// Both methods take this long for a frame of Fig. 6 at 1920x1080 on a GeForce GTX 1070. [TAO21]
/// Sect. 4.2
inline constexpr double kTao21FrameMs = 16;
/// Peak of that GPU, 1920 lanes x 2 x 1.683 GHz boost [GFLOP/s].
inline constexpr double kGtx1070PeakGflops = 6460;

/// In the order of enum LtcMethod.
inline constexpr std::array<std::string_view, 3> kTao21Methods = {"original", "tao21", "exact"};

/// Time and error of every method in every view, cases in the order of the records; figures whose
/// records are not valid carry a "!".
std::string tao21TableText(std::span<const Record> records);

/// The figures of case "all", with the paper's, and the cost of more lights and vertices.
std::string tao21SummaryText(std::span<const Record> records);

}  // namespace glintmark
