// What image files hold.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/free_memory.h"
#include "host/core/late_progress.h"
#include "host/report/picture/image_io.h"
#include "host/report/picture/image_layers.h"
#include "host/report/picture/load_codec.h"
#include "host/report/picture/misread_files.h"
#include "host/report/picture/tagged_files.h"

namespace glintmark {
namespace {

// Pixels per side that are read at all: more than any map or sky has.
constexpr int kMaxSide_px = 32768;
// Share of texels that must be unit normals for a layer to count as a map of them.
constexpr double kNormalShare = 0.95;
constexpr float kUnitDeviation = 0.2f;

// Readers say the same of every row that they miss.
std::string oneLine(std::string text) {
  constexpr std::size_t kMost_bytes = 400;
  if (text.size() > kMost_bytes) text = text.substr(0, kMost_bytes) + "...";
  std::ranges::replace(text, '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

/// An image file, or one in memory, open to be read.
class ImageSource {
 public:
  explicit ImageSource(const std::filesystem::path& file) : name_(file.string()) {
    checkHead(file);
    std::string fault;
    file_ = openImage(name_, {}, fault);
    if (!file_ && fault.find("could not find a format reader") != std::string::npos)
      fail("it is of no picture format that is read; save it as PNG, TIFF or EXR");
    requireFlat(fault);
  }
  ImageSource(std::string_view bytes, const std::string& name) : name_(name) {
    const char* format = bytes.starts_with("\xFF\xD8")  ? "jpeg"
                         : bytes.starts_with("\x89PNG") ? "png"
                                                        : "openexr";
    std::string fault;
    file_ = openImage(name_, {format, bytes}, fault);
    requireFlat(fault);
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(fmt::format("cannot read image {}: {}", name_, oneLine(reason)));
  }

  /// All parts of files that have parts; of pages, frames and smaller copies only the first.
  std::vector<ImageLayer> layers() {
    std::vector<ImageLayer> all;
    for (int number = 0; number == 0 || file_->hasParts(); ++number) {
      const std::optional<StoredPart> part = file_->part(number);
      if (!part) break;
      addLayers(all, number, part->name, part->channel_names);
    }
    return all;
  }

  /// Channels [begin, end) of a part as they lie in the file, then turned as a viewer shows them.
  Image read(int number, int begin, int end) {
    const StoredPart part = partOf(number);
    const int channels = end - begin;
    checkSize(part, channels);
    Image image;
    image.width = part.width, image.height = part.height, image.channels = channels;
    image.channel_names.assign(part.channel_names.begin() + begin,
                               part.channel_names.begin() + end);
    image.step = part.step;
    readBands(number, part, begin, end, image);
    if (webp_.has_alpha) requireOpaque(number, part);
    return turned(framed(std::move(image), part), part.orientation);
  }

  /// Pixels each way of what read() gives.
  glm::ivec2 size(int number) {
    const StoredPart part = partOf(number);
    checkSide(part);
    const bool is_framed = part.full_width > 0 && part.full_height > 0;
    const glm::ivec2 size = is_framed ? glm::ivec2(part.full_width, part.full_height)
                                      : glm::ivec2(part.width, part.height);
    return swapsSides(part.orientation) ? glm::ivec2(size.y, size.x) : size;
  }

  /// Of red, green and blue in a part's luminance.
  std::array<float, 3> luminances(int number) { return partOf(number).luminance; }

  int channelCount(int number) { return static_cast<int>(partOf(number).channel_names.size()); }

 private:
  void checkHead(const std::filesystem::path& path) {
    InputFile file(path);
    std::string head(kMisreadHead_bytes, '\0');
    head.resize(file.read(head.data(), head.size()));
    std::string fault = misreading(head, name_);
    if (fault.empty()) fault = misreadingTiff(path, head);
    if (!fault.empty()) fail(fault);
    webp_ = webpFacts(path, head);
  }

  /// OpenImageIO multiplies the colours of WebP files by alpha, whatever it is asked for.
  void requireOpaque(int number, const StoredPart& part) {
    const auto alpha = std::ranges::find(part.channel_names, "A");
    if (alpha == part.channel_names.end()) return;
    const auto channel = static_cast<int>(alpha - part.channel_names.begin());
    Image values;
    readBands(number, part, channel, channel + 1, values);
    if (std::ranges::any_of(values.pixels, [](float value) { return value < 1; }))
      fail("its WebP is transparent in places, which is read with wrong colours; save it as PNG");
  }

  void requireFlat(const std::string& fault) {
    if (!file_) fail(fault);
    const StoredPart first = partOf(0);
    if (first.depth > 1) fail("it has depth, expected a flat picture");
    if (first.deep) fail("it holds deep pixels, expected flat ones");
  }

  StoredPart partOf(int number) {
    std::optional<StoredPart> part = file_->part(number);
    if (!part) fail(fmt::format("it has no part {}", number));
    if (webp_.orientation != 1) part->orientation = webp_.orientation;
    return *part;
  }

  /// Stops at the first rows that cannot be read, before memory for the others is touched.
  void readBands(int number, const StoredPart& part, int begin, int end, Image& image) {
    LateProgress progress("image " + name_);
    const std::size_t row_values =
        static_cast<std::size_t>(part.width) * static_cast<std::size_t>(end - begin);
    image.pixels.reserve(row_values * static_cast<std::size_t>(part.height));
    for (int first = 0, rows = 0; first < part.height; first += rows) {
      rows = std::min(std::max(1, part.band_rows), part.height - first);
      const std::size_t done = image.pixels.size();
      image.pixels.resize(done + static_cast<std::size_t>(rows) * row_values);
      const std::string fault =
          file_->read(number, begin, end, first, rows, std::span(image.pixels).subspan(done));
      if (!fault.empty()) fail(fault);
      progress.show(first + rows, part.height);
    }
  }

  void checkSide(const StoredPart& part) const {
    const std::int64_t width = std::max(part.width, part.full_width);
    const std::int64_t height = std::max(part.height, part.full_height);
    if (part.width < 1 || part.height < 1 || width > kMaxSide_px || height > kMaxSide_px)
      fail(fmt::format("it has {}x{} pixels, expected 1 to {} each way", width, height,
                       kMaxSide_px));
  }

  void checkSize(const StoredPart& part, int channels) const {
    checkSide(part);
    const std::int64_t width = std::max(part.width, part.full_width);
    const std::int64_t height = std::max(part.height, part.full_height);
    // The pixels, and what the reader holds of them.
    requireMemory(static_cast<std::uint64_t>(width * height * channels) * (sizeof(float) + 4),
                  fmt::format("image {} of {}x{} pixels", name_, width, height));
  }

  /// The display window where the stored pixels cover another one; black where there are none.
  Image framed(Image image, const StoredPart& part) const {
    const bool whole = part.x == part.full_x && part.y == part.full_y &&
                       part.width == part.full_width && part.height == part.full_height;
    if (whole || part.full_width < 1 || part.full_height < 1) return image;
    Image frame(part.full_width, part.full_height, image.channels);
    frame.channel_names = image.channel_names;
    frame.step = image.step;
    for (int y = 0; y < frame.height; ++y)
      for (int x = 0; x < frame.width; ++x) {
        const int from_x = x + part.full_x - part.x, from_y = y + part.full_y - part.y;
        if (from_x < 0 || from_y < 0 || from_x >= image.width || from_y >= image.height) continue;
        std::ranges::copy(image.at(from_x, from_y), frame.at(x, y).begin());
      }
    return frame;
  }

  static bool swapsSides(int orientation) { return orientation > 4 && orientation <= 8; }

  /// By the eight orientations of TIFF and Exif.
  static Image turned(Image image, int orientation) {
    if (orientation < 2 || orientation > 8) return image;
    const bool swaps = swapsSides(orientation);
    Image out(swaps ? image.height : image.width, swaps ? image.width : image.height,
              image.channels);
    out.channel_names = image.channel_names;
    out.step = image.step;
    for (int y = 0; y < out.height; ++y)
      for (int x = 0; x < out.width; ++x) {
        int u = swaps ? y : x, v = swaps ? x : y;
        if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8)
          u = image.width - 1 - u;
        if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7)
          v = image.height - 1 - v;
        std::ranges::copy(image.at(u, v), out.at(x, y).begin());
      }
    return out;
  }

  std::string name_;
  WebpFacts webp_;
  std::unique_ptr<StoredImage> file_;
};

bool isLuminanceChroma(const ImageLayer& layer, const std::vector<int>& wanted) {
  return wanted.size() == 3 && (layer.names[wanted[1]] == "RY" || layer.names[wanted[1]] == "ry");
}

/// Y, (R - Y) / Y and (B - Y) / Y as red, green and blue, of which Y has so much each. [OpenEXR,
/// "Technical Introduction"]
Image toColours(const Image& all, const ImageLayer& layer, const std::vector<int>& wanted,
                int begin, const std::array<float, 3>& luminances) {
  Image rgb(all.width, all.height, 3);
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x) {
      const auto value = [&](int i) { return all.at(x, y)[layer.channels[wanted[i]] - begin]; };
      const float luminance = value(0), red = (value(1) + 1) * luminance,
                  blue = (value(2) + 1) * luminance;
      const auto out = rgb.at(x, y);
      out[0] = red;
      out[1] = (luminance - luminances[0] * red - luminances[2] * blue) / luminances[1];
      out[2] = blue;
    }
  rgb.channel_names = {"R", "G", "B"};
  return rgb;
}

/// The channels of a layer that its use wants.
Image readLayer(ImageSource& source, const ImageLayer& layer, ImageUse use) {
  const std::vector<int> wanted = channelsFor(layer, use);
  int begin = layer.channels[wanted[0]], end = begin + 1;
  for (const int i : wanted) {
    begin = std::min(begin, layer.channels[i]);
    end = std::max(end, layer.channels[i] + 1);
  }
  Image all = source.read(layer.part, begin, end);
  if (isLuminanceChroma(layer, wanted))
    return toColours(all, layer, wanted, begin, source.luminances(layer.part));
  bool in_order = all.channels == static_cast<int>(wanted.size());
  for (std::size_t c = 0; c < wanted.size(); ++c)
    in_order = in_order && layer.channels[wanted[c]] == begin + static_cast<int>(c);
  if (in_order) return all;
  Image image(all.width, all.height, static_cast<int>(wanted.size()));
  image.step = all.step;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (std::size_t c = 0; c < wanted.size(); ++c)
        image.at(x, y)[c] = all.at(x, y)[layer.channels[wanted[c]] - begin];
  for (const int i : wanted) image.channel_names.push_back(layer.names[i]);
  return image;
}

bool holdsNormals(const Image& image) {
  if (image.channels < 3) return false;
  std::size_t stored = 0, coded = 0;
  const std::size_t texels = image.pixels.size() / static_cast<std::size_t>(image.channels);
  const auto fits = [](float x, float y, float z) {
    return z >= 0 && std::abs(std::hypot(x, y, z) - 1) < kUnitDeviation;
  };
  for (std::size_t i = 0; i < texels; ++i) {
    const float* n = image.pixels.data() + i * static_cast<std::size_t>(image.channels);
    stored += fits(n[0], n[1], n[2]);
    coded += fits(2 * n[0] - 1, 2 * n[1] - 1, 2 * n[2] - 1);
  }
  return static_cast<double>(std::max(stored, coded)) >= kNormalShare * static_cast<double>(texels);
}

std::string listOf(const std::vector<ImageLayer>& layers) {
  std::vector<std::string> names;
  for (const ImageLayer& layer : layers) {
    const std::string name = layer.name().empty() ? "(no name)" : layer.name();
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

// The layers that may be meant, one at least.
std::vector<const ImageLayer*> meantLayers(const ImageSource& source,
                                           const std::vector<ImageLayer>& layers, ImageUse use,
                                           const std::string& wanted) {
  const std::vector<const ImageLayer*> found = candidatesFor(layers, use, wanted);
  if (found.empty())
    source.fail(wanted.empty() ? std::string("it has no channels to be used")
                               : fmt::format("it has no layer '{}', its layers are {}", wanted,
                                             listOf(layers)));
  return found;
}

Image readFor(ImageSource& source, ImageUse use, const std::string& wanted) {
  const std::vector<ImageLayer> layers = source.layers();
  const std::vector<const ImageLayer*> found = meantLayers(source, layers, use, wanted);
  if (found.size() == 1) return readLayer(source, *found[0], use);
  // Several may be meant: the one that holds unit normals, if that is what is looked for.
  std::vector<const ImageLayer*> normals;
  for (const ImageLayer* layer : found)
    if (use == ImageUse::kNormals && holdsNormals(readLayer(source, *layer, use)))
      normals.push_back(layer);
  if (normals.size() == 1) return readLayer(source, *normals[0], use);
  source.fail(
      fmt::format("which of its layers is meant is not clear; write #NAME after the file's name, "
                  "its layers are {}",
                  listOf(layers)));
}

/// A path with the layer that follows a '#', unless a file has that very name.
std::pair<std::filesystem::path, std::string> splitLayer(const std::filesystem::path& path) {
  const std::string text = path.string();
  const std::size_t hash = text.rfind('#');
  std::error_code error;
  if (hash == std::string::npos || std::filesystem::exists(path, error)) return {path, ""};
  return {text.substr(0, hash), text.substr(hash + 1)};
}

Image readFileFor(const std::filesystem::path& path, ImageUse use) {
  const auto [file, layer] = splitLayer(path);
  ImageSource source(file);
  return readFor(source, use, layer);
}

}  // namespace

Image readImage(const std::filesystem::path& path) {
  ImageSource source(path);
  return source.read(0, 0, source.channelCount(0));
}

Image readColours(const std::filesystem::path& path) {
  Image image = readFileFor(path, ImageUse::kColour);
  if (image.channels >= 3) return image;
  Image rgb(image.width, image.height, 3);
  for (std::size_t i = 0; i < rgb.pixels.size(); ++i)
    rgb.pixels[i] = image.pixels[i / 3 * static_cast<std::size_t>(image.channels)];
  rgb.step = image.step;
  return rgb;
}

Image readNormals(const std::filesystem::path& path) {
  return readFileFor(path, ImageUse::kNormals);
}

glm::ivec2 normalsSize(const std::filesystem::path& path) {
  const auto [file, layer] = splitLayer(path);
  ImageSource source(file);
  const std::vector<ImageLayer> layers = source.layers();
  return source.size(meantLayers(source, layers, ImageUse::kNormals, layer).front()->part);
}

Image decodeNormals(std::string_view bytes, const std::string& name) {
  ImageSource source(bytes, name);
  return readFor(source, ImageUse::kNormals, "");
}

}  // namespace glintmark
