// How far a table of linearly transformed cosines is from the anisotropic BRDF it stands for.
#pragma once
#include <vector>

#include "host/fit/anisotropic_table.h"
#include "host/fit/ltc_table.h"

namespace glintmark {

/// Errors at one place of a table, integrals over the hemisphere of |scale lobe - BRDF cosine| at
/// F0 = 1: of the table's lobe, and of the round one of the roughness sqrt(alpha_u alpha_v).
struct AnisotropicErrorAt {
  double ratio = 1;  // alpha_v / alpha_u
  double cos_theta = 1;
  double stretched = 0, round = 0;
};

/// For one lobe of `table` and of `round`, a table of the same NDF; `view` as anisotropicMatrix
/// takes it.
AnisotropicErrorAt anisotropicErrorAt(const AnisotropicTable& table, const LtcTable& round,
                                      const AnisotropicView& view);

/// At all nodes; and in the middle between the sixteen nodes of each cell of the grid. Parallel.
std::vector<AnisotropicErrorAt> anisotropicNodeErrors(const AnisotropicTable& table,
                                                      const LtcTable& round);
std::vector<AnisotropicErrorAt> anisotropicMidpointErrors(const AnisotropicTable& table,
                                                          const LtcTable& round);

}  // namespace glintmark
