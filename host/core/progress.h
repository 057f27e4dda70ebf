// A progress line on stderr.
#pragma once
#include <string>

namespace glintmark {

/// Shows what a long command is doing in one line that overwrites itself. Silent if `quiet` or if
/// stderr is not a terminal, so that logs stay clean.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Every Progress from now on is silent: --quiet, for those of functions that are not told of it.
  static void silenceAll();
  static bool areSilent();

  /// Replaces the line by "[done/total] what"; `total` 0 leaves the counter out.
  void show(int done, int total, const std::string& what);
  /// Removes the line, so that other output can follow.
  void clear();

 private:
  bool active_;
  bool shown_ = false;
};

}  // namespace glintmark
