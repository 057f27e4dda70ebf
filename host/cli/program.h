// The command line program without its error handling.
#pragma once

namespace glintmark {

/// Parses and runs. Returns the exit code; throws Error for bad usage and input, Interrupted after
/// Ctrl-C.
int runProgram(int argc, const char* const* argv);

}  // namespace glintmark
