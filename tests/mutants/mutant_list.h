// The list of mutants (mutants.toml) and kernels with one of them.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace glintmark {

struct Mutant {
  std::string name;
  std::string file;           // under kernels/
  std::string text, becomes;  // what is replaced, and by what
  std::string checks;         // regular expression of the checks that ought to see it
  std::string why;
  bool sample = false;  // the tests try it too
};

/// Those of a file. Throws Error if it is no such list, or if two have one name.
std::vector<Mutant> readMutants(const std::filesystem::path& file);

/// How often a mutant's text stands in its file of `kernels`; 0 if there is no such file.
int occurrences(const Mutant& mutant, const std::filesystem::path& kernels);

/// Copies `kernels` to `folder`, which does not exist yet, with the mutant in it. Throws Error if
/// its text does not stand there exactly once.
void writeMutant(const Mutant& mutant, const std::filesystem::path& kernels,
                 const std::filesystem::path& folder);

}  // namespace glintmark
