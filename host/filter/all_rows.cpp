#include "host/filter/all_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "host/core/progress.h"
#include "host/core/stopwatch.h"

namespace glintmark {

void forAllRows(int rows, const std::string& what, const std::function<void(int row)>& run) {
  constexpr double kSilent_ns = 2e9;
  constexpr int kSteps = 50;
  const Stopwatch watch;
  Progress progress(false);
  const int at_once = std::max(1, rows / kSteps);
  for (int first = 0; first < rows;) {
    const int last = first + std::min(at_once, rows - first);
    tbb::parallel_for(first, last, run);
    first = last;
    if (watch.elapsedNs() > kSilent_ns)
      progress.show(static_cast<int>(100.0 * last / rows), 100, "% of " + what);
  }
}

}  // namespace glintmark
