// glintmark report: one page to read, from a folder of results.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "host/cli/command_line.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/experiment/all_tables.h"
#include "host/report/page/html_report.h"

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

int runReport(const std::string& folder, const std::string& output) {
  if (!fs::is_directory(folder))
    throw Error(fmt::format("{} is not a folder of results (bench -o FOLDER makes one)", folder));
  requireWritableFile(output);
  const fs::path source = fs::path(folder) / "results.json";
  const Results results = readResults(source);
  std::vector<ReportPicture> pictures;
  for (const fs::path& file : pngFiles(folder)) pictures.push_back(readReportPicture(file));
  const std::string page =
      htmlReport(results, allTableSpecs(), pictures,
                 fs::absolute(source)
                     .lexically_normal()
                     .lexically_relative(fs::absolute(output).lexically_normal().parent_path())
                     .string());
  if (page.size() > kMostPageBytes)
    throw Error(fmt::format("the page would have {:.1f} MB without pictures, {} MB is the most",
                            static_cast<double>(page.size()) * 1e-6, kMostPageBytes / 1'000'000));
  writeFile(output, page);
  fmt::print("{} figures and {} pictures written to {}\n", results.records.size(), pictures.size(),
             output);
  return kExitDone;
}

}  // namespace

void addReportCommand(Command app, CommandLine& line) {
  struct Options {
    std::string folder, output = "report.html";
  };
  auto options = std::make_shared<Options>();
  Command command = app.subcommand("report", "One page to read, from a folder of results");
  command.option("folder", options->folder, "Results folder of bench").required();
  command.option("-o,--output", options->output, "The page (default: report.html)")
      .typeName("FILE");
  command.footer("Example:\n  glintmark report results/latest -o report.html");
  command.callback([options, &line] {
    line.action = [options] { return runReport(options->folder, options->output); };
  });
}

}  // namespace glintmark
