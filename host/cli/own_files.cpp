#include "host/cli/own_files.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "host/core/error.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

bool areOne(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  if (fs::path(a).filename() != fs::path(b).filename()) return false;
  // Names of files to be stay as they are spelt, unless they are absolute.
  const fs::path first = fs::weakly_canonical(fs::absolute(a, error), error);
  if (error) return false;
  const fs::path second = fs::weakly_canonical(fs::absolute(b, error), error);
  return !error && first == second;
}

// Texts between quotes of a scene file that may name a file: what is read has an extension. What is
// no scene has none; that is said by whoever reads it.
std::vector<std::string> quotedNames(const fs::path& file) {
  constexpr std::uintmax_t kMost_bytes = 64 << 20;
  std::error_code error;
  if (file.extension() != ".toml" || !fs::is_regular_file(file, error) ||
      fs::file_size(file, error) > kMost_bytes)
    return {};
  std::vector<std::string> names;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);)
    for (std::size_t begin = line.find_first_of("\"'"); begin != std::string::npos;) {
      const std::size_t end = line.find(line[begin], begin + 1);
      if (end == std::string::npos) break;
      std::string text = line.substr(begin + 1, end - begin - 1);
      if (text.find('.') != std::string::npos) names.push_back(std::move(text));
      begin = line.find_first_of("\"'", end + 1);
    }
  return names;
}

}  // namespace

void requireOwnFiles(const std::vector<OutputFile>& outputs,
                     const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const OutputFile& output = outputs[i];
    for (std::size_t k = 0; k < i; ++k)
      if (areOne(output.file, outputs[k].file))
        throw Error(fmt::format("{} '{}' is the file of {} too; choose another name", output.option,
                                output.file, outputs[k].option));
    for (const std::string& input : inputs)
      if (areOne(output.file, input) || areOne(output.file, input.substr(0, input.rfind('#'))))
        throw Error(fmt::format("{} '{}' would be written over what is read; choose another name",
                                output.option, output.file));
  }
}

std::vector<std::string> sceneInputs(const CommonOptions& common, const std::string& scene) {
  std::vector<std::string> names = quotedNames(scene);
  for (const std::string& text : common.overrides) {
    const std::size_t sign = text.find('=');
    if (sign == std::string::npos) continue;
    std::string value = text.substr(sign + 1);
    if (value.size() > 1 && value.front() == value.back() && (value[0] == '"' || value[0] == '\''))
      value = value.substr(1, value.size() - 2);
    names.push_back(std::move(value));
  }
  std::vector<std::string> files = {scene, common.mesh_file};
  for (const std::string& name : names) {
    files.push_back((fs::path(scene).parent_path() / name).string());  // looked for there first
    files.push_back(name);
  }
  return files;
}

}  // namespace glintmark
