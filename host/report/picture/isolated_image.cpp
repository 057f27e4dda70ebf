#include "host/report/picture/isolated_image.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <functional>
#include <new>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "host/core/atomic_file.h"
#include "host/core/child_process.h"
#include "host/core/error.h"
#include "host/core/free_memory.h"

namespace glintmark {
namespace {

// What reading may take before it counts as stuck.
constexpr double kLeast_s = 60, kPerByte_s = 1e-5, kWallOverCpu = 10;

enum class Question : std::uint8_t { kPart, kHasParts, kRead };

struct Request {
  Question question = Question::kHasParts;
  int part = 0, begin = 0, end = 0, first_row = 0, rows = 0;
  std::uint64_t values = 0;
};

// The numbers of a StoredPart, as they travel.
struct PartNumbers {
  bool is_there = false, deep = false;
  int x = 0, y = 0, width = 0, height = 0, depth = 1;
  int full_x = 0, full_y = 0, full_width = 0, full_height = 0, orientation = 1, band_rows = 1;
  float step = 0;
  std::array<float, 3> luminance{};
  std::uint64_t channels = 0;
};

/// The child's end of the channel.
class Answers {
 public:
  explicit Answers(int channel) : channel_(channel) {}

  void send(const void* bytes, std::size_t count) const {
    writeAll(channel_, {static_cast<const char*>(bytes), count}, "a process");
  }
  void sendText(const std::string& text) const {
    const std::uint64_t count = text.size();
    send(&count, sizeof count);
    send(text.data(), count);
  }
  bool next(Request& request) const {
    std::size_t done = 0;
    while (done < sizeof request) {
      const ssize_t got =
          ::read(channel_, reinterpret_cast<char*>(&request) + done, sizeof request - done);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      done += static_cast<std::size_t>(got);
    }
    return true;
  }

  void sendPart(const std::optional<StoredPart>& part) const {
    PartNumbers n;
    if (part)
      n = {true,
           part->deep,
           part->x,
           part->y,
           part->width,
           part->height,
           part->depth,
           part->full_x,
           part->full_y,
           part->full_width,
           part->full_height,
           part->orientation,
           part->band_rows,
           part->step,
           part->luminance,
           part->channel_names.size()};
    send(&n, sizeof n);
    if (!part) return;
    sendText(part->name);
    for (const std::string& channel : part->channel_names) sendText(channel);
  }

  void sendPixels(StoredImage& image, const Request& request) const {
    std::vector<float> pixels;
    std::string fault;
    try {
      pixels.resize(request.values);
      fault = image.read(request.part, request.begin, request.end, request.first_row, request.rows,
                         pixels);
    } catch (const std::bad_alloc&) {
      fault = "it needs more memory than is free";
    }
    sendText(fault);
    if (fault.empty()) send(pixels.data(), pixels.size() * sizeof(float));
  }

 private:
  int channel_;
};

void answer(int channel, const std::function<std::unique_ptr<StoredImage>(std::string&)>& open) {
  const Answers answers(channel);
  std::string fault;
  std::unique_ptr<StoredImage> image;
  try {
    image = open(fault);
  } catch (const std::bad_alloc&) {
    fault = "it needs more memory than is free";
  }
  const bool is_open = image != nullptr;
  answers.send(&is_open, sizeof is_open);
  answers.sendText(fault);
  if (!is_open) return;
  for (Request request; answers.next(request);) {
    if (request.question == Question::kPart) answers.sendPart(image->part(request.part));
    if (request.question == Question::kRead) answers.sendPixels(*image, request);
    if (request.question != Question::kHasParts) continue;
    const bool has_parts = image->hasParts();
    answers.send(&has_parts, sizeof has_parts);
  }
}

class IsolatedImage : public StoredImage {
 public:
  IsolatedImage(std::string name, const ChildLimits& limits,
                const std::function<std::unique_ptr<StoredImage>(std::string&)>& open)
      : name_(std::move(name)), child_([&](int channel) { answer(channel, open); }, limits) {}

  bool isOpen(std::string& fault) {
    bool is_open = false;
    receive(&is_open, sizeof is_open);
    fault = receiveText();
    return is_open;
  }

  std::optional<StoredPart> part(int number) override {
    ask({.question = Question::kPart, .part = number});
    PartNumbers n;
    receive(&n, sizeof n);
    if (!n.is_there) return std::nullopt;
    StoredPart part{.name = receiveText()};
    for (std::uint64_t i = 0; i < n.channels; ++i) part.channel_names.push_back(receiveText());
    part.x = n.x, part.y = n.y, part.width = n.width, part.height = n.height, part.depth = n.depth;
    part.full_x = n.full_x, part.full_y = n.full_y;
    part.full_width = n.full_width, part.full_height = n.full_height;
    part.orientation = n.orientation, part.band_rows = n.band_rows, part.step = n.step;
    part.deep = n.deep, part.luminance = n.luminance;
    return part;
  }

  bool hasParts() const override {
    ask({.question = Question::kHasParts});
    bool has_parts = false;
    receive(&has_parts, sizeof has_parts);
    return has_parts;
  }

  std::string read(int part, int begin, int end, int first_row, int rows,
                   std::span<float> pixels) override {
    ask({Question::kRead, part, begin, end, first_row, rows, pixels.size()});
    std::string fault = receiveText();
    if (fault.empty()) receive(pixels.data(), pixels.size() * sizeof(float));
    return fault;
  }

 private:
  void ask(const Request& request) const {
    if (!child_.write(&request, sizeof request)) fail();
  }

  void receive(void* bytes, std::size_t count) const {
    if (child_.read(bytes, count) != count) fail();
  }

  std::string receiveText() const {
    std::uint64_t count = 0;
    receive(&count, sizeof count);
    std::string text(count, '\0');
    receive(text.data(), count);
    return text;
  }

  [[noreturn]] void fail() const {
    const std::string end = child_.finish();
    throw Error(
        fmt::format("cannot read image {}: the library that reads it {}; the file is "
                    "damaged or of a kind that it does not know",
                    name_, end.empty() ? "ended early" : end));
  }

  std::string name_;
  mutable ChildProcess child_;
};

}  // namespace

std::unique_ptr<StoredImage> openIsolated(const ImageCodec& codec, const std::string& name,
                                          const ImageInMemory& memory, std::string& fault) {
  const bool is_file = memory.format.empty();
  const auto open = [&](std::string& reason) {
    return is_file ? codec.open(name, reason) : codec.open(memory.format, memory.bytes, reason);
  };
  const std::uint64_t size = is_file ? InputFile(name).sizeBytes() : memory.bytes.size();
  const double cpu_s = kLeast_s + static_cast<double>(size) * kPerByte_s;
  auto image = std::make_unique<IsolatedImage>(
      name,
      ChildLimits{
          .cpu_s = cpu_s, .wall_s = kWallOverCpu * cpu_s, .memory_bytes = freeMemoryBytes()},
      open);
  if (!image->isOpen(fault)) return nullptr;
  return image;
}

}  // namespace glintmark
