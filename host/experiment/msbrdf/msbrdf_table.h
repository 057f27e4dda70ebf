// Table `msbrdf` as text, with [PAT18]'s figures beside ours.
#pragma once
#include <span>
#include <string>

#include "host/report/record/record.h"

namespace glintmark {

/// [PAT18]: 500 million rays, four orders, in about half a second. The GPU is not named; a GeForce
/// GTX 980 of 2015 (4980 GFLOP/s) is assumed.
inline constexpr double kPat18Rays = 500e6, kPat18Ms = 500, kPat18PeakGflops = 4980;

/// Energy per order over roughness; models; cost. At most 100 columns.
std::string msbrdfTableText(std::span<const Record> records);

}  // namespace glintmark
