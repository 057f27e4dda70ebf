#include "host/codec/image_codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <utility>

#include "host/codec/exr_image.h"

namespace glintmark {
namespace {

class OpenedImage : public StoredImage {
 public:
  // A null `input` is refused by whoever opens it.
  OpenedImage(std::unique_ptr<OIIO::Filesystem::IOMemReader> memory,
              std::unique_ptr<OIIO::ImageInput> input)
      : memory_(std::move(memory)), input_(std::move(input)) {}

  std::optional<StoredPart> part(int number) override {
    const bool there = number == 0 || input_->seek_subimage(number, 0);
    if (!there) {
      OIIO::geterror();
      input_->geterror();
      return std::nullopt;
    }
    const OIIO::ImageSpec spec = input_->spec(number, 0);
    StoredPart part{.name = std::string(spec.get_string_attribute("oiio:subimagename")),
                    .channel_names = spec.channelnames};
    std::tie(part.x, part.y, part.width, part.height, part.depth) =
        std::tie(spec.x, spec.y, spec.width, spec.height, spec.depth);
    std::tie(part.full_x, part.full_y, part.full_width, part.full_height) =
        std::tie(spec.full_x, spec.full_y, spec.full_width, spec.full_height);
    if (!hasParts() && !coversData(part)) useDataAsPicture(part);
    part.orientation = orientationOf(spec);
    if (spec.format == OIIO::TypeDesc::UINT8) part.step = 1.0f / 255;
    if (spec.format == OIIO::TypeDesc::UINT16) part.step = 1.0f / 65535;
    part.deep = spec.deep;
    part.band_rows = bandRows(spec);
    return part;
  }

  bool hasParts() const override { return std::string_view(input_->format_name()) == "openexr"; }

  std::string read(int part, int begin, int end, int first_row, int rows,
                   std::span<float> pixels) override {
    const OIIO::ImageSpec spec = input_->spec(part, 0);
    const int first = spec.y + first_row, last = first + rows;
    const bool read = spec.tile_width > 0
                          ? input_->read_tiles(part, 0, spec.x, spec.x + spec.width, first, last,
                                               spec.z, spec.z + spec.depth, begin, end,
                                               OIIO::TypeDesc::FLOAT, pixels.data())
                          : input_->read_scanlines(part, 0, first, last, spec.z, begin, end,
                                                   OIIO::TypeDesc::FLOAT, pixels.data());
    // Some readers go on after what they only warn of, with pixels that are not the file's.
    if (read && !input_->has_error()) return {};
    const std::string fault = input_->geterror();
    return fault.empty() ? "its pixels cannot be read" : fault;
  }

 private:
  // Whole tiles, and whole blocks of every compression of EXR, of some megabytes.
  static int bandRows(const OIIO::ImageSpec& spec) {
    constexpr std::uint64_t kBand_bytes = std::uint64_t{16} << 20;
    constexpr std::uint64_t kBlockRows = 256;
    const std::uint64_t step =
        spec.tile_width > 0 ? std::max<std::uint64_t>(1, spec.tile_height) : kBlockRows;
    const std::uint64_t row_bytes = std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(spec.width) * spec.channelnames.size() * sizeof(float));
    const std::uint64_t steps = std::max<std::uint64_t>(1, kBand_bytes / row_bytes / step);
    return static_cast<int>(std::min<std::uint64_t>(steps * step, 1u << 30));
  }

  // Positions on a page, which PNG and TIFF know, are no windows.
  static bool coversData(const StoredPart& part) {
    return part.x >= part.full_x && part.y >= part.full_y &&
           part.x + part.width <= part.full_x + part.full_width &&
           part.y + part.height <= part.full_y + part.full_height;
  }
  static void useDataAsPicture(StoredPart& part) {
    part.full_x = part.x, part.full_y = part.y;
    part.full_width = part.width, part.full_height = part.height;
  }

