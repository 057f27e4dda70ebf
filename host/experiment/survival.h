// Measurements that outlive a driver which ends their process.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace glintmark {

/// A case that ended the process which measured it.
struct LostCase {
  std::string name;
  std::string how;  // "ended by signal 11 (Segmentation fault)"
};

/// Runs `measure` in a child of this process, and again in another one whenever one dies within a
/// CaseAtHand, until one ends by itself; `measure` is told whether it is the first. Drivers die
/// while they compile, launch and read: a child that only compiles would see the first of these, at
/// twice the price. Returns `measure`'s result in the child, where its exceptions pass through, and
/// the child's exit code in this process, which is not to have used OpenCL. Ranks of a launcher
/// have no children: there `measure` runs in this process. Requests to end are handed on; a child
/// that these or a lack of memory (SIGKILL) ended is not replaced. Unless quiet, a note on stderr
/// says what was lost.
int runSurviving(bool quiet, const std::function<int(bool first)>& measure);

/// Runs `work` in a child of this process, which says what ended it if that was not `work`: a
/// driver's crash, or its calling exit(). Returns `work`'s result in the child, where its
/// exceptions pass through, and what the program is to return in this process, which is not to have
/// used OpenCL. Ranks of a launcher have a process that watches them already.
int runWatched(const std::function<int()>& work);

/// Cases that processes before this one died in.
const std::vector<LostCase>& lostCases();
/// Is that case one of them?
bool isLost(const std::string& table, const std::string& case_name);
/// Throws DeviceError if there are none of `records` because every case was lost.
void requireMeasured(std::size_t records);
/// How long these processes took, in seconds.
double secondsOfLostProcesses();

/// As long as it lives, this process measures that case, which is not lost; then again the one
/// before. Where cases are measured together, each part that belongs to one alone says so.
class CaseAtHand {
 public:
  CaseAtHand(const std::string& table, const std::string& case_name);
  ~CaseAtHand();
  CaseAtHand(const CaseAtHand&) = delete;
  CaseAtHand& operator=(const CaseAtHand&) = delete;

 private:
  std::string before_;
};

/// Lets children of this process tell it which case they are at; false if there is no memory.
bool shareCaseAtHand();
/// Where a child of this process is, or was when it ended: "zk16 snow/steep"; empty: in no case.
std::string caseAtHand();

}  // namespace glintmark
