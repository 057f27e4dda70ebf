// Which channels of an image file are meant: parts and layers have names, and channels too.
#pragma once
#include <string>
#include <vector>

namespace glintmark {

/// Channels of one part of a file that share a name up to the last point.
struct ImageLayer {
  int part = 0;
  std::string part_name;           // empty for files without parts
  std::string prefix;              // "ViewLayer.Normal" of "ViewLayer.Normal.X"
  std::vector<int> channels;       // in the part
  std::vector<std::string> names;  // of the channels, without the prefix

  /// As `#name` after a file asks for it and messages list it.
  std::string name() const;
};

/// What an image is read for.
enum class ImageUse { kColour, kNormals };

/// Appends the layers of a part with those channels.
void addLayers(std::vector<ImageLayer>& layers, int part, const std::string& part_name,
               const std::vector<std::string>& channel_names);

/// The positions in layer.channels of what an image for that use holds, in order: red, green, blue
/// or x, y, z; of two channels, x and y; of one, heights or greys. Alpha and depth are left out
/// where others are. Empty if the layer has nothing of the kind.
std::vector<int> channelsFor(const ImageLayer& layer, ImageUse use);

/// The layers called `wanted` (part, prefix, both, or the prefix's last part; case does not
/// matter); without a name all that the use may mean, from those that their names speak for most,
/// as far as they tie.
std::vector<const ImageLayer*> candidatesFor(const std::vector<ImageLayer>& layers, ImageUse use,
                                             const std::string& wanted);

}  // namespace glintmark
