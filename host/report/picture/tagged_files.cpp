#include "host/report/picture/tagged_files.h"

#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <utility>

#include "host/core/atomic_file.h"
#include "host/report/picture/little_endian.h"

namespace glintmark {
namespace {

// The first directory of a TIFF file, or of the Exif block of another. [TIFF 6.0, Sect. 2]
class TiffDirectory {
 public:
  // Bytes [at, at + count) of the file; fewer where it ends.
  using Read = std::function<std::string(std::uint64_t at, std::size_t count)>;

  explicit TiffDirectory(Read read) : read_(std::move(read)) {
    const std::string head = read_(0, 16);
    if (head.size() < 8) return;
    is_big_endian_ = head.starts_with("MM");
    const std::uint64_t magic = number(head, 2, 2);
    if ((!is_big_endian_ && !head.starts_with("II")) || (magic != kClassic && magic != kBig))
      return;
    is_big_ = magic == kBig;
    if (is_big_ && head.size() < 16) return;
    start_ = is_big_ ? number(head, 8, 8) : number(head, 4, 4);
  }

  bool isThere() const { return start_ != 0; }

  // A tag's first value of 16 bits; nothing if it has none.
  std::optional<std::uint64_t> shortOf(std::uint64_t tag) const {
    const std::size_t count_bytes = is_big_ ? 8 : 2, entry_bytes = is_big_ ? 20 : 12;
    const std::string counted = read_(start_, count_bytes);
    if (counted.size() < count_bytes) return std::nullopt;
    const std::uint64_t entries = number(counted, 0, count_bytes);
    for (std::uint64_t i = 0; i < entries && i < kMostEntries; ++i) {
      const std::string entry = read_(start_ + count_bytes + i * entry_bytes, entry_bytes);
      if (entry.size() < entry_bytes) return std::nullopt;
      if (number(entry, 0, 2) == tag) return number(entry, is_big_ ? 12 : 8, 2);
    }
    return std::nullopt;
  }

 private:
  static constexpr std::uint64_t kClassic = 42, kBig = 43, kMostEntries = 4096;

  std::uint64_t number(const std::string& bytes, std::size_t at, std::size_t count) const {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
      value =
          value << 8 | static_cast<unsigned char>(bytes[at + (is_big_endian_ ? i : count - 1 - i)]);
    return value;
  }

  Read read_;
  bool is_big_endian_ = false, is_big_ = false;
  std::uint64_t start_ = 0;
};

int exifOrientation(std::string_view exif) {
  constexpr std::string_view kJpegMark("Exif\0\0", 6);  // some writers keep it
  constexpr std::uint64_t kOrientation = 274;
  if (exif.starts_with(kJpegMark)) exif.remove_prefix(kJpegMark.size());
  const TiffDirectory directory([exif](std::uint64_t at, std::size_t count) {
    return at < exif.size() ? std::string(exif.substr(at, count)) : std::string();
  });
  if (!directory.isThere()) return 1;
  const std::uint64_t orientation = directory.shortOf(kOrientation).value_or(1);
  return orientation >= 1 && orientation <= 8 ? static_cast<int>(orientation) : 1;
}

// The content of a chunk of a RIFF file; empty if it has none.
std::string_view riffChunk(std::string_view file, std::string_view name) {
  constexpr std::size_t kHead_bytes = 8;
  for (std::size_t at = 12; file.size() >= at + kHead_bytes;) {
    const std::uint64_t size = littleEndian(file, at + 4, 4);
    if (file.substr(at, 4) == name) return file.substr(at + kHead_bytes, size);
    at += kHead_bytes + size + size % 2;
  }
  return {};
}

}  // namespace

std::string misreadingTiff(const std::filesystem::path& path, std::string_view head) {
  constexpr std::uint64_t kBitsPerSample = 258;
  if (!head.starts_with("II") && !head.starts_with("MM")) return {};
  std::ifstream file(path, std::ios::binary);
  const TiffDirectory directory([&file](std::uint64_t at, std::size_t count) {
    std::string bytes(count, '\0');
    file.clear();
    file.seekg(static_cast<std::streamoff>(at));
    file.read(bytes.data(), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
  });
  if (!directory.isThere() || directory.shortOf(kBitsPerSample)) return {};
  return "its TIFF does not say how many bits a sample has, and is misread; save it as PNG";
}

WebpFacts webpFacts(const std::filesystem::path& path, std::string_view head) {
  constexpr std::size_t kFlags = 20, kLosslessBits = 21;
  constexpr unsigned kExif = 0x08, kAlpha = 0x10;
  constexpr std::uint64_t kLosslessAlpha = 1u << 28;
  WebpFacts facts;
  if (!head.starts_with("RIFF") || head.size() < 25 || head.substr(8, 4) != "WEBP") return facts;
  const std::string_view kind = head.substr(12, 4);
  if (kind == "VP8L")
    facts.has_alpha = (littleEndian(head, kLosslessBits, 4) & kLosslessAlpha) != 0;
  if (kind != "VP8X") return facts;
  const auto flags = static_cast<unsigned char>(head[kFlags]);
  facts.has_alpha = (flags & kAlpha) != 0;
  if ((flags & kExif) != 0) facts.orientation = exifOrientation(riffChunk(readFile(path), "EXIF"));
  return facts;
}

}  // namespace glintmark
