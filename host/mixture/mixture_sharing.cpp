#include "host/mixture/mixture_sharing.h"

namespace glintmark {
namespace {

// What is shared among ranks takes each of them milliseconds, since telling the others takes half
// of one: so many blocks of a batch, or so many normals; of long rows a few blocks.
constexpr int kLeastSharedBlocks = 256, kLeastLongBlocks = 4;
constexpr double kLeastSharedNormals = 1 << 22;

}  // namespace

MixtureSharing mixtureSharing(const Ranks& ranks, const MixtureLevel& level, int blocks) {
  const int size = ranks.size();
  if (size == 1) return MixtureSharing::kNothing;
  if (!level.hasLongRows())
    return blocks >= kLeastSharedBlocks * size ? MixtureSharing::kBlocks : MixtureSharing::kNothing;
  const double normals = level.normalsPerTexel();
  if (blocks >= kLeastLongBlocks * size && normals * blocks >= kLeastSharedNormals)
    return MixtureSharing::kBlocks;
  return normals >= kLeastSharedNormals ? MixtureSharing::kNormals : MixtureSharing::kNothing;
}

}  // namespace glintmark
