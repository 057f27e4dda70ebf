#include "host/cli/own_files.h"

#include <fmt/format.h>

#include <filesystem>

#include "host/core/error.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

bool areOne(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  // Names of files to be stay as they are spelt, unless they are absolute.
  const fs::path first = fs::weakly_canonical(fs::absolute(a), error);
  if (error) return false;
  const fs::path second = fs::weakly_canonical(fs::absolute(b), error);
  return !error && first == second;
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
  std::vector<std::string> values = {scene, common.mesh_file};
  const fs::path beside = fs::path(scene).parent_path();
  for (const std::string& text : common.overrides) {
    const std::size_t sign = text.find('=');
    if (sign == std::string::npos) continue;
    std::string value = text.substr(sign + 1);
    if (value.size() > 1 && value.front() == value.back() && (value[0] == '"' || value[0] == '\''))
      value = value.substr(1, value.size() - 2);
    values.push_back((beside / value).string());  // where a scene's files are looked for first
    values.push_back(std::move(value));
  }
  return values;
}

}  // namespace glintmark
