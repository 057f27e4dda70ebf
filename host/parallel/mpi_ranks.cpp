// Every wait is a test now and then: MPI's own keep a core busy, which kernels on a processor need,
// and do not let a signal through.
#include "host/parallel/mpi_ranks.h"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <deque>
#include <map>
#include <numeric>
#include <thread>

namespace glintmark {
namespace {

constexpr std::chrono::microseconds kShortestNap{20}, kLongestNap{200};
constexpr int kMessageTag = 1;
// Small enough for every transport of Open MPI to send it at once, before anybody asks for it.
constexpr std::size_t kPieceBytes = 2048;
// More numbers than these are summed without naps, which would come between their parts, once all
// ranks are there.
constexpr std::size_t kManyCounts = 64;
// Of what all gather in one call: MPI counts bytes by int.
constexpr std::size_t kGatherBytes = std::size_t{1} << 30;

class MpiRanks : public LaunchedRanks {
 public:
  explicit MpiRanks(void (*waiting)());

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int onThisMachine() const override { return on_this_machine_; }
  void sum(std::span<std::uint64_t> counts) const override;
  void sumAtFirst(std::span<std::uint64_t> counts) const override;
  std::vector<std::string> gather(const std::string& bytes) const override;
  std::string fromFirst(const std::string& bytes) const override;
  void post(const std::string& bytes) override;
  std::vector<RankMessage> arrived() override;
  double waitedNs() const override { return waited_.count(); }
  void leave() override;
  void abort(int exit_code) override;

 private:
  struct Sent {
    std::string bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  struct Unfinished {
    std::string bytes;
    std::size_t size = 0;
    bool has_size = false;
  };
  // Naps while others may be busy with something else; without naps while they are here as well.
  void wait(MPI_Request& request, bool naps = true) const;
  void meet() const;
  void postPiece(std::string bytes);

