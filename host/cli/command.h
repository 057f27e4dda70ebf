// Commands, their options and what a command line says of them. The parser is CLI11; only
// command.cpp includes it, because every file that does takes seconds more to compile.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace glintmark {

/// Handle of one option, flag or positional argument. Valid as long as its parser.
class CommandOption {
 public:
  explicit CommandOption(CLI::Option& option) : option_(&option) {}

  /// What the help calls its value: FILE, WxH.
  CommandOption& typeName(const std::string& name);
  CommandOption& required();
  /// Each occurrence takes one value, so that words behind it are arguments of their own; for
  /// options that may be repeated.
  CommandOption& oneValueEach();
  /// From `least` to `most` values behind one occurrence.
  CommandOption& values(int least, int most);
  /// Values below 0 are refused.
  CommandOption& nonNegative();

  /// Did the parsed command line name it?
  bool given() const;

 private:
  CLI::Option* option_;
};

/// Handle of the program or one of its commands. Valid as long as its parser.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  Command subcommand(const std::string& name, const std::string& help);
  /// A command line that names none of the subcommands is refused.
  void requireSubcommand();
  /// The subcommands so far also know this command's own options.
  void shareOptions();

  /// `names` as "--size", "-o,--output", or "scene" for a positional argument; parsing writes
  /// `value`, which must outlive it. T: std::string, int, double, std::uint32_t,
  /// std::uint64_t, std::optional<double>, std::vector<double> or std::vector<std::string>.
  template <typename T>
  CommandOption option(const std::string& names, T& value, const std::string& help);
  /// Sets `value`; "--star,!--no-star" also has a name that clears it.
  CommandOption flag(const std::string& names, bool& value, const std::string& help);

  /// Text below the help.
  void footer(const std::string& text);
  /// Called once the whole command line is parsed, if it names this command.
  void callback(const std::function<void()>& call);

 private:
  CLI::App* app_;
};

/// Owns the program's commands and parses command lines.
class CommandParser {
 public:
  /// `version` is what --version prints.
  CommandParser(const std::string& name, const std::string& description,
                const std::string& version);
  ~CommandParser();
  CommandParser(const CommandParser&) = delete;
  CommandParser& operator=(const CommandParser&) = delete;

  Command program();

  /// Fills the options' values and calls the callbacks. Returns the exit code if the command line
  /// asked for help or the version, which are printed, and nothing if there is something to run.
  /// Throws Error, one sentence for whatever is wrong with the command line.
  std::optional<int> parse(int argc, const char* const* argv);

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace glintmark
