// glintmark fit ltc: tables of linearly transformed cosines, and how good they are.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <numeric>

#include "host/cli/fit_commands.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/core/progress.h"
#include "host/core/stopwatch.h"
#include "host/core/unknown_name.h"
#include "host/experiment/interrupt.h"
#include "host/fit/anisotropic_error.h"
#include "host/fit/anisotropic_fit.h"
#include "host/fit/ltc_error.h"
#include "host/fit/ltc_fit.h"
#include "host/parallel/ranks.h"
#include "host/report/picture/image_io.h"
#include "host/report/picture/matrix_picture.h"
#include "host/report/record/terminal_text.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

struct FitLtcCommand {
  std::string ndf = "ggx", output, picture, compare;
  int size = LTC_SIZE_DEFAULT;
  bool shipped = false, anisotropic = false;
};

struct MeasuredTable {
  std::string name;
  LtcErrors nodes, midpoints;
};

reference::Ndf parseNdf(const std::string& name) {
  std::vector<std::string> known;
  for (const reference::Ndf ndf :
       {reference::Ndf::kGgx, reference::Ndf::kBeckmann, reference::Ndf::kNormals}) {
    if (name == reference::ndfName(ndf)) return ndf;
    known.emplace_back(reference::ndfName(ndf));
  }
  throw Error(unknownName("distribution", name, known));
}

void checkFitLtc(const FitLtcCommand& command) {
  parseNdf(command.ndf);
  if (command.anisotropic) {
    if (parseNdf(command.ndf) == reference::Ndf::kNormals)
      throw Error(
          "normals alone have no anisotropic table; --ndf with --anisotropic is ggx or "
          "beckmann");
    if (!command.compare.empty() || command.size != LTC_SIZE_DEFAULT)
      throw Error(
          fmt::format("an anisotropic table has {} nodes on each of four axes; leave out "
                      "--size and --compare, or --anisotropic",
                      ANISO_NODES));
  }
  requirePng(command.picture);
  if (allRanks().isFirst())
    announceOutputs({{"-o", command.output}, {"--picture", command.picture}});
  if (command.size < LTC_SIZE_MIN || command.size > LTC_SIZE_MAX) {
    throw Error(fmt::format("--size {} is not possible; sizes are {} to {}", command.size,
                            LTC_SIZE_MIN, LTC_SIZE_MAX));
  }
}

// What `fit`, a function of progress, makes; `what` is it called.
template <typename Fit>
auto fitWithProgress(const std::string& what, const CommonOptions& common, const Fit& fit) {
  const InterruptGuard guard;
  Progress progress(common.quiet);
  const Stopwatch stopwatch;
  auto table = fit([&](double share) {
    if (InterruptGuard::interrupted()) throw Interrupted("interrupted; nothing was written");
    progress.show(static_cast<int>(share * 100), 100, "% of the fit");
  });
  progress.clear();
  printText("fitted {} in {:.1f} s\n", what, stopwatch.elapsedNs() * 1e-9);
  return table;
}

LtcTable fittedRound(const FitLtcCommand& command, const CommonOptions& common) {
  return fitWithProgress(fmt::format("{} {}x{}", command.ndf, command.size, command.size), common,
                         [&](const std::function<void(double)>& progress) {
                           return fitLtcTable({.ndf = parseNdf(command.ndf),
                                               .size = command.size,
                                               .threads = common.threads,
                                               .progress = progress,
                                               .ranks = &allRanks()});
                         });
}

MeasuredTable measure(const std::string& name, const LtcTable& table) {
  return {name, ltcNodeErrors(table), ltcMidpointErrors(table)};
}

std::vector<std::string> summaryRow(const std::string& name, const std::string& where,
                                    const LtcErrors& errors) {
  std::vector<double> sorted = errors.values;
  std::sort(sorted.begin(), sorted.end());
  const auto quantile = [&](double q) {
    return fmt::format("{:.4f}", sorted[static_cast<std::size_t>(q * (sorted.size() - 1))]);
  };
  return {name,          where,          fmt::format("{:.4f}", errors.mean()),
          quantile(0.5), quantile(0.95), quantile(1)};
}

