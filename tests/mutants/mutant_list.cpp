#include "tests/mutants/mutant_list.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <set>

#include "host/core/atomic_file.h"
#include "host/core/error.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTextKeys[] = {"name", "file", "text", "becomes", "checks", "why"};

void requireKnownKeys(const toml::table& table, const std::string& file) {
  std::set<std::string_view> known(std::begin(kTextKeys), std::end(kTextKeys));
  known.insert("sample");
  for (const auto& [key, value] : table)
    if (!known.contains(key.str()))
      throw Error(fmt::format("{}:{}: mutants have no key '{}'", file, value.source().begin.line,
                              key.str()));
  for (const char* key : kTextKeys)
    if (!table[key].is_string())
      throw Error(
          fmt::format("{}:{}: a mutant needs the text '{}'", file, table.source().begin.line, key));
}

Mutant mutantOf(const toml::table& table, const std::string& file) {
  requireKnownKeys(table, file);
  const auto text = [&](const char* key) { return table[key].value_or(std::string()); };
  Mutant m = {text("name"),   text("file"), text("text"), text("becomes"),
              text("checks"), text("why"),  false};
  m.sample = table["sample"].value_or(false);
  if (m.text.empty() || m.text == m.becomes)
    throw Error(fmt::format("{}: mutant '{}' changes nothing", file, m.name));
  return m;
}

}  // namespace

std::vector<Mutant> readMutants(const fs::path& file) {
  std::vector<Mutant> mutants;
  try {
    const toml::table list = toml::parse(readFile(file), file.string());
    const toml::array* tables = list["mutant"].as_array();
    if (tables == nullptr) throw Error(fmt::format("{} has no [[mutant]]", file.string()));
    std::set<std::string> names;
    for (const toml::node& node : *tables) {
      mutants.push_back(mutantOf(*node.as_table(), file.string()));
      if (!names.insert(mutants.back().name).second)
        throw Error(fmt::format("{} has '{}' twice", file.string(), mutants.back().name));
    }
  } catch (const toml::parse_error& error) {
    throw Error(fmt::format("{}:{}: {}", file.string(), error.source().begin.line,
                            std::string(error.description())));
  }
  return mutants;
}

int occurrences(const Mutant& mutant, const fs::path& kernels) {
  if (!fs::is_regular_file(kernels / mutant.file)) return 0;
  const std::string text = readFile(kernels / mutant.file);
  int found = 0;
  for (std::size_t at = text.find(mutant.text); at != std::string::npos;
       at = text.find(mutant.text, at + 1))
    ++found;
  return found;
}

void writeMutant(const Mutant& mutant, const fs::path& kernels, const fs::path& folder) {
  const int found = occurrences(mutant, kernels);
  if (found != 1)
    throw Error(fmt::format("mutant '{}': its text stands {} times in kernels/{}, not once",
                            mutant.name, found, mutant.file));
  fs::copy(kernels, folder, fs::copy_options::recursive);
  std::string text = readFile(kernels / mutant.file);
  text.replace(text.find(mutant.text), mutant.text.size(), mutant.becomes);
  writeFile(folder / mutant.file, text);
}

}  // namespace glintmark