  void (*waiting_)();
  mutable std::chrono::duration<double, std::nano> waited_{0};
  int rank_ = 0, size_ = 1, on_this_machine_ = 1;
  // What MPI reads and writes: it stays where it is if a wait is given up, which others do not
  // know.
  mutable std::vector<std::uint64_t> counts_;
  mutable std::vector<int> lengths_, places_;
  mutable std::string given_, received_;
  std::deque<Sent> sent_;                 // a deque: requests and bytes stay where they are
  std::map<int, Unfinished> unfinished_;  // by the rank that sends
};

MpiRanks::MpiRanks(void (*waiting)()) : waiting_(waiting) {
  int provided = MPI_THREAD_SINGLE;  // other threads never call MPI
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &on_this_machine_);
  MPI_Comm_free(&machine);
}

void MpiRanks::meet() const {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  wait(request);
}

void MpiRanks::wait(MPI_Request& request, bool naps) const {
  auto nap = kShortestNap;
  const auto begin = std::chrono::steady_clock::now();
  for (int done = 0;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done) {
      waited_ += std::chrono::steady_clock::now() - begin;
      return;
    }
    waiting_();
    if (!naps) {
      std::this_thread::yield();
      continue;
    }
    std::this_thread::sleep_for(nap);
    nap = std::min(2 * nap, kLongestNap);
  }
}

void MpiRanks::sum(std::span<std::uint64_t> counts) const {
  const bool many = counts.size() > kManyCounts;
  if (many) meet();
  counts_.assign(counts.begin(), counts.end());
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(MPI_IN_PLACE, counts_.data(), static_cast<int>(counts_.size()), MPI_UINT64_T,
                 MPI_SUM, MPI_COMM_WORLD, &request);
  wait(request, !many);
  std::ranges::copy(counts_, counts.begin());
}

void MpiRanks::sumAtFirst(std::span<std::uint64_t> counts) const {
  meet();
  counts_.assign(counts.begin(), counts.end());
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ireduce(isFirst() ? MPI_IN_PLACE : counts_.data(), isFirst() ? counts_.data() : nullptr,
              static_cast<int>(counts_.size()), MPI_UINT64_T, MPI_SUM, 0, MPI_COMM_WORLD, &request);
  wait(request, false);
  if (isFirst()) std::ranges::copy(counts_, counts.begin());
}

std::vector<std::string> MpiRanks::gather(const std::string& bytes) const {
  const auto count = static_cast<std::size_t>(size_);
  given_ = bytes;
  counts_.assign(count + 1, bytes.size());  // the last: this rank's
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallgather(&counts_.back(), 1, MPI_UINT64_T, counts_.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD,
                 &request);
  wait(request);
  const std::vector<std::uint64_t> sizes(counts_.begin(), counts_.end() - 1);
  std::vector<std::string> all(count);
  const std::size_t most = std::max<std::size_t>(kGatherBytes / count, 1);
  for (std::size_t begin = 0; begin == 0 || begin < std::ranges::max(sizes); begin += most) {
    const auto part = [&](std::uint64_t size) {
      return static_cast<int>(
          std::min<std::uint64_t>(most, size - std::min<std::uint64_t>(size, begin)));
    };
    lengths_.resize(count), places_.resize(count);
    std::ranges::transform(sizes, lengths_.begin(), part);
    std::exclusive_scan(lengths_.begin(), lengths_.end(), places_.begin(), 0);
    received_.resize(static_cast<std::size_t>(places_.back() + lengths_.back()));
    const char* from = given_.data() + std::min<std::size_t>(begin, given_.size());
    MPI_Iallgatherv(from, lengths_[static_cast<std::size_t>(rank_)], MPI_BYTE, received_.data(),
                    lengths_.data(), places_.data(), MPI_BYTE, MPI_COMM_WORLD, &request);
    wait(request, false);  // all have told how much they have
    for (std::size_t i = 0; i < count; ++i)
      all[i].append(received_, static_cast<std::size_t>(places_[i]),
                    static_cast<std::size_t>(lengths_[i]));
  }
  return all;
}

std::string MpiRanks::fromFirst(const std::string& bytes) const {
  counts_.assign(1, bytes.size());
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(counts_.data(), 1, MPI_UINT64_T, 0, MPI_COMM_WORLD, &request);
  wait(request);
  given_ = bytes;
  given_.resize(counts_.front());
  for (std::size_t begin = 0; begin < given_.size(); begin += kGatherBytes) {
    const std::size_t some = std::min(kGatherBytes, given_.size() - begin);
    MPI_Ibcast(given_.data() + begin, static_cast<int>(some), MPI_BYTE, 0, MPI_COMM_WORLD,
               &request);
    wait(request);
  }
  return given_;
}

void MpiRanks::postPiece(std::string bytes) {
  sent_.push_back({std::move(bytes)});
  Sent& piece = sent_.back();
  MPI_Isend(piece.bytes.data(), static_cast<int>(piece.bytes.size()), MPI_BYTE, 0, kMessageTag,
            MPI_COMM_WORLD, &piece.request);
}

// The size first, in eight bytes.
void MpiRanks::post(const std::string& bytes) {
  const std::uint64_t bytes_size = bytes.size();
  postPiece(std::string(reinterpret_cast<const char*>(&bytes_size), sizeof bytes_size));
  for (std::size_t begin = 0; begin < bytes.size(); begin += kPieceBytes)
    postPiece(bytes.substr(begin, kPieceBytes));
  for (int done = 1; !sent_.empty() && done != 0;) {
    MPI_Test(&sent_.front().request, &done, MPI_STATUS_IGNORE);
    if (done) sent_.pop_front();
  }
}

std::vector<RankMessage> MpiRanks::arrived() {
  std::vector<RankMessage> messages;
  for (;;) {
    int there = 0, piece_bytes = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, kMessageTag, MPI_COMM_WORLD, &there, &status);
    if (!there) return messages;
    MPI_Get_count(&status, MPI_BYTE, &piece_bytes);
    std::string piece(static_cast<std::size_t>(piece_bytes), '\0');
    MPI_Recv(piece.data(), piece_bytes, MPI_BYTE, status.MPI_SOURCE, kMessageTag, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    Unfinished& message = unfinished_[status.MPI_SOURCE];
    if (message.has_size) {
      message.bytes += piece;
    } else {
      std::uint64_t bytes_size = 0;
      piece.copy(reinterpret_cast<char*>(&bytes_size), sizeof bytes_size);
      message.size = bytes_size, message.has_size = true;
    }
    if (message.bytes.size() < message.size) continue;
    messages.push_back({status.MPI_SOURCE, std::move(message.bytes)});
    message = {};
  }
}

void MpiRanks::leave() {
  for (Sent& piece : sent_) wait(piece.request);
  sent_.clear();
  meet();  // MPI_Finalize waits with a busy core
  MPI_Finalize();
}

void MpiRanks::abort(int exit_code) {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

}  // namespace
}  // namespace glintmark

extern "C" __attribute__((visibility("default"))) glintmark::LaunchedRanks* glintmarkJoinMpi(
    void (*waiting)()) {
  return new glintmark::MpiRanks(waiting);
}
