// How much of a fit is worth telling other ranks.
#pragma once
#include "host/mixture/mixture_level.h"
#include "host/parallel/ranks.h"

namespace glintmark {

/// What of a batch of texels ranks share: where it is little, every rank does all of it.
enum class MixtureSharing { kNothing, kBlocks, kNormals };

/// For a batch of `blocks` blocks of a level: whole blocks, or where these are few the normals
/// below each texel.
MixtureSharing mixtureSharing(const Ranks& ranks, const MixtureLevel& level, int blocks);

}  // namespace glintmark
