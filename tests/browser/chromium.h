// Debian's chromium without a window, each start with a profile and a time limit of its own.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "tests/report/temp_folder.h"

namespace glintmark {

/// The program in PATH; empty if there is none.
std::string findChromium();

struct BrowserResult {
  int exit_code = -1;   // 124: out of time
  std::string out;      // --dump-dom
  std::string console;  // every line that the page wrote to the console, errors among them
};

/// Opens `page` with `options` beside the usual ones.
BrowserResult runChromium(const std::filesystem::path& page,
                          const std::vector<std::string>& options);

}  // namespace glintmark
