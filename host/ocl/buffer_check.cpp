#include "host/ocl/buffer_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace glintmark {
namespace {

constexpr std::size_t kCanaries = 16;
constexpr std::size_t kSpots = 4, kSpotBytes = 64;

// No float, index or colour that kernels write; another in every place and round.
std::uint32_t canary(std::size_t place, std::uint32_t round) {
  return (static_cast<std::uint32_t>(place) + kCanaries * round + 1) * 0x9E3779B1u;
}

// Calls visit(place, offset, size) for parts of at most `part` bytes, from the first to the last.
template <typename Visit>
void visitSpots(std::size_t bytes, std::size_t count, std::size_t part, const Visit& visit) {
  const std::size_t size = std::min(bytes, part), last = bytes - size;
  for (std::size_t place = 0; place < count; ++place)
    visit(place, last / (count - 1) * place + (place == count - 1 ? last % (count - 1) : 0), size);
}

}  // namespace

void plantCanaries(void* target, std::size_t bytes, std::uint32_t round) {
  visitSpots(bytes, kCanaries, sizeof(std::uint32_t),
             [&](std::size_t place, std::size_t offset, std::size_t size) {
               const std::uint32_t word = canary(place, round);
               std::memcpy(static_cast<char*>(target) + offset, &word, size);
             });
}

// Parts that overlap spoil each other, but never the last.
bool canariesLive(const void* target, std::size_t bytes, std::uint32_t round) {
  bool live = false;
  visitSpots(bytes, kCanaries, sizeof(std::uint32_t),
             [&](std::size_t place, std::size_t offset, std::size_t size) {
               const std::uint32_t word = canary(place, round);
               live |= std::memcmp(static_cast<const char*>(target) + offset, &word, size) == 0;
             });
  return live;
}

Held holdsBytes(const Buffer::Impl& buffer, const void* source, std::size_t bytes,
                std::size_t offset) {
  Held held = Held::kAll;
  visitSpots(bytes, bytes > kSpotBytes ? kSpots : 2, kSpotBytes,
             [&](std::size_t, std::size_t at, std::size_t size) {
               if (held != Held::kAll) return;
               std::array<char, kSpotBytes> found = {};
               plantCanaries(found.data(), size, 0);
               buffer.queue.enqueueReadBuffer(buffer.buffer, CL_TRUE, offset + at, size,
                                              found.data());
               if (std::memcmp(found.data(), static_cast<const char*>(source) + at, size) != 0)
                 held = canariesLive(found.data(), size, 0) ? Held::kUnread : Held::kOther;
             });
  return held;
}

void throwLostData(const Buffer::Impl& buffer, const std::string& what) {
  throw Error(fmt::format("the driver of '{}' lost data: {}", buffer.device_name, what),
              kExitNoDevice);
}

}  // namespace glintmark
