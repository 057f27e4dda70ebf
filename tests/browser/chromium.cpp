#include "tests/browser/chromium.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <sstream>

#include "host/core/atomic_file.h"

namespace glintmark {
namespace {

constexpr int kExitNotStarted = 127;

void redirect(const std::string& file, int descriptor) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(kExitNotStarted);
}

// Lines of the browser's log that come from the page's console.
std::string consoleLines(const std::string& log) {
  std::istringstream lines(log);
  std::string line, console;
  while (std::getline(lines, line))
    if (line.find(":CONSOLE") != std::string::npos) console += line + "\n";
  return console;
}

}  // namespace

std::string findChromium() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string program = folder + "/chromium";
    if (access(program.c_str(), X_OK) == 0) return program;
  }
  return "";
}

BrowserResult runChromium(const std::filesystem::path& page,
                          const std::vector<std::string>& options) {
  const TempFolder folder;
  std::vector<std::string> words = {"timeout",
                                    "--kill-after=5",
                                    "90",
                                    findChromium(),
                                    "--headless",
                                    "--no-sandbox",
                                    "--disable-gpu",
                                    "--disable-dev-shm-usage",
                                    "--hide-scrollbars",
                                    "--no-first-run",
                                    "--enable-logging=stderr",
                                    "--allow-file-access-from-files",
                                    "--virtual-time-budget=3000",
                                    "--user-data-dir=" + (folder / "profile").string()};
  words.insert(words.end(), options.begin(), options.end());
  words.push_back("file://" + page.string());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    redirect(folder / "out", STDOUT_FILENO);
    redirect(folder / "err", STDERR_FILENO);
    execvp("timeout", argv.data());
    _exit(kExitNotStarted);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(folder / "out"),
          consoleLines(readFile(folder / "err"))};
}

}  // namespace glintmark
