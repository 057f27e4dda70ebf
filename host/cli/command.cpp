#include "host/cli/command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <string_view>
#include <vector>

#include "host/core/error.h"
#include "host/core/unknown_name.h"
#include "host/report/record/terminal_text.h"

namespace glintmark {
namespace {

// Columns of names beside their meaning; where both do not go on a line, they stand below each
// other.
constexpr std::size_t kNameColumns = 30, kLeastColumnsForBoth = 60;
constexpr std::size_t kMostHelpColumns = 100;

// Help as wide as the terminal is.
class TerminalFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return entry(make_option_name(option, is_positional) + make_option_opts(option),
                 make_option_desc(option));
  }
  std::string make_subcommand(const CLI::App* command) const override {
    return entry(command->get_name(), command->get_description());
  }
  std::string make_description(const CLI::App* app) const override {
    return wrapped(app->get_description(), columns_, 0) + "\n";
  }
  std::string make_usage(const CLI::App* app, std::string name) const override {
    return fitted(CLI::Formatter::make_usage(app, name), columns_);
  }
  // Prose is filled anew from point to point; commands are broken as a shell takes them.
  std::string make_footer(const CLI::App* app) const override {
    std::istringstream lines(app->get_footer());
    std::string text, prose;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with(' ')) {
        text += command(line);
        continue;
      }
      prose += (prose.empty() ? "" : " ") + line;
      if (lines.peek() != ' ' && !lines.eof() && !line.ends_with('.') && !line.ends_with(':'))
        continue;
      text += wrapped(prose, columns_, 0) + "\n";
      prose.clear();
    }
    return text;
  }

 private:
  std::string entry(const std::string& name, const std::string& meaning) const {
    const bool both = columns_ >= kLeastColumnsForBoth;
    const std::size_t column = both ? std::min(kNameColumns, columns_ / 3) : 6;
    std::string text = "  " + name;
    if (meaning.empty()) return text + "\n";
    if (both && text.size() < column)
      text.resize(column, ' ');
    else
      text = fitted(text, columns_) + "\n" + std::string(column, ' ');
    const std::size_t begin = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
    return text.substr(0, begin) + wrapped(text.substr(begin) + meaning, columns_, column) + "\n";
  }

  std::string command(const std::string& line) const {
    constexpr std::size_t kContinuation = 2, kIndent = 4;
    const std::size_t note = line.find("    # ");
    if (columnsOf(line) > columns_ && note != std::string::npos)
      return command(line.substr(0, note)) + wrapped("  " + line.substr(note + 4), columns_, 2) +
             "\n";
    std::string text = wrapped(line, columns_ - kContinuation, kIndent);
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 3)
      text.insert(at, " \\");
    return text + "\n";
  }

  const std::size_t columns_ = std::min(terminalColumns(), kMostHelpColumns);
};

// Options of the chosen command, then the program's, each once.
std::vector<std::string> knownOptions(const CLI::App& app, const CLI::App& command) {
  std::vector<std::string> known;
  for (const CLI::App* level : {&command, &app}) {
    for (const CLI::Option* option : level->get_options()) {
      const std::string name = option->get_name();
      if (option->get_positional() || std::ranges::find(known, name) != known.end()) continue;
      known.push_back(name);
    }
  }
  return known;
}

std::vector<std::string> knownCommands(const CLI::App& app) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    known.push_back(command->get_name());
  return known;
}

// The innermost command that was named, or the program itself.
CLI::App& chosenCommand(CLI::App& app) {
  CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  return *command;
}

// "glintmark fit ltc"
std::string pathOf(CLI::App& command) {
  CLI::App* parent = command.get_parent();
  return (parent == nullptr ? "" : pathOf(*parent) + " ") + command.get_name();
}

// One sentence for whatever CLI11 did not like.
std::string explain(CLI::App& app, const CLI::ParseError& error) {
  CLI::App& command = chosenCommand(app);
  const std::string name = command.get_name();
  const bool has_commands = !command.get_subcommands(nullptr).empty();
  for (const std::string& word : app.remaining(true)) {
    if (word.starts_with("-")) {
      return unknownName("option", word, knownOptions(app, command), "options of " + name);
    }
    if (has_commands) {
      return unknownName("command", word, knownCommands(command), "commands of " + name);
    }
    return fmt::format("'{}' is one argument too many for {}", word, name);
  }
  if (has_commands && error.get_name() == "RequiredError") {
    return fmt::format("no command given; commands of {} are {} (see {} --help)", name,
                       listOf(knownCommands(command), "and"), pathOf(command));
  }
  return fmt::format("{} (see {} --help)", error.what(), pathOf(command));
}

}  // namespace

CommandOption& CommandOption::typeName(const std::string& name) {
  option_->type_name(name);
  return *this;
}

CommandOption& CommandOption::required() {
  option_->required();
  return *this;
}

CommandOption& CommandOption::oneValueEach() {
  option_->allow_extra_args(false);
  return *this;
}

CommandOption& CommandOption::values(int least, int most) {
  option_->expected(least, most);
  return *this;
}

CommandOption& CommandOption::nonNegative() {
  option_->check(CLI::Validator(
      [](const std::string& text) {
        double value = 0;
        const bool right = CLI::detail::lexical_cast(text, value) && value >= 0;
        return right ? std::string() : fmt::format("'{}' is not a number from 0 on", text);
      },
      ""));
  return *this;
}

bool CommandOption::given() const {
  return option_->count() > 0;
}

Command Command::subcommand(const std::string& name, const std::string& help) {
  return Command(*app_->add_subcommand(name, help));
}

void Command::requireSubcommand() {
  app_->require_subcommand(1);
}

void Command::shareOptions() {
  for (CLI::App* command : app_->get_subcommands(nullptr)) command->fallthrough();
}

template <typename T>
CommandOption Command::option(const std::string& names, T& value, const std::string& help) {
  CLI::Option* option = app_->add_option(names, value, help);
  // An empty value is that of a variable of a shell that was never set.
  option->check(CLI::Validator(
      [](const std::string& text) { return std::string(text.empty() ? "its value is empty" : ""); },
      ""));
  return CommandOption(*option);
}

template CommandOption Command::option(const std::string&, std::string&, const std::string&);
template CommandOption Command::option(const std::string&, int&, const std::string&);
template CommandOption Command::option(const std::string&, double&, const std::string&);
template CommandOption Command::option(const std::string&, std::uint32_t&, const std::string&);
template CommandOption Command::option(const std::string&, std::uint64_t&, const std::string&);
template CommandOption Command::option(const std::string&, std::optional<double>&,
                                       const std::string&);
template CommandOption Command::option(const std::string&, std::vector<double>&,
                                       const std::string&);
template CommandOption Command::option(const std::string&, std::vector<std::string>&,
                                       const std::string&);

CommandOption Command::flag(const std::string& names, bool& value, const std::string& help) {
  return CommandOption(*app_->add_flag(names, value, help));
}

void Command::footer(const std::string& text) {
  app_->footer(text);
}

void Command::callback(const std::function<void()>& call) {
  app_->callback(call);
}

CommandParser::CommandParser(const std::string& name, const std::string& description,
                             const std::string& version)
    : app_(std::make_unique<CLI::App>(description, name)) {
  app_->formatter(std::make_shared<TerminalFormatter>());
  app_->set_version_flag("--version", version);
}

CommandParser::~CommandParser() = default;

Command CommandParser::program() {
  return Command(*app_);
}

std::optional<int> CommandParser::parse(int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app_->exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    throw Error(explain(*app_, error));
  }
  return std::nullopt;
}

}  // namespace glintmark
