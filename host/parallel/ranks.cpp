#include "host/parallel/ranks.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "host/core/error.h"
#include "host/core/program_module.h"
#include "host/parallel/mpi_ranks.h"

namespace glintmark {
namespace {

// How long a rank that was asked to stop waits for the end.
constexpr std::chrono::seconds kEndComes{20};

class AloneRanks : public Ranks {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  int onThisMachine() const override { return 1; }
  void sum(std::span<std::uint64_t>) const override {}
  void sumAtFirst(std::span<std::uint64_t>) const override {}
  std::vector<std::string> gather(const std::string& bytes) const override { return {bytes}; }
  std::string fromFirst(const std::string& bytes) const override { return bytes; }
  void post(const std::string& bytes) override { posted_.push_back({0, bytes}); }
  std::vector<RankMessage> arrived() override { return std::exchange(posted_, {}); }
  double waitedNs() const override { return 0; }

 private:
  std::vector<RankMessage> posted_;
};

std::unique_ptr<LaunchedRanks> joined;
std::function<void()> waiting_call;

int numberIn(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  if (text == nullptr) return otherwise;
  const std::string_view view = text;
  int value = otherwise;
  const auto parsed = std::from_chars(view.data(), view.data() + view.size(), value);
  return parsed.ec == std::errc() ? value : otherwise;
}

// Where the launcher says how many there are: Open MPI; launchers by PMI (Slurm, MPICH); Slurm by
// PMIx.
std::optional<Launched> countedRanks() {
  for (const auto& [rank, size] :
       {std::pair("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"),
        std::pair("PMI_RANK", "PMI_SIZE"), std::pair("PMIX_RANK", "SLURM_STEP_NUM_TASKS")})
    if (const int own = numberIn(rank, -1), count = numberIn(size, 0); own >= 0 && count > 0)
      return Launched{std::min(own, count - 1), count};
  return std::nullopt;
}

// Open MPI does not start without a home, which users of containers may lack. It loads modules from
// there, so it must be a folder that no other user can write; nothing else is to take it for
// theirs.
class HomeForMpi {
 public:
  HomeForMpi() : lent_(std::getenv("HOME") == nullptr) {
    if (lent_) setenv("HOME", "/", 1);
  }
  ~HomeForMpi() {
    if (lent_) unsetenv("HOME");
  }
  HomeForMpi(const HomeForMpi&) = delete;
  HomeForMpi& operator=(const HomeForMpi&) = delete;

 private:
  const bool lent_;
};

}  // namespace

SharedTime::Spent SharedTime::spent() const {
  const double wall_ns = elapsedNs();
  std::uint64_t waited_ns = static_cast<std::uint64_t>(ranks_.waitedNs() - before_ns_);
  ranks_.sum({&waited_ns, 1});
  return {wall_ns * 1e-9, static_cast<double>(waited_ns) / (wall_ns * ranks_.size())};
}

bool Ranks::any(bool mine) const {
  std::uint64_t count = mine ? 1 : 0;
  sum({&count, 1});
  return count > 0;
}

int RankDeal::next(double cost) {
  const auto least = std::ranges::min_element(load_);
  *least += cost;
  return static_cast<int>(least - load_.begin());
}

Ranks& aloneRanks() {
  static AloneRanks alone;
  return alone;
}

Ranks& allRanks() {
  if (joined) return *joined;
  return aloneRanks();
}

Launched launched() {
  if (const std::optional<Launched> counted = countedRanks()) return *counted;
  // By PMIx alone the number of ranks is known to MPI only.
  if (const int rank = numberIn("PMIX_RANK", -1); rank >= 0) return {rank, std::max(2, rank + 1)};
  return {};
}

bool hasLauncher() {
  return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || launched().size > 1;
}

void joinRanks() {
  if (joined || !hasLauncher()) return;
  if (!std::filesystem::exists(modulePath(kMpiModule))) {
    if (launched().size == 1) return;
    throw Error(
        "this glintmark was built without MPI, so mpirun cannot share its work among ranks: start "
        "it without mpirun, or install libopenmpi-dev and build it anew");
  }
  const HomeForMpi home;
  // Open MPI's own modules look for its symbols among those of the program.
  auto* const join = reinterpret_cast<JoinMpiFunction*>(
      moduleFunction(kMpiModule, kJoinMpiSymbol, "sharing work among ranks needs", true));
  joined.reset(join([] {
    if (waiting_call) waiting_call();
  }));
  // Ranks of another MPI's launcher are strangers to each other, and each would do all of the work.
  const std::optional<Launched> counted = countedRanks();
  const int found = joined->size();
  if (!counted || counted->size <= found) return;
  leaveRanks(kExitBadInput);
  joined.reset();
  throw Error(fmt::format(
      "the launcher has started {} ranks, but {} of them can share work: it is of another MPI than "
      "glintmark_mpi.so; start them with Open MPI's mpirun",
      counted->size, found));
}

void whileWaiting(std::function<void()> call) {
  waiting_call = std::move(call);
}

int leaveRanks(int exit_code) {
  if (joined) joined->leave();
  return exit_code;
}

int endRanks(const std::string& sentence, int exit_code) {
  const Launched self = launched();
  if (!joined) {
    // mpirun may end all, and drop what they said, as soon as one has ended.
    if (self.rank > 0) std::this_thread::sleep_for(kFirstSpeaks);
    if (self.rank == 0) std::fprintf(stderr, "glintmark: %s\n", sentence.c_str());
    return exit_code;
  }
  const Ranks& ranks = *joined;
  std::fflush(stdout);
  if (ranks.isFirst()) {
    std::fprintf(stderr, "glintmark: %s\n", sentence.c_str());
  } else {
    std::this_thread::sleep_for(kFirstSpeaks);
    std::fprintf(stderr, "glintmark: rank %d of %d: %s\n", ranks.rank(), ranks.size(),
                 sentence.c_str());
  }
  std::fflush(stderr);
  joined->abort(exit_code);
  return exit_code;
}

int interruptRanks(const std::string& sentence, int exit_code) {
  if (!joined || joined->isFirst()) return endRanks(sentence, exit_code);
  std::this_thread::sleep_for(kEndComes);
  joined->abort(exit_code);
  return exit_code;
}

}  // namespace glintmark
