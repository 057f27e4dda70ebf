// The glintmark program: one catch ladder around the command line.
#include <cstdio>
#include <exception>
#include <new>

#include "host/cli/program.h"
#include "host/core/error.h"
#include "host/experiment/interrupt.h"

int main(int argc, char** argv) {
  try {
    return glintmark::runProgram(argc, argv);
  } catch (const glintmark::Error& error) {
    std::fprintf(stderr, "glintmark: %s\n", error.what());
    return error.code();
  } catch (const glintmark::Interrupted& interrupted) {
    std::fprintf(stderr, "glintmark: %s\n", interrupted.what());
    return glintmark::InterruptGuard::exitCode();
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "glintmark: out of memory; choose a smaller --size or scene\n");
    return glintmark::kExitBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "glintmark: internal error: %s\n", error.what());
    return glintmark::kExitCheckFailed;
  }
}
