#include "host/cli/output_options.h"

#include <fmt/format.h>

namespace glintmark {

void addOutputOptions(Command command, BenchOptions& options) {
  command
      .option("-o,--output", options.folder,
              fmt::format("Results folder (default: {})", options.folder))
      .typeName("FOLDER");
  command.option("--json", options.json, "Also writes the records to this JSON file")
      .typeName("FILE");
  command.option("--csv", options.csv, "Also writes the records to this CSV file").typeName("FILE");
  command.flag("--resume", options.resume, "Keeps what an interrupted run has measured");
}

}  // namespace glintmark
