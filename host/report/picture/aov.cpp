#include "host/report/picture/aov.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <span>
#include <utility>

#include "host/core/error.h"
#include "host/core/frame_packing.h"
#include "host/core/free_memory.h"

namespace glintmark {
namespace {

constexpr double kFractionScale = 1.0 / 4294967296.0;  // uv fractions are in units of 2^-32

// Entry of a pixel that no material covers.
constexpr std::uint32_t kNoEntry = 0xFFFFFFFFu;

// Writes the channels of one source for a row of pixels, by the list entries of these, `step`
// floats from one to the next.
struct Source {
  std::vector<std::string> channels;
  std::function<void(std::span<const std::uint32_t> entries, float* out, std::size_t step)> write;
};

// One channel, `value` of an entry.
template <typename Value>
void addChannel(std::vector<Source>& sources, const char* name, const Value& value) {
  sources.push_back(
      {{name}, [value](std::span<const std::uint32_t> entries, float* out, std::size_t step) {
         for (const std::uint32_t entry : entries) {
           if (entry != kNoEntry) *out = value(entry);
           out += step;
         }
       }});
}

void addFloat(std::vector<Source>& sources, const PixelPlanes& planes, Plane plane,
              const char* name) {
  if (!planes.mask.has(plane)) return;
  const auto values = planes.plane<float>(plane);
  addChannel(sources, name, [values](std::size_t i) { return values[i]; });
}

void addInteger(std::vector<Source>& sources, const PixelPlanes& planes, Plane plane,
                const char* name) {
  if (!planes.mask.has(plane)) return;
  const auto values = planes.plane<std::int32_t>(plane);
  addChannel(sources, name, [values](std::size_t i) { return static_cast<float>(values[i]); });
}

void addFraction(std::vector<Source>& sources, const PixelPlanes& planes, Plane plane,
                 const char* name) {
  if (!planes.mask.has(plane)) return;
  const auto values = planes.plane(plane);
  addChannel(sources, name,
             [values](std::size_t i) { return static_cast<float>(values[i] * kFractionScale); });
}

// A whole coordinate, as exact as a float is; both parts stand in channels of their own.
void addCoordinate(std::vector<Source>& sources, const PixelPlanes& planes, Plane whole,
                   Plane fraction, const char* name) {
  if (!planes.mask.has(whole) || !planes.mask.has(fraction)) return;
  const auto integers = planes.plane<std::int32_t>(whole);
  const auto fractions = planes.plane(fraction);
  addChannel(sources, name, [integers, fractions](std::size_t i) {
    return static_cast<float>(integers[i] + fractions[i] * kFractionScale);
  });
}

void addFrame(std::vector<Source>& sources, const PixelPlanes& planes) {
  if (!planes.mask.has(Plane::kFrame0) || !planes.mask.has(Plane::kFrame1)) return;
  const auto frame0 = planes.plane(Plane::kFrame0), frame1 = planes.plane(Plane::kFrame1);
  sources.push_back(
      {{"N.X", "N.Y", "N.Z", "T.X", "T.Y", "T.Z"},
       [frame0, frame1](std::span<const std::uint32_t> entries, float* out, std::size_t step) {
         for (const std::uint32_t i : entries) {
           if (i != kNoEntry) {
             const ShadingFrame frame = unpackFrame({frame0[i], frame1[i]});
             for (int c = 0; c < 3; ++c) {
               out[c] = static_cast<float>(frame.normal[c]);
               out[3 + c] = static_cast<float>(frame.tangent[c]);
             }
           }
           out += step;
         }
       }});
}

// The number of each entry's material, and -1 where there is none.
Source materialSource(const std::vector<PixelList>& lists) {
  return {
      {"material"}, [&lists](std::span<const std::uint32_t> entries, float* out, std::size_t step) {
        const PixelList* list = lists.data();
        for (const std::uint32_t entry : entries) {
          if (entry == kNoEntry) {
            *out = -1;
          } else {
            if (entry < list->offset || entry - list->offset >= list->count)
              list = &*std::prev(std::ranges::upper_bound(lists, entry, {}, &PixelList::offset));
            *out = static_cast<float>(list->material);
          }
          out += step;
        }
      }};
}

std::vector<Source> planeSources(const PixelPlanes& planes) {
  std::vector<Source> sources = {materialSource(planes.lists)};
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

// Of every pixel, row by row.
std::vector<std::uint32_t> entriesOfPixels(const PixelPlanes& planes) {
  std::vector<std::uint32_t> entries(static_cast<std::size_t>(planes.width_px) * planes.height_px,
                                     kNoEntry);
  const auto pixels = planes.plane(Plane::kPixel);
  for (const PixelList& list : planes.lists)
    tbb::parallel_for(list.offset, list.offset + list.count, [&](std::uint32_t entry) {
      const std::size_t x = pixels[entry] & 0xFFFFu, y = pixels[entry] >> 16;
      entries[y * static_cast<std::size_t>(planes.width_px) + x] = entry;
    });
  return entries;
}

}  // namespace

struct PlaneRows::Impl {
  const PixelPlanes& planes;
  std::vector<std::uint32_t> entries;
  std::vector<std::string> names;
  // All channels of a row of pixels.
  std::function<void(std::span<const std::uint32_t> entries, float* out)> write;
};

PlaneRows::PlaneRows(const PixelPlanes& planes) {
  if (!planes.mask.has(Plane::kPixel)) throw Error("the planes do not say where their pixels are");
  impl_ = std::make_unique<Impl>(Impl{planes, entriesOfPixels(planes), {}, {}});
  const std::vector<Source> sources = planeSources(planes);
  std::vector<std::string>& names = impl_->names;
  for (const Source& source : sources)
    names.insert(names.end(), source.channels.begin(), source.channels.end());
  impl_->write = [sources, step = names.size()](std::span<const std::uint32_t> entries,
                                                float* out) {
    for (const Source& source : sources) {
      source.write(entries, out, step);
      out += source.channels.size();
    }
  };
}

PlaneRows::~PlaneRows() = default;

Image PlaneRows::read(int first, int count) const {
  const int width = impl_->planes.width_px;
  Image image(width, count, static_cast<int>(impl_->names.size()));
  image.channel_names = impl_->names;
  tbb::parallel_for(0, count, [&](int y) {
    const auto row =
        std::span(impl_->entries)
            .subspan(static_cast<std::size_t>(first + y) * width, static_cast<std::size_t>(width));
    impl_->write(row, image.at(0, y).data());
  });
  return image;
}

Image planesToImage(const PixelPlanes& planes) {
  return PlaneRows(planes).read(0, planes.height_px);
}

void requireMemoryForPlanes(int width_px, int height_px) {
  // The planes, an entry for each pixel, and the file, which may hardly be smaller than its
  // channels.
  constexpr std::uint64_t kWords = kPlaneCount * 3;
  requireMemory(static_cast<std::uint64_t>(width_px) * height_px * kWords * sizeof(float),
                fmt::format("an image of all planes of {}x{} pixels", width_px, height_px));
}

}  // namespace glintmark
