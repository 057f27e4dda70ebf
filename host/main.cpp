// The glintmark program: one catch ladder around the command line.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <system_error>

#include "host/cli/program.h"
#include "host/core/error.h"
#include "host/experiment/interrupt.h"

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

}  // namespace

int main(int argc, char** argv) {
  try {
    return afterOutput(glintmark::runProgram(argc, argv));
  } catch (const glintmark::Error& error) {
    std::fprintf(stderr, "glintmark: %s\n", error.what());
    return error.code();
  } catch (const glintmark::Interrupted& interrupted) {
    std::fprintf(stderr, "glintmark: %s\n", interrupted.what());
    return glintmark::InterruptGuard::exitCode();
  } catch (const std::system_error& error) {
    if (std::ferror(stdout)) return afterOutput(glintmark::kExitBadInput);
    std::fprintf(stderr, "glintmark: internal error: %s\n", error.what());
    return glintmark::kExitCheckFailed;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "glintmark: out of memory; choose a smaller --size or scene\n");
    return glintmark::kExitBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "glintmark: internal error: %s\n", error.what());
    return glintmark::kExitCheckFailed;
  }
}
