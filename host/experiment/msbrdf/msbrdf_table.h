// Table `msbrdf` as text, with [PAT18]'s figures beside ours.
#pragma once
#include <span>
#include <string>

#include "host/experiment/paper_gpu.h"
#include "host/report/record/table_spec.h"

namespace glintmark {

/// [PAT18]: 500 million rays, four orders, in about half a second. The GPU is not named; a GeForce
/// GTX 980 of 2015 is assumed.
inline constexpr double kPat18Rays = 500e6, kPat18Ms = 500, kPat18PeakGflops = kGtx980PeakGflops;

/// Table "msbrdf": names, metrics, what the page shows.
const TableSpec& msbrdfSpec();

/// Kinds of cases, the first word of their names; knobs follow, kAlphaKnob first.
inline constexpr const char *kSurfaceKind = "surface", *kModelKind = "model",
                            *kEnergyKind = "energy", *kMetalKind = "metal",
                            *kConductorKind = "conductor";
/// What a conductor's facets are, the third word of its cases.
inline constexpr const char *kHeightsModel = "heights", *kSmithModel = "smith";
inline constexpr const char *kAlphaKnob = "alpha", *kThetaKnob = "theta";

/// Files of the run's folder.
inline constexpr const char *kEnergyPicture = "msbrdf_energy.png",
                            *kSweepPicture = "msbrdf_sweep.png";

/// Energy per order over roughness; models; cost. At most 100 columns.
std::string msbrdfTableText(std::span<const Record> records);

}  // namespace glintmark
