// The processes that share one run: the ranks of mpirun, or this one alone.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "host/core/stopwatch.h"

namespace glintmark {

/// A message of one rank to the first.
struct RankMessage {
  int rank = 0;
  std::string bytes;
};

/// A group of ranks. What is said to be of all is called by each of them, in the same order; it
/// returns once all have called it, and waits without keeping a core busy. Every rank gets the same
/// bits. Not safe from several threads.
class Ranks {
 public:
  virtual ~Ranks() = default;

  virtual int rank() const = 0;  // from 0
  virtual int size() const = 0;
  bool isFirst() const { return rank() == 0; }
  /// How many of them run on this machine.
  virtual int onThisMachine() const = 0;

  /// Of all: adds up `counts`, as many at each rank, at every rank.
  virtual void sum(std::span<std::uint64_t> counts) const = 0;
  /// Of all: the same, with the sums at the first rank; others keep what they had.
  virtual void sumAtFirst(std::span<std::uint64_t> counts) const = 0;
  /// Of all: what each of them gives, by rank.
  virtual std::vector<std::string> gather(const std::string& bytes) const = 0;
  /// Of all: what the first rank gives.
  virtual std::string fromFirst(const std::string& bytes) const = 0;

  /// Sends to the first rank, which need not listen: what was sent arrives even if the sender dies
  /// later. The first rank may send to itself.
  virtual void post(const std::string& bytes) = 0;
  /// At the first rank: what has arrived since it was last asked; does not wait for anything.
  virtual std::vector<RankMessage> arrived() = 0;

  /// How long this rank has waited for others.
  virtual double waitedNs() const = 0;

  /// Of all: is it so at some rank?
  bool any(bool mine) const;
  /// Does this rank make unit `unit` of those that are dealt out one by one?
  bool makes(std::size_t unit) const {
    return unit % static_cast<std::size_t>(size()) == static_cast<std::size_t>(rank());
  }
};

/// This process alone: one rank.
Ranks& aloneRanks();

/// All ranks of this run: those of the launcher once joinRanks() was called, else this process.
Ranks& allRanks();

/// What the launcher says by its environment, before anything is joined: the number of this process
/// among how many. 0 of 1 without a launcher.
struct Launched {
  int rank = 0, size = 1;
};
Launched launched();

/// Did a launcher start this process, perhaps as the only one?
bool hasLauncher();

/// How long a rank lets the first speak for it.
inline constexpr std::chrono::milliseconds kFirstSpeaks{1500};

/// Joins the ranks that the launcher started with this one; does nothing without a launcher. Throws
/// Error if there are several and the program was built without MPI, or they cannot all be joined.
void joinRanks();

/// Called now and then while a rank waits for others; what it throws ends the wait, and nothing can
/// be shared after that. Empty: nothing is called.
void whileWaiting(std::function<void()> call);

/// The exit code of a run that has ended well at this rank; waits for the others.
int leaveRanks(int exit_code);

/// Ends a run at which something went wrong, at all ranks: the first prints `sentence` on stderr at
/// once; another names itself in it, and only if the first has not ended all of them by then, so
/// that what goes wrong everywhere is said once. Returns `exit_code` where this process is alone.
int endRanks(const std::string& sentence, int exit_code);

/// Ends a run at a rank that was asked to stop: the first prints `sentence`; the others wait for
/// the end, since a rank that leaves early would have the launcher end all. As endRanks() else.
int interruptRanks(const std::string& sentence, int exit_code);

/// Deals units out, each to the rank that has least to do so far, of equal ones the first; every
/// rank that asks for the same units gets the same answers.
class RankDeal {
 public:
  explicit RankDeal(int ranks) : load_(static_cast<std::size_t>(ranks), 0) {}
  /// The rank that gets the next unit, which costs so much.
  int next(double cost);

 private:
  std::vector<double> load_;
};

/// How well ranks shared what began with this: made by all, asked by all.
class SharedTime {
 public:
  explicit SharedTime(const Ranks& ranks) : ranks_(ranks), before_ns_(ranks.waitedNs()) {}

  double elapsedNs() const { return watch_.elapsedNs(); }
  struct Spent {
    double wall_s = 0;
    double waiting = 0;  // share of it that ranks waited for each other, their mean
  };
  /// Of all.
  Spent spent() const;

 private:
  const Ranks& ranks_;
  double before_ns_;
  Stopwatch watch_;
};

/// Of all of `ranks`: `count` parts, of which each rank has made those whose unit(i) makes() says;
/// afterwards each has all. bytes(i) is a part's memory, as long at each rank, std::span<char>.
template <typename Unit, typename Bytes>
void shareParts(const Ranks& ranks, std::size_t count, const Unit& unit, const Bytes& bytes) {
  if (ranks.size() == 1) return;
  std::string mine;
  for (std::size_t i = 0; i < count; ++i)
    if (const std::span<char> part = bytes(i); ranks.makes(unit(i)))
      mine.append(part.data(), part.size());
  const std::vector<std::string> all = ranks.gather(mine);
  std::vector<std::size_t> taken(all.size(), 0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t maker = unit(i) % all.size();
    const std::span<char> part = bytes(i);
    all[maker].copy(part.data(), part.size(), taken[maker]);
    taken[maker] += part.size();
  }
}

/// The same of rows of `row` values, a unit each. T is trivially copyable.
template <typename T>
void shareRows(const Ranks& ranks, std::span<T> values, std::size_t row) {
  static_assert(std::is_trivially_copyable_v<T>);
  shareParts(
      ranks, row > 0 ? values.size() / row : 0, [](std::size_t i) { return i; },
      [&](std::size_t i) {
        return std::span(reinterpret_cast<char*>(&values[i * row]), row * sizeof(T));
      });
}

}  // namespace glintmark
