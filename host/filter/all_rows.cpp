#include "host/filter/all_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "host/core/late_progress.h"

namespace glintmark {

void forAllRows(int rows, const std::string& what, const std::function<void(int row)>& run) {
  constexpr int kSteps = 50;
  LateProgress progress(what);
  const int at_once = std::max(1, rows / kSteps);
  for (int first = 0; first < rows;) {
    const int last = first + std::min(at_once, rows - first);
    tbb::parallel_for(first, last, run);
    first = last;
    progress.show(last, rows);
  }
}

}  // namespace glintmark
