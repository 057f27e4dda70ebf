#include "tests/cli/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "host/core/atomic_file.h"

namespace glintmark {
namespace {

constexpr const char* kProgram = GLINTMARK_BINARY_DIR "/bin/glintmark";
constexpr int kExitNotStarted = 127;

void redirect(const char* file, int flags, int descriptor) {
  const int opened = open(file, flags, 0644);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(kExitNotStarted);
}

std::vector<char*> pointersTo(const std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  return argv;
}

std::vector<std::string> behind(std::vector<std::string> words,
                                const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// mpirun of the search path; empty without one.
std::string findMpirun() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const std::string file = folder + "/mpirun"; access(file.c_str(), X_OK) == 0) return file;
  return "";
}

// What mpirun asks of its surroundings: that root is meant, and a home, which users of containers
// may lack.
std::vector<std::string> mpirunEnvironment() {
  std::vector<std::string> entries = {"OMPI_ALLOW_RUN_AS_ROOT=1",
                                      "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"};
  if (std::getenv("HOME") == nullptr) entries.emplace_back("HOME=/");
  return entries;
}

}  // namespace

Process::Process(const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment, std::size_t most_file_bytes)
    : Process(kProgram, pointersTo(behind({kProgram}, arguments)), environment, most_file_bytes) {}

Process Process::byRanks(int ranks, const std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment) {
  const std::string mpirun = findMpirun();
  const std::vector<std::string> words = behind(
      {mpirun, "--oversubscribe", "--bind-to", "none", "-n", std::to_string(ranks), kProgram},
      arguments);
  return Process(mpirun.c_str(), pointersTo(words), behind(mpirunEnvironment(), environment), 0);
}

Process::Process(const char* program, std::vector<char*> argv,
                 const std::vector<std::string>& environment, std::size_t most_file_bytes) {
  const std::string out = folder_ / "out", err = folder_ / "err";
  pid_ = fork();
  if (pid_ != 0) return;
  redirect("/dev/null", O_RDONLY, STDIN_FILENO);
  redirect(out.c_str(), O_WRONLY | O_CREAT, STDOUT_FILENO);
  redirect(err.c_str(), O_WRONLY | O_CREAT, STDERR_FILENO);
  setenv("COLUMNS", "1000", 1);  // sentences stay lines
  for (const std::string& entry : environment) putenv(const_cast<char*>(entry.c_str()));
  if (most_file_bytes > 0) {
    const rlimit limit = {most_file_bytes, most_file_bytes};
    signal(SIGXFSZ, SIG_IGN);
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(kExitNotStarted);
  }
  execv(program, argv.data());
  _exit(kExitNotStarted);
}

void Process::interrupt() const {
  send(SIGINT);
}

void Process::send(int signal) const {
  ::kill(pid_, signal);
}

std::string Process::errSoFar() const {
  std::ifstream stream(folder_ / "err");
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<int> Process::children() const {
  std::vector<int> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
    const int pid = std::atoi(entry.path().filename().c_str());
    if (pid <= 0) continue;
    std::ifstream stream(entry.path() / "stat");
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    // "PID (NAME) STATE PARENT …"; a name may hold anything.
    std::istringstream rest(text.substr(std::min(text.size(), text.rfind(')') + 1)));
    std::string state;
    int parent = 0;
    if (rest >> state >> parent && parent == pid_) found.push_back(pid);
  }
  return found;
}

void Process::kill() const {
  ::kill(pid_, SIGKILL);
}

bool Process::isRunning() const {
  siginfo_t info = {};
  return waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == 0;
}

ProcessResult Process::wait() {
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(folder_ / "out"),
          readFile(folder_ / "err")};
}

ProcessResult runGlintmark(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& environment) {
  return Process(arguments, environment).wait();
}

bool canShareRanks() {
  return !findMpirun().empty() &&
         std::filesystem::exists(GLINTMARK_BINARY_DIR "/bin/glintmark_mpi.so");
}

int openMpiVersion() {
  FILE* said = popen(("HOME=/ " + findMpirun() + " --version").c_str(), "r");
  int major = 0;
  if (said == nullptr || std::fscanf(said, "mpirun (Open MPI) %d", &major) != 1) major = 0;
  if (said != nullptr) pclose(said);
  return major;
}

ProcessResult runByRanks(int ranks, const std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment) {
  return Process::byRanks(ranks, arguments, environment).wait();
}

std::filesystem::path changedKernels(const TempFolder& folder, const std::string& file,
                                     const std::string& from, const std::string& to) {
  std::filesystem::path kernels = folder / "kernels";
  std::filesystem::copy(GLINTMARK_SOURCE_DIR "/kernels", kernels,
                        std::filesystem::copy_options::recursive);
  std::string text = readFile(kernels / file);
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error(file + " has no " + from);
  text.replace(at, from.size(), to);
  writeFile(kernels / file, text);
  return kernels;
}

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

}  // namespace glintmark
