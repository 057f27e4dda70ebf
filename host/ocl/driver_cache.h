// The folder in which PoCL keeps what it compiles: without one that it can write, it fails.
#pragma once
#include <string>

namespace glintmark {

/// Gives PoCL a temporary folder, which is gone when this process ends, where its own cannot be
/// written, as for users without a home. Returns what was done, a sentence, at the first call, else
/// nothing. Has to be called before OpenCL is used; drivers other than PoCL do not notice.
std::string prepareDriverCache();

/// A folder for temporary files without blanks in its path, which compilers inside drivers may take
/// apart: $TMPDIR, else /tmp or /var/tmp.
std::string folderWithoutBlanks();

}  // namespace glintmark
