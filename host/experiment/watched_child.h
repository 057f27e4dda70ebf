// A child of this process that goes on in its place, while it waits for it.
#pragma once
#include <sys/types.h>

#include <string>

namespace glintmark {

/// Forks: 0 in the child, which dies with its parent; less than 0 if there can be none. Requests to
/// end that reach the parent are handed on. A child in a group of its own gets no signals but
/// those, so that what is sent to all of the parent's group reaches it once.
pid_t startChild(bool own_group = false);

/// Waits for it: the status that waitpid() gives.
int awaitChild(pid_t child);

/// Was the child asked to end, or killed? A driver that dies is something else.
bool wasAskedToEnd(int status);

/// How it ended, in the words for one that nobody goes on with: what may have killed it.
std::string whyItEnded(int status);

/// What its parent returns in its place.
int exitCodeOf(int status);

}  // namespace glintmark
