// What this program has OpenImageIO do, behind an interface that a module implements. Faults come
// back as sentences: exceptions of the module's own libraries stay in it.
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace glintmark {

/// One part of an image file, as its header says. Positions and sizes are in pixels.
struct StoredPart {
  std::string name;  // empty for files without parts
  std::vector<std::string> channel_names{};
  int x = 0, y = 0, width = 0, height = 0, depth = 1;           // the pixels that are stored
  int full_x = 0, full_y = 0, full_width = 0, full_height = 0;  // the picture that is meant
  int orientation = 1;                                          // one of the eight of TIFF and Exif
  float step = 0;  // between neighbouring values in [0, 1] of whole numbers; 0: floats
  bool deep = false;
  int band_rows = 1;  // that are best read at once, from the first on
  std::array<float, 3> luminance = {0.2126f, 0.7152f, 0.0722f};  // of red, green and blue
};

/// An image file that is open to be read.
class StoredImage {
 public:
  virtual ~StoredImage() = default;
  /// Parts, pages, frames and smaller copies by their number; nothing if there are not so many.
  virtual std::optional<StoredPart> part(int number) = 0;
  /// True for formats whose parts are pictures of their own, false for pages and smaller copies.
  virtual bool hasParts() const = 0;
  /// Channels [begin, end) of some rows of a part, from the top left, channels interleaved, into
  /// `pixels`, which holds width * rows * (end - begin) values. `first_row` is a multiple of the
  /// part's band_rows, and so is `rows`, but for the last. Empty, or what went wrong: also what the
  /// reader only warns of.
  virtual std::string read(int part, int begin, int end, int first_row, int rows,
                           std::span<float> pixels) = 0;
};

/// What a file says of itself beside its pixels: names and texts.
using PictureFacts = std::vector<std::pair<std::string, std::string>>;

/// An image to be written.
struct PixelBlock {
  int width = 0, height = 0;
  std::vector<std::string> channel_names;
  std::span<const float> floats{};         // an EXR of floats, or
  std::span<const unsigned char> bytes{};  // a PNG of sRGB, or
  // an EXR of floats that come in bands of `band_rows`, the last one shorter; each lives until the
  // next is asked for
  std::function<std::span<const float>(int first_row, int rows)> band{};
  int band_rows = 0;
  PictureFacts facts{};
};

/// Pixels [x, x + width) x [y, y + height), from the start of a line of text on its baseline.
struct InkBox {
  int x = 0, y = 0, width = 0, height = 0;
};

class ImageCodec {
 public:
  virtual ~ImageCodec() = default;
  /// Nothing, with the reason in `fault`, if the file is no image that OpenImageIO reads.
  virtual std::unique_ptr<StoredImage> open(const std::string& path, std::string& fault) const = 0;
  /// The same of a file in memory, of the format of that name ("openexr"). The bytes outlive it.
  virtual std::unique_ptr<StoredImage> open(const std::string& format, std::span<const char> bytes,
                                            std::string& fault) const = 0;
  /// The bytes of a file; none, with the reason in `fault`, if it cannot be encoded.
  virtual std::vector<unsigned char> encode(const PixelBlock& image, std::string& fault) const = 0;
  /// Where the ink of ASCII text lies, at `size_px` to the em; empty if the font cannot be used.
  virtual InkBox inkBox(const std::string& text, int size_px, const std::string& font) const = 0;
  /// Draws the text so that the box lies at the image's origin: shares of ink in [0, 1] for
  /// box.width * box.height pixels. Empty, or what went wrong.
  virtual std::string drawInk(const std::string& text, int size_px, const std::string& font,
                              const InkBox& box, std::span<float> ink) const = 0;
};

/// The one function of the module, and its type.
inline constexpr char kImageCodecSymbol[] = "glintmarkImageCodec";
using ImageCodecFunction = const ImageCodec*();

}  // namespace glintmark
