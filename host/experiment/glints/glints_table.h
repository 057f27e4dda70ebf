// Table "glints": every glint method over footprints, microdetails and lights.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "host/experiment/accuracy/glint_axis.h"
#include "host/report/record/record.h"
#include "host/report/record/table_spec.h"

namespace glintmark {

const TableSpec& glintsSpec();

/// One kind of pixels: of a method's case "zk16/aspect=4/lambda=10/lights=1".
struct GlintsKind {
  GlintStage stage;
  int lights = 1;
};
std::vector<GlintsKind> glintsKinds();
std::string glintsCase(const std::string& method, const GlintsKind& kind);

/// Time and error of every method, by kind; what nothing beats in both.
std::string glintsTableText(std::span<const Record> records);
/// Sentences of the literature beside what the records say.
std::string glintsClaimsText(std::span<const Record> records);

}  // namespace glintmark
