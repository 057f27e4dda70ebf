// glintmark fit meso: constants of kernels/area/meso_table.h, and how good they are.
#include <fmt/format.h>

#include <memory>

#include "host/cli/fit_commands.h"
#include "host/core/error.h"
#include "host/fit/meso_fit.h"
#include "host/parallel/ranks.h"
#include "host/reference/scaled_cosine.h"
#include "host/report/record/terminal_text.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

void printConstants(const MesoConstants& constants) {
  for (std::size_t i = 0; i < constants.inverse.size(); ++i) {
    fmt::print("#define MESO_INVERSE_{} {:.9g}f\n", i, constants.inverse[i]);
  }
  for (std::size_t i = 0; i < constants.join.size(); ++i) {
    fmt::print("#define MESO_JOIN_{} {:.9g}f\n", "ABCD"[i], constants.join[i]);
  }
}

std::vector<std::string> errorRow(const std::string& name, const MesoErrors& errors) {
  return {name, fmt::format("{:.4f}", errors.sum_of_squares), fmt::format("{:.4f}", errors.max)};
}

int runFitMeso(int count) {
  const MesoGrid grid = computeMesoGrid(count, allRanks());
  if (!allRanks().isFirst()) return kExitDone;
  const MesoConstants constants = fitMeso(grid), shipped = shippedMesoConstants();
  printConstants(constants);
  const auto errors = [&](const MesoConstants& of) {
    return mesoErrors(grid, [&](double mi, double me) { return overallAlpha(of, mi, me); });
  };
  TextTable table({fmt::format("overall roughness, {} x {} grid", count, count), "SSE", "max"});
  table.addRow(errorRow("fitted", errors(constants)));
  table.addRow(errorRow("shipped", errors(shipped)));
  table.addRow(errorRow("[TAO21] Eq. 7, clamped", mesoErrors(grid, reference::tao21OverallAlpha)));
  printText("{}inverse of the mean length: relative error at most {:.1e}\n", table.toString(),
            mesoInverseError(constants));
  return kExitDone;
}

}  // namespace

void addFitMesoCommand(Command fit, CommandLine& line) {
  auto count = std::make_shared<int>(32);
  Command command = fit.subcommand(
      "meso", "Constants of the meso scale: mean length to roughness, roughness of both scales");
  command.option("--grid", *count, "Roughnesses along each axis, 1 to 33 (default: 32)");
  command.footer("Examples:\n  glintmark fit meso\n  glintmark fit meso --grid 8");
  command.callback([count, &line] {
    line.shares_work = true;
    line.action = [count] { return runFitMeso(*count); };
  });
}

}  // namespace glintmark
