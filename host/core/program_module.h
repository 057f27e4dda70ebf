// Modules that the program loads when it first needs them.
#pragma once
#include <filesystem>
#include <string>

namespace glintmark {

/// Where the module `file` is: in lib/glintmark beside an installed program, else in the program's
/// own folder, whether there is one or not.
std::filesystem::path modulePath(const std::string& file);

/// The function `symbol` of the module, which is loaded if need be and never closed: what it makes
/// lives as long as the program. `for_others`: what it is linked with can be seen by what that
/// loads. Throws Error: what `need` says needs the module, which one, and what stops it.
void* moduleFunction(const std::string& file, const char* symbol, const std::string& need,
                     bool for_others = false);

}  // namespace glintmark
