// glintmark report: one page to read, from folders of results.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "host/cli/command_line.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/experiment/all_tables.h"
#include "host/report/page/html_report.h"
#include "host/report/page/runs_report.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> pngFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ".png")
      files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

// As the page links it, which stands at `output`.
std::string fromPage(const fs::path& source, const std::string& output) {
  return fs::absolute(source)
      .lexically_normal()
      .lexically_relative(fs::absolute(output).lexically_normal().parent_path())
      .string();
}

void writePage(const std::string& page, const std::string& output) {
  if (page.size() > kMostPageBytes)
    throw Error(fmt::format("the page would have {:.1f} MB without pictures, {} MB is the most",
                            static_cast<double>(page.size()) * 1e-6, kMostPageBytes / 1'000'000));
  writeFile(output, page);
}

int reportOne(const std::string& folder, const std::string& output) {
  const fs::path source = fs::path(folder) / "results.json";
  const Results results = readResults(source);
  std::vector<ReportPicture> pictures;
  for (const fs::path& file : pngFiles(folder)) pictures.push_back(readReportPicture(file));
  writePage(htmlReport(results, allTableSpecs(), pictures, fromPage(source, output)), output);
  fmt::print("{} figures and {} pictures written to {}\n", results.records.size(), pictures.size(),
             output);
  return kExitDone;
}

int reportMany(const std::vector<fs::path>& sources, const std::string& output) {
  std::vector<NamedResults> runs;
  for (const fs::path& source : sources)
    runs.push_back({fromPage(source, output), readResults(source)});
  writePage(runsReport(runs, allTableSpecs()), output);
  fmt::print("{} runs written to {}\n", runs.size(), output);
  return kExitDone;
}

// Results of the folders, or below those that have none themselves, in order.
std::vector<fs::path> resultsBelow(const std::vector<std::string>& folders) {
  std::vector<fs::path> sources;
  for (const std::string& folder : folders) {
    if (!fs::is_directory(folder))
      throw Error(fmt::format("{} is not a folder of results (bench -o FOLDER makes one)", folder));
    if (fs::exists(fs::path(folder) / "results.json")) {
      sources.push_back(fs::path(folder) / "results.json");
      continue;
    }
    std::vector<fs::path> below;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && entry.path().filename() == "results.json")
        below.push_back(entry.path());
    if (below.empty())
      throw Error(fmt::format("{} has no results.json, nor has a folder below it", folder));
    std::ranges::sort(below);
    sources.insert(sources.end(), below.begin(), below.end());
  }
  return sources;
}

int runReport(const std::vector<std::string>& folders, const std::string& output) {
  const std::vector<fs::path> sources = resultsBelow(folders);
  announceOutputs({{"-o", output}});
  const bool is_one = folders.size() == 1 && fs::path(folders[0]) / "results.json" == sources[0];
  return is_one ? reportOne(folders[0], output) : reportMany(sources, output);
}

}  // namespace

void addReportCommand(Command app, CommandLine& line) {
  struct Options {
    std::vector<std::string> folders;
    std::string output = "report.html";
  };
  auto options = std::make_shared<Options>();
  Command command = app.subcommand("report", "One page to read, from folders of results");
  command
      .option(
          "folder", options->folders,
          "Results folder of bench; several, or one that holds such folders, are put side by side")
      .required()
      .typeName("FOLDER");
  command.option("-o,--output", options->output, "The page (default: report.html)")
      .typeName("FILE");
  command.footer(
      "Examples:\n"
      "  glintmark report results/latest -o report.html\n"
      "  glintmark report mine yours theirs -o devices.html\n"
      "  glintmark report results -o published.html");
  command.callback([options, &line] {
    line.action = [options] { return runReport(options->folders, options->output); };
  });
}

}  // namespace glintmark
