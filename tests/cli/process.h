// Runs the built glintmark program as its users do.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/report/temp_folder.h"

namespace glintmark {

/// What takes seconds at most may take this long before a test gives up.
inline constexpr std::chrono::seconds kPatience{120};

struct ProcessResult {
  int exit_code = -1;  // -1: ended by a signal
  std::string out, err;
};

/// A started program; stdin is empty, stdout and stderr go to files.
class Process {
 public:
  /// `environment` holds "NAME=value" entries added to this process's own and to COLUMNS=1000. A
  /// write that would make a file larger than `most_file_bytes` fails, as on a full disk; 0 sets no
  /// limit.
  explicit Process(const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment = {},
                   std::size_t most_file_bytes = 0);
  /// Of glintmark by `ranks` ranks of mpirun, on as few processors as there are.
  static Process byRanks(int ranks, const std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment = {});
  void interrupt() const;
  void send(int signal) const;
  /// SIGKILL: nothing of the program runs any more.
  void kill() const;
  bool isRunning() const;
  /// What it has written to stderr.
  std::string errSoFar() const;
  /// Its own child processes.
  std::vector<int> children() const;
  ProcessResult wait();

 private:
  Process(const char* program, std::vector<char*> argv, const std::vector<std::string>& environment,
          std::size_t most_file_bytes);

  TempFolder folder_;
  pid_t pid_ = -1;
};

/// Starts glintmark with `arguments` and waits for it.
ProcessResult runGlintmark(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& environment = {});

/// Is there an mpirun, and a glintmark that can be shared among its ranks?
bool canShareRanks();
/// Major version of the Open MPI that mpirun is of; 0 of another.
int openMpiVersion();
/// Starts glintmark by so many ranks and waits for all.
ProcessResult runByRanks(int ranks, const std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment = {});

/// A copy of the kernels in which `from`, in `file`, became `to`.
std::filesystem::path changedKernels(const TempFolder& folder, const std::string& file,
                                     const std::string& from, const std::string& to);

/// How often `part` stands in a text.
std::size_t countOf(const std::string& text, const std::string& part);

}  // namespace glintmark
