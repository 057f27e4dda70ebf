// Table 1 of [ZK16] with the paper's figures, as text from records of table "zk16".
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/report/record/table_spec.h"

namespace glintmark {

/// Table "zk16": names, metrics, what the page shows.
const TableSpec& zk16Spec();

/// One row of [ZK16] Table 1: milliseconds at 1920x1080 on a GeForce GTX 980.
struct Zk16PaperRow {
  std::string_view scene;
  double steep_ms, grazing_ms;
};
inline constexpr std::array<Zk16PaperRow, 5> kZk16Table1 = {{{"screen_plane", 0.9, 2.9},
                                                             {"snow", 2.5, 4.0},
                                                             {"dress", 1.4, 4.4},
                                                             {"car", 2.5, 3.9},
                                                             {"sponza", 3.0, 5.9}}};
inline constexpr std::array<std::string_view, 2> kZk16Views = {"steep", "grazing"};

/// Static instructions of the paper's shader, and of its innermost loop. [ZK16] Sect. 5
inline constexpr int kZk16ShaderInstructions = 412;
inline constexpr int kZk16LoopInstructions = 204;

/// The paper's milliseconds, or nothing if the paper has no such scene or view.
std::optional<double> zk16PaperMs(std::string_view scene, std::string_view view);

/// Table 1: paper and ours side by side, with cost figures; cases in the order of the records.
/// Figures whose records are not valid carry a "!".
std::string zk16TableText(std::span<const Record> records);

/// Where the time of a frame goes, one line per case.
std::string zk16BreakdownText(std::span<const Record> records);

}  // namespace glintmark
