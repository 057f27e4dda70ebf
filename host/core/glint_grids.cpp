#include "host/core/glint_grids.h"

#include <cmath>

namespace glintmark {
namespace {

using std::floor, std::sqrt;
#include "kernels/glint/glint_grids.h"

}  // namespace

MaterialParams withGlintGrids(MaterialParams params) {
  setGlintGrids(&params.glints, params.surface.alpha_g);
  return params;
}

}  // namespace glintmark
