// Files that are built into the program for the report's page.
#pragma once
#include <string_view>

namespace glintmark {

std::string_view pageCss();
std::string_view pageJs();
/// Chart.js, minified, as the distribution's package libjs-chart.js has it.
std::string_view chartJs();

}  // namespace glintmark
