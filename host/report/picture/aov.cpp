#include "host/report/picture/aov.h"

#include <fmt/format.h>

#include <cstdint>
#include <functional>

#include "host/core/error.h"
#include "host/core/frame_packing.h"
#include "host/core/free_memory.h"

namespace glintmark {
namespace {

constexpr double kFractionScale = 1.0 / 4294967296.0;  // uv fractions are in units of 2^-32

// Writes the channels of one source for the pixel of list entry `entry`, from out[0] on.
struct Source {
  std::vector<std::string> channels;
  std::function<void(std::size_t entry, float* out)> write;
};

void addFloat(std::vector<Source>& sources, const PixelPlanes& planes, Plane plane,
              const char* name) {
  if (!planes.mask.has(plane)) return;
  const auto values = planes.plane<float>(plane);
  sources.push_back({{name}, [values](std::size_t i, float* out) { *out = values[i]; }});
}

void addInteger(std::vector<Source>& sources, const PixelPlanes& planes, Plane plane,
                const char* name) {
  if (!planes.mask.has(plane)) return;
  const auto values = planes.plane<std::int32_t>(plane);
  sources.push_back(
      {{name}, [values](std::size_t i, float* out) { *out = static_cast<float>(values[i]); }});
}

void addFraction(std::vector<Source>& sources, const PixelPlanes& planes, Plane plane,
                 const char* name) {
  if (!planes.mask.has(plane)) return;
  const auto values = planes.plane(plane);
  sources.push_back({{name}, [values](std::size_t i, float* out) {
                       *out = static_cast<float>(values[i] * kFractionScale);
                     }});
}

// A whole coordinate, as exact as a float is; both parts stand in channels of their own.
void addCoordinate(std::vector<Source>& sources, const PixelPlanes& planes, Plane whole,
                   Plane fraction, const char* name) {
  if (!planes.mask.has(whole) || !planes.mask.has(fraction)) return;
  const auto integers = planes.plane<std::int32_t>(whole);
  const auto fractions = planes.plane(fraction);
  sources.push_back({{name}, [integers, fractions](std::size_t i, float* out) {
                       *out = static_cast<float>(integers[i] + fractions[i] * kFractionScale);
                     }});
}

void addFrame(std::vector<Source>& sources, const PixelPlanes& planes) {
  if (!planes.mask.has(Plane::kFrame0) || !planes.mask.has(Plane::kFrame1)) return;
  const auto frame0 = planes.plane(Plane::kFrame0), frame1 = planes.plane(Plane::kFrame1);
  sources.push_back(
      {{"N.X", "N.Y", "N.Z", "T.X", "T.Y", "T.Z"}, [frame0, frame1](std::size_t i, float* out) {
         const ShadingFrame frame = unpackFrame({frame0[i], frame1[i]});
         for (int c = 0; c < 3; ++c) {
           out[c] = static_cast<float>(frame.normal[c]);
           out[3 + c] = static_cast<float>(frame.tangent[c]);
         }
       }});
}

std::vector<Source> planeSources(const PixelPlanes& planes) {
  std::vector<Source> sources;
  addCoordinate(sources, planes, Plane::kUInt, Plane::kUFrac, "uv.X");
  addCoordinate(sources, planes, Plane::kVInt, Plane::kVFrac, "uv.Y");
  addInteger(sources, planes, Plane::kUInt, "u.int");
  addFraction(sources, planes, Plane::kUFrac, "u.frac");
  addInteger(sources, planes, Plane::kVInt, "v.int");
  addFraction(sources, planes, Plane::kVFrac, "v.frac");
  addFloat(sources, planes, Plane::kDudx, "dudx");
  addFloat(sources, planes, Plane::kDvdx, "dvdx");
  addFloat(sources, planes, Plane::kDudy, "dudy");
  addFloat(sources, planes, Plane::kDvdy, "dvdy");
  addFrame(sources, planes);
  addFloat(sources, planes, Plane::kDepth, "Z");
  addFloat(sources, planes, Plane::kDnxDx, "dNdx.X");
  addFloat(sources, planes, Plane::kDnyDx, "dNdx.Y");
  addFloat(sources, planes, Plane::kDnzDx, "dNdx.Z");
  addFloat(sources, planes, Plane::kDnxDy, "dNdy.X");
  addFloat(sources, planes, Plane::kDnyDy, "dNdy.Y");
  addFloat(sources, planes, Plane::kDnzDy, "dNdy.Z");
  return sources;
}

}  // namespace

Image planesToImage(const PixelPlanes& planes) {
  if (!planes.mask.has(Plane::kPixel)) throw Error("the planes do not say where their pixels are");
  const std::vector<Source> sources = planeSources(planes);
  std::vector<std::string> names = {"material"};
  for (const Source& source : sources) {
    names.insert(names.end(), source.channels.begin(), source.channels.end());
  }
  Image image(planes.width_px, planes.height_px, static_cast<int>(names.size()));
  image.channel_names = names;
  for (std::size_t first = 0; first < image.pixels.size(); first += names.size()) {
    image.pixels[first] = -1;
  }
  const auto pixels = planes.plane(Plane::kPixel);
  for (const PixelList& list : planes.lists) {
    for (std::size_t entry = list.offset; entry < list.offset + list.count; ++entry) {
      const int x = static_cast<int>(pixels[entry] & 0xFFFFu);
      const int y = static_cast<int>(pixels[entry] >> 16);
      float* out = image.at(x, y).data();
      *out++ = static_cast<float>(list.material);
      for (const Source& source : sources) {
        source.write(entry, out);
        out += source.channels.size();
      }
    }
  }
  return image;
}

void requireMemoryForPlanes(int width_px, int height_px) {
  // An image has up to one and a half times as many channels as there are planes.
  constexpr std::uint64_t kWords = kPlaneCount * 4;
  requireMemory(static_cast<std::uint64_t>(width_px) * height_px * kWords * sizeof(float),
                fmt::format("an image of all planes of {}x{} pixels", width_px, height_px));
}

}  // namespace glintmark
