#include "host/experiment/rank_watch.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <thread>

#include "host/experiment/survival.h"
#include "host/experiment/watched_child.h"
#include "host/parallel/ranks.h"

namespace glintmark {
namespace {

// Nothing where the rank has said itself why it ended.
std::string lastWords(int status) {
  const std::string at_hand = caseAtHand();
  if (wasAskedToEnd(status) || (!WIFSIGNALED(status) && at_hand.empty())) return "";
  const Launched self = launched();
  const std::string where =
      at_hand.empty()
          ? ""
          : fmt::format(" in {}; without mpirun, --resume loses that case and goes on", at_hand);
  return fmt::format("glintmark: rank {} of {}: its process {}{}\n", self.rank, self.size,
                     whyItEnded(status), where);
}

}  // namespace

void watchRank() {
  if (!hasLauncher() || !shareCaseAtHand()) return;
  const pid_t child = startChild(true);
  if (child <= 0) return;
  const int status = awaitChild(child);
  if (const std::string words = lastWords(status); !words.empty()) {
    if (launched().rank > 0) std::this_thread::sleep_for(kFirstSpeaks);
    if (!wasAskedToEnd(status)) fmt::print(stderr, "{}", words);
  }
  _exit(exitCodeOf(status));
}

}  // namespace glintmark
