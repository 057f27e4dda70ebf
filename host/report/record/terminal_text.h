// What is printed for people to read, no wider than they see. Files never depend on it.
#pragma once
#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace glintmark {

/// Of the terminal that the standard output goes to; else of the variable COLUMNS; else 100.
std::size_t terminalColumns();

/// Columns that UTF-8 takes, one for each code point.
std::size_t columnsOf(std::string_view text);

/// `cell` in lines of at most `columns` (1 or more), broken behind a '/', ',' or blank where one
/// stands beyond the line's first third. One line at least.
std::vector<std::string> cellLines(std::string_view cell, std::size_t columns);

/// One line, broken at blanks; what follows its first line is indented by `indent`. Words that are
/// wider stay whole.
std::string wrapped(std::string_view line, std::size_t columns, std::size_t indent);

/// Lines and text tables of at most `columns`. A table that is wider becomes several below each
/// other, the first column in each, with the other columns in turn.
std::string fitted(std::string_view text, std::size_t columns);

/// Prints `text` on the standard output, fitted to the terminal.
void printFitted(std::string_view text);

/// fmt::print(), fitted to the terminal.
template <typename... T>
void printText(fmt::format_string<T...> format, T&&... values) {
  printFitted(fmt::format(format, std::forward<T>(values)...));
}

}  // namespace glintmark
