// Commands that help and documents show: each is taken as it stands.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "host/core/atomic_file.h"
#include "host/report/picture/image_io.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = GLINTMARK_SOURCE_DIR;

// Lines without their notes; what ends in a backslash goes on in the next.
std::vector<std::string> joinedLines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines = {""};
  for (std::string line; std::getline(stream, line);) {
    const std::size_t note = line.find(" # ");
    if (note != std::string::npos) line.resize(note);
    const bool goes_on = line.ends_with('\\');
    if (goes_on) line.pop_back();
    lines.back() += std::regex_replace(line, std::regex(" +"), " ");
    while (lines.back().ends_with(' ')) lines.back().pop_back();
    if (goes_on)
      lines.back() += ' ';
    else
      lines.emplace_back();
  }
  for (std::string& line : lines) line = std::regex_replace(line, std::regex(" +"), " ");
  return lines;
}

// From "glintmark" on, of each part of a line that has it as a word of its own.
std::vector<std::string> commandsOf(const std::string& line) {
  std::vector<std::string> commands;
  const std::regex separator(" && ");
  for (std::sregex_token_iterator part(line.begin(), line.end(), separator, -1), end; part != end;
       ++part) {
    const std::string text = " " + part->str() + " ";
    std::smatch found;
    if (std::regex_search(text, found, std::regex(" (\\./run|\\S*bin/glintmark|glintmark) (.*) $")))
      commands.push_back("glintmark " + found[2].str());
  }
  return commands;
}

std::vector<std::vector<std::string>> allCommands() {
  std::vector<std::vector<std::string>> all = {{}};
  const auto add = [&](const std::vector<std::string>& above) {
    std::vector<std::string> words = above;
    words.push_back("--help");
    std::istringstream help(runGlintmark(words, {"COLUMNS=100"}).out);
    bool listed = false;
    for (std::string line; std::getline(help, line);) {
      if (line == "Subcommands:") listed = true;
      std::smatch name;
      if (!listed || !std::regex_search(line, name, std::regex("^  ([a-z]+) "))) continue;
      all.push_back(above);
      all.back().push_back(name[1]);
    }
  };
  add({});
  add({"fit"});
  return all;
}

std::vector<std::string> examplesOf(std::vector<std::string> command, const char* columns) {
  command.emplace_back("--help");
  const std::string help = runGlintmark(command, {columns}).out;
  const std::size_t begin = help.find("Examples:\n");
  std::vector<std::string> examples;
  if (begin == std::string::npos) return examples;
  for (const std::string& line : joinedLines(help.substr(begin)))
    if (line.starts_with(' '))
      for (std::string& found : commandsOf(line)) examples.push_back(std::move(found));
  return examples;
}

// What commands of this project say in blocks of a document.
std::vector<std::string> commandsIn(const fs::path& document) {
  const std::regex other("glintmark (test|lint|mutants|fuzz|tidy|sanitize|coverage)( .*|$)");
  std::vector<std::string> commands;
  bool in_block = false;
  for (const std::string& line : joinedLines(readFile(document))) {
    if (line.starts_with("```")) in_block = !in_block;
    if (!in_block || !std::regex_search(line, std::regex("^(\\./run|glintmark|mpirun) "))) continue;
    for (std::string& found : commandsOf(line))
      if (!std::regex_match(found, other)) commands.push_back(std::move(found));
  }
  return commands;
}

// A folder with everything that examples read.
class ExampleFolder {
 public:
  ExampleFolder() {
    Image picture(16, 16, 3);
    for (float& value : picture.pixels) value = 0.5f;
    for (const char* name :
         {"zk16", "exact", "a", "b", "lean", "truth", "height", "stone_normal"}) {
      writeExr(picture, folder_ / (std::string(name) + ".exr"));
      writePng(picture, folder_ / (std::string(name) + ".png"));
    }
    writePng(picture, folder_ / "FILE.png");
    const fs::path run = kSource / "results/pocl-3.1-xeon-avx512-2-cores/2026-11-30/results.json";
    for (const char* name :
         {"before", "after", "mine", "yours", "theirs", "results/latest", "results/one/2026-11-26",
          "results/two/2026-11-26", "results/scale", "docs", "data"}) {
      fs::create_directories(folder_ / name);
      if (std::string(name).front() != 'd') fs::copy_file(run, folder_ / name / "results.json");
    }
  }

  // The exit code of a command that has no device, ended after some seconds.
  int run(const std::string& command) const {
    std::string words = command.substr(std::string("glintmark ").size());
    words = std::regex_replace(words, std::regex("--device \\S+"), "");
    std::ofstream(folder_ / "run.sh")
        << "cd '" << folder_.path().string() << "' && exec timeout -s INT 5 '"
        << GLINTMARK_BINARY_DIR << "/bin/glintmark' --device nowhere " << words
        << " >out.txt 2>err.txt";
    const int status = std::system(("sh '" + (folder_ / "run.sh").string() + "'").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string error() const { return readFile(folder_ / "err.txt"); }

 private:
  TempFolder folder_;
};

// Exit codes of what was understood: done, no such device, interrupted.
void expectUnderstood(const ExampleFolder& folder, const std::string& command) {
  const int code = folder.run(command);
  EXPECT_TRUE(code == 0 || code == 3 || code == 124 || code == 130)
      << command << " ends with " << code << ": " << folder.error();
}

TEST(Examples, OfEveryCommandAreUnderstood) {
  const ExampleFolder folder;
  const std::vector<std::vector<std::string>> commands = allCommands();
  EXPECT_GE(commands.size(), 20u);
  for (const std::vector<std::string>& command : commands) {
    const std::vector<std::string> examples = examplesOf(command, "COLUMNS=100");
    const bool is_group = command == std::vector<std::string>{"fit"};
    EXPECT_TRUE(is_group || !examples.empty()) << (command.empty() ? "" : command.back());
    for (const std::string& example : examples) expectUnderstood(folder, example);
  }
}

TEST(Examples, AreTheSameOnNarrowTerminals) {
  for (const std::vector<std::string>& command : allCommands())
    EXPECT_EQ(examplesOf(command, "COLUMNS=40"), examplesOf(command, "COLUMNS=100"))
        << (command.empty() ? "" : command.back());
}

TEST(Examples, OfDocumentsAreUnderstood) {
  const ExampleFolder folder;
  std::vector<std::string> commands = commandsIn(kSource / "README.md");
  EXPECT_GE(commands.size(), 15u);
  for (const fs::directory_entry& entry : fs::directory_iterator(kSource / "docs"))
    if (entry.path().extension() == ".md")
      for (std::string& command : commandsIn(entry.path())) commands.push_back(std::move(command));
  EXPECT_GE(commands.size(), 22u);
  for (const std::string& command : commands) expectUnderstood(folder, command);
}

// What is left of the columns when words are broken at blanks alone.
TEST(Help, KeepsToTheColumns) {
  for (const std::vector<std::string>& command : allCommands())
    for (const std::size_t columns : {40, 60, 72, 100}) {
      std::vector<std::string> words = command;
      words.emplace_back("--help");
      std::istringstream help(runGlintmark(words, {"COLUMNS=" + std::to_string(columns)}).out);
      for (std::string line; std::getline(help, line);) {
        const std::size_t text = std::min(line.find_first_not_of(' '), line.size());
        const bool is_one_word = line.find(' ', text) == std::string::npos || line.ends_with(" \\");
        EXPECT_TRUE(line.size() <= columns || is_one_word) << columns << ": " << line;
      }
    }
}

}  // namespace
}  // namespace glintmark
