#include "host/experiment/all_tables.h"

#include "host/experiment/accuracy/accuracy_run.h"
#include "host/experiment/effects/effects_bench.h"
#include "host/experiment/msbrdf/msbrdf_bench.h"
#include "host/experiment/tan05/tan05_bench.h"
#include "host/experiment/tao21/tao21_bench.h"
#include "host/experiment/zk16/zk16_bench.h"

namespace glintmark {

std::vector<BenchTable> allTables() {
  return {zk16Bench(), tan05Bench(), tao21Bench(), msbrdfBench(), effectsBench(), accuracyTable()};
}

std::vector<TableSpec> allTableSpecs() {
  std::vector<TableSpec> specs;
  for (const BenchTable& table : allTables()) specs.push_back(table.spec);
  return specs;
}

}  // namespace glintmark
