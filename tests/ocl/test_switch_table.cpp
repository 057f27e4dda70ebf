// The table of switches against what else says the same: kernels/README.md, and the defaults,
// ranges and named values that the kernels' files give to whoever compiles them without our host.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdio.h>

#include <filesystem>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>

#include "host/ocl/kernel_folder.h"
#include "host/ocl/switches.h"
#include "tests/ocl/ocl_test.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

// Lines of text from the one that starts with `first` to the next empty one.
std::vector<std::string> paragraph(const std::string& text, const std::string& first) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (lines.empty() && !line.starts_with(first)) continue;
    if (line.empty()) break;
    lines.push_back(line);
  }
  return lines;
}

std::string valuesText(const SwitchValues& values) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < values.names.size(); ++i)
    texts.push_back(values.folder.empty() ? fmt::format("{} `{}`", i, values.names[i])
                                          : fmt::format("`{}`", values.names[i]));
  for (const int value : values.listed) texts.push_back(std::to_string(value));
  if (texts.empty() && values.most > 1) return fmt::format("{} to {}", values.least, values.most);
  if (texts.empty()) texts = {"0", "1"};
  return fmt::format("{}", fmt::join(texts, ", "));
}

// The switches as a table of Markdown.
std::vector<std::string> renderedTable() {
  std::vector<std::string> lines = {"| switch | values | default | meaning | set by |",
                                    "|---|---|---|---|---|"};
  for (const Switch& row : allSwitches()) {
    std::string set_by(row.set_by);
    if (row.sweep.kind != Sweep::kNone)
      set_by += fmt::format("{}`accuracy {}`: `{}`", set_by.empty() ? "" : ", ", row.sweep.effect,
                            row.sweep.knob);
    lines.push_back(fmt::format("| `{}` | {} | {} | {} | {} |", row.macro, valuesText(row.values),
                                row.textOf(row.standard), row.meaning, set_by));
  }
  return lines;
}

TEST(SwitchTable, ReadmeHasTheSame) {
  const std::vector<std::string> readme = paragraph(readFile(kKernels / "README.md"), "| switch |");
  const std::vector<std::string> table = renderedTable();
  const std::set<std::string> known(readme.begin(), readme.end());
  for (const std::string& line : table)
    EXPECT_TRUE(known.contains(line)) << "kernels/README.md lacks this row:\n" << line;
  EXPECT_EQ(readme, table) << "kernels/README.md should hold\n"
                           << fmt::format("{}", fmt::join(table, "\n"));
}

// What the preprocessor says of a kernel file under these -D: macros on standard output, errors
// too.
std::string preprocessed(const fs::path& file, const std::string& options) {
  const std::string command = fmt::format("g++ -E -dM -x c -I '{}' {} '{}' 2>&1", kKernels.string(),
                                          options, file.string());
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  char chunk[4096];
  while (pipe && fgets(chunk, sizeof chunk, pipe.get()) != nullptr) text += chunk;
  return text;
}

// Macros without parameters after "#define NAME text".
std::map<std::string, std::string> macrosOf(const std::string& preprocessed_text) {
  std::map<std::string, std::string> macros;
  std::istringstream stream(preprocessed_text);
  for (std::string word, name, text; stream >> word >> name && std::getline(stream, text);)
    if (word == "#define") macros[name] = text.empty() ? "" : text.substr(1);
  return macros;
}

// The number that a macro stands for, through other macros' names; empty if it is none.
std::optional<int> numberOf(const std::map<std::string, std::string>& macros, std::string name) {
  for (auto found = macros.find(name); found != macros.end(); found = macros.find(name))
    name = found->second;
  if (name.empty() || name.find_first_not_of("0123456789") != std::string::npos) return {};
  return std::stoi(name);
}

bool complainsOf(const std::string& preprocessed_text, std::string_view macro) {
  return preprocessed_text.find(fmt::format("#error \"{} must be", macro)) != std::string::npos;
}

// The switches for which each kernel file has a default.
std::map<fs::path, std::vector<const Switch*>> declaredSwitches() {
  std::map<fs::path, std::vector<const Switch*>> declared;
  const std::regex default_of("#ifndef (\\w+)\n#define \\1 ");
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kKernels)) {
    const fs::path extension = entry.path().extension();
    if (extension != ".clh" && extension != ".cl" && extension != ".h") continue;
    const std::string text = readFile(entry.path());
    for (auto it = std::sregex_iterator(text.begin(), text.end(), default_of);
         it != std::sregex_iterator(); ++it)
      for (const Switch& row : allSwitches())
        if (row.macro == (*it)[1].str()) declared[entry.path()].push_back(&row);
  }
  return declared;
}

TEST(SwitchTable, EveryDefaultStandsInOneKernelFile) {
  std::map<std::string_view, int> places;
  for (const auto& [file, rows] : declaredSwitches())
    for (const Switch* row : rows) ++places[row->macro];
  for (const Switch& row : allSwitches()) EXPECT_EQ(places[row.macro], 1) << row.macro;
}

