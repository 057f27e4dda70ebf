// Table `effects` as text, and the pairs of effects as a picture.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "host/core/image.h"
#include "host/report/record/table_spec.h"

namespace glintmark {

/// Table "effects": names, metrics, what the page shows.
const TableSpec& effectsSpec();

inline constexpr double kMiB = 1024.0 * 1024.0;

/// Effects that stand alone in some case, in the order of the records.
std::vector<std::string> singleEffects(std::span<const Record> records);

/// One row a set of effects, and one sentence of what they show. At most 100 columns.
std::string effectsTableText(std::span<const Record> records);

/// Two matrices, effect against effect, alone on the diagonal: time of the program with everything
/// compiled in over the specialised programs', and the mixed frame over the sum of its effects. A
/// pair that was not measured stands at the low end of the colours.
Image effectsMatrixPicture(std::span<const Record> records);

}  // namespace glintmark
