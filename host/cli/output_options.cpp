#include "host/cli/output_options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace glintmark {

void addOutputOptions(CLI::App& command, BenchOptions& options) {
  command
      .add_option("-o,--output", options.folder,
                  fmt::format("Results folder (default: {})", options.folder))
      ->type_name("FOLDER");
  command.add_option("--json", options.json, "Also writes the records to this JSON file")
      ->type_name("FILE");
  command.add_option("--csv", options.csv, "Also writes the records to this CSV file")
      ->type_name("FILE");
  command.add_flag("--resume", options.resume, "Keeps what an interrupted run has measured");
}

}  // namespace glintmark
