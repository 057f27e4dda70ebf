// The tables, which `bench`, `accuracy`, `report`, the page and the documentation read.
#pragma once
#include <vector>

#include "host/experiment/bench_run.h"

namespace glintmark {

#define TABLE(function) BenchTable function();
#include "host/experiment/all_tables.inc"

/// In the order in which they are measured, printed and shown.
std::vector<BenchTable> allTables();

/// What each says of itself, in the same order.
std::vector<TableSpec> allTableSpecs();

}  // namespace glintmark
