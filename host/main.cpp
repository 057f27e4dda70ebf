// The glintmark program: one catch ladder around the command line.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <system_error>

#include "host/cli/program.h"
#include "host/core/error.h"
#include "host/core/last_words.h"
#include "host/core/process_end.h"
#include "host/experiment/interrupt.h"
#include "host/parallel/ranks.h"

namespace {

/// `code`, or 2 if what was printed did not all reach its end.
int afterOutput(int code) {
  errno = 0;
  const bool written = std::cout.flush().good() && std::fflush(stdout) == 0 && !std::ferror(stdout);
  if (written) return code;
  std::fprintf(stderr, "glintmark: cannot write the standard output: %s\n",
               errno != 0 ? std::strerror(errno) : "it is full or closed");
  return glintmark::kExitBadInput;
}

int internalError(const std::exception& error) {
  return glintmark::endRanks(std::string("internal error: ") + error.what(),
                             glintmark::kExitCheckFailed);
}

int runMain(int argc, char** argv) {
  try {
    return glintmark::leaveRanks(afterOutput(glintmark::runProgram(argc, argv)));
  } catch (const glintmark::Error& error) {
    return glintmark::endRanks(error.what(), error.code());
  } catch (const glintmark::Interrupted& interrupted) {
    return glintmark::interruptRanks(interrupted.what(), glintmark::InterruptGuard::exitCode());
  } catch (const std::filesystem::filesystem_error& error) {
    // Of a name that the system does not take: too long, or below a file.
    return glintmark::endRanks(error.path1().string() + ": " + error.code().message(),
                               glintmark::kExitBadInput);
  } catch (const std::system_error& error) {
    if (std::ferror(stdout)) return afterOutput(glintmark::kExitBadInput);
    return internalError(error);
  } catch (const std::bad_alloc&) {
    return glintmark::endRanks("out of memory; choose a smaller --size or scene",
                               glintmark::kExitBadInput);
  } catch (const std::exception& error) {
    return internalError(error);
  }
}

}  // namespace

int main(int argc, char** argv) {
  glintmark::requireChildStatus();
  glintmark::endProcess(runMain(argc, argv));
}
