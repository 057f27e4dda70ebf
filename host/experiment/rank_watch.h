// What becomes of a rank whose driver ends its process.
#pragma once

namespace glintmark {

/// Returns in a child of this process if a launcher started it; this process waits for the child,
/// says in one sentence how a driver ended it and in which case, and ends as it did. Called before
/// the ranks are joined, and before OpenCL is used. Without a launcher it does nothing.
void watchRank();

}  // namespace glintmark
