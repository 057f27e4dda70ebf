// Errors that end the program with one clear sentence and the right exit code.
#pragma once
#include <stdexcept>
#include <string>

namespace glintmark {

/// Exit codes of the command line.
enum ExitCode : int { kExitDone = 0, kExitCheckFailed = 1, kExitBadInput = 2, kExitNoDevice = 3 };

/// Bad usage or input. The message is one sentence that names the thing and says what would be
/// right; main prints it after "glintmark: " and exits with `code`.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message, ExitCode code = kExitBadInput)
      : std::runtime_error(message), code_(code) {}
  ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

/// No usable OpenCL device (exit code 3).
class DeviceError : public Error {
 public:
  explicit DeviceError(const std::string& message) : Error(message, kExitNoDevice) {}
};

}  // namespace glintmark
