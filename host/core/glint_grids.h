// What the grids of a material have in common over all pixels. [ZK16] Sect. 3, 4.4
#pragma once
#include "host/core/shared_types.h"

namespace glintmark {

/// `params` as a launch reads them: gamma and finest level of their grids set from the rest.
MaterialParams withGlintGrids(MaterialParams params);

}  // namespace glintmark
