// Work on the rows of a map, which may have 16384 of them.
#pragma once
#include <functional>
#include <string>

namespace glintmark {

/// Calls `run` once for every row, on all threads; what takes over two seconds shows how far it is,
/// as "[12/100] % of WHAT" on a terminal.
void forAllRows(int rows, const std::string& what, const std::function<void(int row)>& run);

}  // namespace glintmark
