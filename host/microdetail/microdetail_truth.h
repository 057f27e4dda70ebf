// Explicit microdetails: each is placed, and pixels sum what they see of it.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "host/core/shared_types.h"
#include "host/microdetail/detail_tables.h"
#include "host/microdetail/light_slopes.h"
#include "host/microdetail/pixel_lattice.h"
#include "host/ocl/compute.h"

namespace glintmark {

enum class PixelFilter : int {
  kBox = 0,   // a pixel is the mean over its parallelogram
  kTent = 1,  // a tent along either edge, over twice the parallelogram
};

/// The surface that a truth is of. Grooves are none: their microdetails have a length that no
/// parameter states.
struct MicrodetailSurface {
  MaterialParams material{};
  bool coloured =
      false;  // each microdetail has a colour of the palette, or of the wheel without one
  CountLaw law = CountLaw::kPoisson;
  std::uint32_t seed = 1;  // another one is another surface of the same kind
};

/// What pixels see over what the smooth lobe shows: 1 on average, r, g, b.
struct MicrodetailRatios {
  /// Each microdetail mirrors the share of the light that its lobe says.
  std::vector<glm::vec3> lobes;
  /// Each mirrors all or nothing, with that share as the probability: [ZK16] Eq. 7, which every
  /// method that counts builds on.
  std::vector<glm::vec3> reflecting;
};

class MicrodetailTruth {
 public:
  /// `lanes` of the kernels; results do not depend on them but for the order of sums.
  MicrodetailTruth(Device& device, ProgramCache& cache, int lanes);

  /// Called between launches with pixels done and all of them; may throw.
  using Progress = std::function<void(std::size_t done, std::size_t all)>;

  /// Launches of some 10^7 microdetails each. Microdetails are points to pixels that hold more than
  /// one on average; smaller ones see through a larger parallelogram (grown()), since a microdetail
  /// spans several of them.
  MicrodetailRatios place(const PixelLattice& lattice, const MicrodetailSurface& surface,
                          const LightSlopes& light, PixelFilter filter = PixelFilter::kBox,
                          const Progress& progress = nullptr);

 private:
  Device& device_;
  ProgramCache& cache_;
  int lanes_;
};

/// Microdetails that place() visits in a pixel on average, what its filter touches included.
double detailsPerPixel(const PixelLattice& lattice, const MicrodetailSurface& surface,
                       PixelFilter filter = PixelFilter::kBox);

}  // namespace glintmark
