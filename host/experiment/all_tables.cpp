#include "host/experiment/all_tables.h"

namespace glintmark {

std::vector<BenchTable> allTables() {
  return {
#define TABLE(function) function(),
#include "host/experiment/all_tables.inc"
  };
}

std::vector<TableSpec> allTableSpecs() {
  std::vector<TableSpec> specs;
  for (const BenchTable& table : allTables()) specs.push_back(table.spec);
  return specs;
}

}  // namespace glintmark
