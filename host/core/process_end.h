// How a process that this one started ends.
#pragma once
#include <sys/types.h>

#include <span>
#include <string>

namespace glintmark {

/// Called in a child right after the fork: it dies with `parent`, and if that has died before the
/// call it ends now, with the exit code that is given.
void dieWithParent(pid_t parent, int exit_code);

/// For these signals: what they do to a program that catches none. Those that are ignored, as nohup
/// has it, stay so.
void endByDefault(std::span<const int> signals);

/// A program that was started with SIGCHLD ignored never learns how its children end: no more.
void requireChildStatus();

/// Waits for a child, through signals: the status that waitpid() gives; one of exit code
/// 1 if the system keeps none.
int awaitProcess(pid_t child);

/// How a process ended, by that status: "ended by signal 11 (Segmentation fault)", "ended with exit
/// code 7".
std::string howItEnded(int status);

}  // namespace glintmark