void printSummary(const std::vector<MeasuredTable>& tables) {
  TextTable text({"integral of |LTC - BRDF cos|", "where", "mean", "median", "p95", "max"});
  for (const MeasuredTable& table : tables) {
    text.addRow(summaryRow(table.name, "nodes", table.nodes));
    text.addRow(summaryRow(table.name, "between", table.midpoints));
  }
  printText("{}", text.toString());
}

void printComparison(const LtcErrors& ours, const LtcErrors& theirs) {
  int worse = 0;
  double most = 0;
  for (std::size_t i = 0; i < ours.values.size(); ++i) {
    const double excess = ours.values[i] - theirs.values[i];
    // What the cubature cannot tell apart does not count.
    if (excess > 0.01 * theirs.values[i] + 1e-4) ++worse;
    most = std::max(most, excess);
  }
  printText("at {} of {} nodes the error is larger than the compared table's, by at most {:.4f}\n",
            worse, ours.values.size(), most);
}

void writeErrorPicture(const std::vector<MeasuredTable>& tables, const std::string& file) {
  std::vector<MatrixPanel> panels;
  panels.reserve(tables.size());
  for (const MeasuredTable& table : tables) panels.push_back({table.name, table.nodes.values});
  const LtcErrors& first = tables.front().nodes;
  writePng(
      matrixPicture(
          panels,
          {.width = first.width,
           .height = first.height,
           .entry_px = std::max(2, 384 / first.width),
           .low = 0,
           .high = 0.7,
           .title = "integral over the hemisphere of the absolute difference of LTC and BRDF cos",
           .x_label = "sqrt(alpha) 0 to 1",
           .y_label = "sqrt(1 - cos theta) 0 to 1"}),
      file);
}

// --- Anisotropic ---------------------------------------------------------------------------------

// Mean errors of places whose ratio lies within bounds.
std::vector<std::string> ratioRow(const char* where, double least, double most,
                                  const std::vector<AnisotropicErrorAt>& errors) {
  std::vector<double> stretched;
  double round = 0;
  for (const AnisotropicErrorAt& error : errors) {
    if (error.ratio < least || error.ratio > most) continue;
    stretched.push_back(error.stretched);
    round += error.round;
  }
  std::sort(stretched.begin(), stretched.end());
  const auto count = static_cast<double>(stretched.size());
  return {where,
          fmt::format("{:.3g} to {:.3g}", least, most),
          fmt::format("{:.4f}", std::reduce(stretched.begin(), stretched.end()) / count),
          fmt::format("{:.4f}", stretched[stretched.size() / 2]),
          fmt::format("{:.4f}", stretched.back()),
          fmt::format("{:.4f}", round / count)};
}

// Mean error by ratio and view, of the stretched lobe and of the round one.
void writeAnisotropicPicture(const std::string& ndf, const std::vector<AnisotropicErrorAt>& nodes,
                             const std::string& file) {
  constexpr std::size_t kNodes = ANISO_NODES;
  std::vector<double> stretched(kNodes * kNodes), round(kNodes * kNodes);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::size_t ratio = i / kNodes % kNodes, view = i / (kNodes * kNodes) % kNodes;
    stretched[view * kNodes + ratio] += nodes[i].stretched / (kNodes * kNodes);
    round[view * kNodes + ratio] += nodes[i].round / (kNodes * kNodes);
  }
  writePng(matrixPicture({{ndf, stretched}, {"round lobe", round}},
                         {.width = ANISO_NODES,
                          .height = ANISO_NODES,
                          .entry_px = 48,
                          .low = 0,
                          .high = 2,
                          .title = "integral of the absolute difference of LTC and BRDF cos, mean",
                          .x_label = "sqrt(alpha_v / alpha_u) 0 to 1",
                          .y_label = "view, from the normal to grazing"}),
           file);
}