  // OpenImageIO takes the two quarter turns of Radiance files for each other: "+X M +Y N" is a
  // picture that lies turned clockwise. [Ward, "Radiance File Formats"]
  int orientationOf(const OIIO::ImageSpec& spec) const {
    constexpr int kClockwise = 6, kCounterClockwise = 8;
    const int orientation = spec.get_int_attribute("Orientation", 1);
    if (std::string_view(input_->format_name()) != "hdr") return orientation;
    if (orientation == kClockwise) return kCounterClockwise;
    return orientation == kCounterClockwise ? kClockwise : orientation;
  }

  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory_;  // outlives its reader
  std::unique_ptr<OIIO::ImageInput> input_;
};

// Colours that alpha has not multiplied stay as they are: normals and heights keep their values.
OIIO::ImageSpec readingHints() {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  return hints;
}

bool writeBands(OIIO::ImageOutput& output, const PixelBlock& image) {
  for (int y = 0; y < image.height; y += image.band_rows) {
    const int end = std::min(image.height, y + image.band_rows);
    if (!output.write_scanlines(y, end, 0, OIIO::TypeDesc::FLOAT, image.band(y, end - y).data()))
      return false;
  }
  return true;
}

class OpenImageIoCodec : public ImageCodec {
 public:
  std::unique_ptr<StoredImage> open(const std::string& path, std::string& fault) const override {
    if (auto sampled = openSampledExr(path)) return sampled;
    OIIO::geterror();
    const OIIO::ImageSpec hints = readingHints();
    auto input = OIIO::ImageInput::open(path, &hints);
    if (!input) {
      fault = OIIO::geterror();
      return nullptr;
    }
    return std::make_unique<OpenedImage>(nullptr, std::move(input));
  }

  std::unique_ptr<StoredImage> open(const std::string& format, std::span<const char> bytes,
                                    std::string& fault) const override {
    OIIO::geterror();
    auto memory = std::make_unique<OIIO::Filesystem::IOMemReader>(bytes.data(), bytes.size());
    auto input = OIIO::ImageInput::create(format);
    OIIO::ImageSpec found;
    if (!input) {
      fault = OIIO::geterror();
    } else if (input->set_ioproxy(memory.get()) &&
               input->open("memory." + format, found, readingHints())) {
      return std::make_unique<OpenedImage>(std::move(memory), std::move(input));
    } else {
      fault = input->geterror();
    }
    return nullptr;
  }

  // In memory, for the caller to write: OpenImageIO does not report every failed write of a PNG.
  std::vector<unsigned char> encode(const PixelBlock& image, std::string& fault) const override {
    const bool is_png = !image.bytes.empty();
    const std::string format = is_png ? "png" : "openexr";
    auto output = OIIO::ImageOutput::create(format);
    if (!output) {
      fault = "this OpenImageIO has no " + format + " support";
      return {};
    }
    const OIIO::TypeDesc type = is_png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
    OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channel_names.size()),
                         type);
    if (is_png) {
      spec.attribute("oiio:ColorSpace", "sRGB");
    } else {
      spec.channelnames = image.channel_names;
      spec.attribute("compression", "zip");
    }
    for (const auto& [name, text] : image.facts) spec.attribute(name, text);
    const void* pixels = is_png ? static_cast<const void*>(image.bytes.data())
                                : static_cast<const void*>(image.floats.data());
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const bool encoded =
        output->set_ioproxy(&memory) && output->open(is_png ? "memory.png" : "memory.exr", spec) &&
        (image.band ? writeBands(*output, image) : output->write_image(type, pixels)) &&
        output->close();
    if (encoded) return bytes;
    fault = output->geterror();
    return {};
  }

  InkBox inkBox(const std::string& text, int size_px, const std::string& font) const override {
    const OIIO::ROI box = OIIO::ImageBufAlgo::text_size(text, size_px, font);
    if (!box.defined() || box.width() <= 0 || box.height() <= 0) return {};
    return {box.xbegin, box.ybegin, box.width(), box.height()};
  }

  std::string drawInk(const std::string& text, int size_px, const std::string& font,
                      const InkBox& box, std::span<float> ink) const override {
    const OIIO::ImageSpec spec(box.width, box.height, 1, OIIO::TypeDesc::FLOAT);
    OIIO::ImageBuf drawn(spec, ink.data());
    OIIO::ImageBufAlgo::zero(drawn);
    const float full = 1;
    const bool done =
        OIIO::ImageBufAlgo::render_text(drawn, -box.x, -box.y, text, size_px, font, full);
    return done ? std::string() : drawn.geterror();
  }
};

}  // namespace
}  // namespace glintmark

extern "C" __attribute__((visibility("default"))) const glintmark::ImageCodec*
glintmarkImageCodec() {
  static const glintmark::OpenImageIoCodec codec;
  return &codec;
}