TEST(SwitchTable, ConfigsHoldNothingElse) {
  const std::regex default_of("#ifndef (\\w+)\n#define \\1 ");
  int files = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kKernels)) {
    if (!entry.path().filename().string().ends_with("config.clh")) continue;
    ++files;
    const std::string text = readFile(entry.path());
    for (auto it = std::sregex_iterator(text.begin(), text.end(), default_of);
         it != std::sregex_iterator(); ++it)
      EXPECT_NO_THROW(switchNamed((*it)[1].str())) << entry.path();
  }
  EXPECT_GT(files, 1);
}

TEST(SwitchTable, KernelsHaveTheSameDefaults) {
  for (const auto& [file, rows] : declaredSwitches()) {
    const auto macros = macrosOf(preprocessed(file, ""));
    for (const Switch* row : rows) {
      if (row->values.folder.empty())
        EXPECT_EQ(numberOf(macros, std::string(row->macro)), row->standard)
            << row->macro << " in " << file;
      else
        EXPECT_EQ(macros.at(std::string(row->macro)), row->textOf(row->standard)) << row->macro;
    }
  }
}

TEST(SwitchTable, KernelsHaveTheSameNamedValues) {
  const auto macros = macrosOf(preprocessed(kKernels / "config.clh", ""));
  for (const Switch& row : allSwitches())
    for (std::size_t i = 0; row.values.folder.empty() && i < row.values.choices.size(); ++i)
      EXPECT_EQ(numberOf(macros, std::string(row.values.choices[i].constant)), static_cast<int>(i))
          << row.values.choices[i].constant;
}

// A method of the table for each file, and a file for each method.
TEST(SwitchTable, MethodsAreTheFilesOfTheirFolder) {
  int switches_of_methods = 0;
  for (const Switch& row : allSwitches()) {
    if (row.values.folder.empty()) continue;
    ++switches_of_methods;
    std::set<std::string> files, wanted;
    for (const fs::directory_entry& entry : fs::directory_iterator(kKernels / row.values.folder))
      if (const std::string name = entry.path().filename(); name.starts_with("method_"))
        files.insert(name);
    for (const Choice& choice : row.values.choices) {
      wanted.insert(fmt::format("method_{}.clh", choice.name));
      EXPECT_EQ(choice.constant, choice.name);
    }
    EXPECT_EQ(files, wanted) << row.macro;
  }
  EXPECT_EQ(switches_of_methods, 2);
}

TEST(SwitchTable, KernelsHaveTheSameRanges) {
  for (auto [file, rows] : declaredSwitches()) {
    // An unknown method is a file that is not there.
    std::erase_if(rows, [](const Switch* row) { return !row->values.folder.empty(); });
    // Values just within and just outside; each round sets all switches of the file.
    for (const int beyond : {0, 1})
      for (const bool upper : {false, true}) {
        std::string options;
        for (const Switch* row : rows)
          options += fmt::format("-D {}={} ", row->macro,
                                 upper ? row->values.most + beyond : row->values.least - beyond);
        const std::string text = preprocessed(file, options);
        for (const Switch* row : rows)
          EXPECT_EQ(complainsOf(text, row->macro), beyond == 1)
              << row->macro << " in " << file << " with " << options;
      }
    for (const Switch* row : rows) {
      if (row->values.listed.empty()) continue;
      for (int value = row->values.least; value < row->values.most; ++value) {
        const std::string option = fmt::format("-D {}={}", row->macro, value);
        EXPECT_EQ(complainsOf(preprocessed(file, option), row->macro), !row->values.allow(value))
            << option;
      }
    }
  }
}

TEST(SwitchTable, SweptValuesAreAllowed) {
  for (const Switch& row : allSwitches()) {
    EXPECT_TRUE(row.values.allow(row.standard)) << row.macro;
    EXPECT_TRUE(row.values.allow(row.of(KernelConfig{}))) << row.macro;
    for (const int value : row.sweep.values)
      EXPECT_TRUE(row.values.allow(value)) << row.macro << "=" << value;
  }
}

TEST(SwitchTable, ChoicesHaveOneNameEach) {
  EXPECT_EQ(choiceName(NormalMethod::kToksvig), "toksvig");
  EXPECT_EQ(choiceName(EdgeIntegral::kFit), "polynomial");
  for (const Switch& row : allSwitches())
    for (std::size_t i = 0; i < row.values.choices.size(); ++i)
      EXPECT_EQ(findChoice(row.values.choices, row.values.choices[i].name), static_cast<int>(i));
  EXPECT_EQ(parseChoice<LtcMethod>("tao21", "method"), LtcMethod::kTao21);
  const std::string unknown = errorOf([] { parseChoice<LtcMethod>("gmm", "method"); });
  EXPECT_EQ(unknown,
            "unknown method 'gmm'; methods are original, tao21, exact, mixture, covariance");
}

TEST(SwitchTable, UnknownSwitchesAreErrors) {
  EXPECT_EQ(switchNamed("KA").standard, 16);
  EXPECT_EQ(errorOf([] { switchNamed("KAA"); }), "no switch is called KAA");
}

}  // namespace
}  // namespace glintmark
