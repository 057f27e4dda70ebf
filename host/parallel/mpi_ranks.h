// Ranks by MPI: a module, which a run without a launcher does not load.
#pragma once
#include <functional>
#include <memory>

#include "host/parallel/ranks.h"

namespace glintmark {

/// Ranks that can also end.
class LaunchedRanks : public Ranks {
 public:
  /// Of all: nothing is shared afterwards.
  virtual void leave() = 0;
  /// Ends every rank, this one too.
  virtual void abort(int exit_code) = 0;
};

inline constexpr char kMpiModule[] = "glintmark_mpi.so";
inline constexpr char kJoinMpiSymbol[] = "glintmarkJoinMpi";

/// What the symbol is: initialises MPI and makes the ranks, which the caller owns. `waiting` is
/// called while they wait.
using JoinMpiFunction = LaunchedRanks*(void (*waiting)());

}  // namespace glintmark
