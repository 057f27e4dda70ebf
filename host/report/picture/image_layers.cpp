#include "host/report/picture/image_layers.h"

#include <algorithm>
#include <cctype>

namespace glintmark {
namespace {

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string lastPart(const std::string& name) {
  const std::size_t point = name.rfind('.');
  return point == std::string::npos ? name : name.substr(point + 1);
}

int find(const ImageLayer& layer, std::initializer_list<const char*> names) {
  for (const char* name : names)
    for (std::size_t i = 0; i < layer.names.size(); ++i)
      if (lower(layer.names[i]) == name) return static_cast<int>(i);
  return -1;
}

bool isBeside(const std::string& name) {
  const std::string n = lower(name);
  return n == "a" || n == "alpha" || n == "ar" || n == "ag" || n == "ab" || n == "id" ||
         n == "zback";
}

/// How much a layer's names say that it is what the use wants; higher is more.
int fitOf(const ImageLayer& layer, ImageUse use) {
  const std::string name = lower(layer.name());
  const auto says = [&](std::initializer_list<const char*> words) {
    return std::ranges::any_of(words,
                               [&](const char* w) { return name.find(w) != std::string::npos; });
  };
  const bool has_xyz = find(layer, {"x", "nx"}) >= 0 && find(layer, {"y", "ny"}) >= 0;
  const bool has_rgb = find(layer, {"r", "red"}) >= 0 && find(layer, {"g", "green"}) >= 0;
  if (use == ImageUse::kNormals) {
    if (says({"normal", "nrm", "bump"}) && !says({"position"})) return 3;
    if (name == "n" || (has_xyz && !says({"position", "vector", "motion", "uv"}))) return 2;
    return says({"combined", "beauty", "rgba", "diffuse", "albedo", "depth"}) ? 0 : 1;
  }
  if (layer.prefix.empty() && has_rgb && layer.part == 0) return 4;
  if (says({"combined", "beauty", "rgba", "colour", "color"})) return 3;
  return has_rgb ? 2 : 1;
}

}  // namespace

std::string ImageLayer::name() const {
  if (part_name.empty()) return prefix;
  return prefix.empty() || prefix == part_name ? part_name : part_name + "." + prefix;
}

void addLayers(std::vector<ImageLayer>& layers, int part, const std::string& part_name,
               const std::vector<std::string>& channel_names) {
  const std::size_t first = layers.size();
  for (std::size_t i = 0; i < channel_names.size(); ++i) {
    const std::string& name = channel_names[i];
    const std::string own = lastPart(name);
    const std::string prefix =
        own.size() == name.size() ? "" : name.substr(0, name.size() - own.size() - 1);
    auto layer = std::find_if(layers.begin() + static_cast<std::ptrdiff_t>(first), layers.end(),
                              [&](const ImageLayer& l) { return l.prefix == prefix; });
    if (layer == layers.end())
      layer = layers.insert(layers.end(), ImageLayer{part, part_name, prefix, {}, {}});
    layer->channels.push_back(static_cast<int>(i));
    layer->names.push_back(own);
  }
}

std::vector<int> channelsFor(const ImageLayer& layer, ImageUse use) {
  const std::vector<int> rgb = {find(layer, {"r", "red"}), find(layer, {"g", "green"}),
                                find(layer, {"b", "blue"})};
  const std::vector<int> xyz = {find(layer, {"x", "nx"}), find(layer, {"y", "ny"}),
                                find(layer, {"z", "nz"})};
  const auto whole = [](const std::vector<int>& c) {
    return std::ranges::all_of(c, [](int i) { return i >= 0; });
  };
  const std::vector<int> chroma = {find(layer, {"y"}), find(layer, {"ry"}), find(layer, {"by"})};
  if (whole(chroma)) return chroma;
  const std::vector<int>& first = use == ImageUse::kNormals ? xyz : rgb;
  const std::vector<int>& second = use == ImageUse::kNormals ? rgb : xyz;
  if (whole(first)) return first;
  if (whole(second)) return second;
  for (const std::vector<int>& pair : {xyz, rgb})
    if (use == ImageUse::kNormals && pair[0] >= 0 && pair[1] >= 0) return {pair[0], pair[1]};
  std::vector<int> others;
  for (std::size_t i = 0; i < layer.names.size(); ++i)
    if (!isBeside(layer.names[i])) others.push_back(static_cast<int>(i));
  if (others.size() > 3) others.resize(3);
  if (use == ImageUse::kColour && others.size() == 2) others.resize(1);
  return others;
}

std::vector<const ImageLayer*> candidatesFor(const std::vector<ImageLayer>& layers, ImageUse use,
                                             const std::string& wanted) {
  std::vector<const ImageLayer*> found;
  int best = -1;
  for (const ImageLayer& layer : layers) {
    if (channelsFor(layer, use).empty()) continue;
    int fit = fitOf(layer, use);
    if (!wanted.empty()) {
      const std::string name = lower(wanted);
      const bool whole = name == lower(layer.name()) || name == lower(layer.prefix);
      const bool part = name == lower(layer.part_name) || name == lower(lastPart(layer.prefix));
      if (!whole && !part) continue;
      fit += whole ? 10 : 0;
    }
    if (fit > best) found.clear();
    best = std::max(best, fit);
    if (fit == best) found.push_back(&layer);
  }
  return found;
}

}  // namespace glintmark