int runFitAnisotropic(const CommonOptions& common, const FitLtcCommand& command) {
  const reference::Ndf ndf = parseNdf(command.ndf);
  const AnisotropicTable table =
      command.shipped ? shippedAnisotropicTable(ndf)
                      : fitWithProgress(fmt::format("{} of {} nodes on each of four axes",
                                                    command.ndf, ANISO_NODES),
                                        common, [&](const std::function<void(double)>& progress) {
                                          return fitAnisotropicTable({.ndf = ndf,
                                                                      .threads = common.threads,
                                                                      .progress = progress,
                                                                      .ranks = &allRanks()});
                                        });
  if (!allRanks().isFirst()) return kExitDone;
  if (!command.output.empty()) writeFile(command.output, serializeAnisotropicTable(table));
  const LtcTable round = shippedLtcTable(ndf);
  const std::vector<AnisotropicErrorAt> nodes = anisotropicNodeErrors(table, round);
  const std::vector<AnisotropicErrorAt> midpoints = anisotropicMidpointErrors(table, round);
  TextTable text({"where", "alpha_v / alpha_u", "mean", "median", "max", "round lobe, mean"});
  for (const auto& [least, most] : {std::pair{0.5, 1.0}, {0.2, 0.5}, {0.05, 0.2}, {0.0, 0.05}}) {
    text.addRow(ratioRow("nodes", least, most, nodes));
    text.addRow(ratioRow("between", least, most, midpoints));
  }
  printText("integral of |LTC - BRDF cos|, {}\n{}", command.ndf, text.toString());
  if (!command.picture.empty()) writeAnisotropicPicture(command.ndf, nodes, command.picture);
  return kExitDone;
}

int runFitLtc(const CommonOptions& common, const FitLtcCommand& command) {
  checkFitLtc(command);
  if (command.anisotropic) return runFitAnisotropic(common, command);
  std::vector<MeasuredTable> tables;
  LtcTable published;
  if (!command.compare.empty()) published = readPublishedLtc(command.compare);
  const LtcTable table =
      command.shipped ? shippedLtcTable(parseNdf(command.ndf)) : fittedRound(command, common);
  if (!allRanks().isFirst()) return kExitDone;
  if (!command.compare.empty() && (published.size != table.size || published.ndf != table.ndf)) {
    throw Error(fmt::format("{} is a ggx table of size {}; compare with --ndf ggx --size {}",
                            command.compare, published.size, published.size));
  }
  if (!command.output.empty()) writeFile(command.output, serializeLtcTable(table));
  tables.push_back(measure(command.ndf, table));
  if (!command.compare.empty()) tables.push_back(measure("published", published));
  printSummary(tables);
  if (tables.size() > 1) printComparison(tables[0].nodes, tables[1].nodes);
  if (!command.picture.empty()) writeErrorPicture(tables, command.picture);
  return kExitDone;
}

}  // namespace

void addFitLtcCommand(Command fit, CommandLine& line) {
  auto options = std::make_shared<FitLtcCommand>();
  Command command =
      fit.subcommand("ltc", "Linearly transformed cosines of a microfacet BRDF, and their error");
  command.option("--ndf", options->ndf, "ggx, beckmann or normals (default: ggx)");
  command.option("--size", options->size, "Nodes along each axis, 8 to 128 (default: 64)");
  command.option("-o,--output", options->output, "The table").typeName("FILE");
  command.option("--picture", options->picture, "Error of every node in false colours")
      .typeName("FILE.png");
  command.option("--compare", options->compare, "Published ltc.mat to compare with")
      .typeName("FILE");
  command.flag("--anisotropic", options->anisotropic,
               "Lobes of two roughnesses, a table of four axes");
  command.flag("--shipped", options->shipped, "Measure the table that ships; fit nothing");
  command.footer(
      "Examples:\n"
      "  glintmark fit ltc --ndf beckmann -o ltc_beckmann.table\n"
      "  glintmark fit ltc --anisotropic -o ltc_anisotropic_ggx.table\n"
      "  glintmark fit ltc --shipped --picture fit_error.png");
  command.callback([options, &line] {
    line.shares_work = true;
    line.action = [options, &line] { return runFitLtc(line.common, *options); };
  });
}

}  // namespace glintmark
