#include "host/report/record/terminal_text.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>

#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

constexpr std::size_t kLeastColumns = 20, kMostColumns = 1000;

std::vector<std::string> linesOf(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

// Where the character in column `column` begins.
std::size_t byteOf(std::string_view text, std::size_t column) {
  std::size_t byte = 0;
  for (std::size_t c = 0; byte < text.size(); ++byte)
    if ((text[byte] & 0xC0) != 0x80 && c++ == column) break;
  return byte;
}

std::string cut(std::string_view text, std::size_t begin, std::size_t end) {
  const std::size_t from = byteOf(text, begin);
  return std::string(text.substr(from, byteOf(text, end) - from));
}

bool isRule(std::string_view line) {
  return line.size() > 2 && line.find_first_not_of('-') == std::string_view::npos;
}

std::string withoutTail(std::string line) {
  line.resize(line.find_last_not_of(' ') + 1);
  return line;
}

/// The lines of one table: a header, a rule, rows and further rules.
class Table {
 public:
  explicit Table(std::vector<std::string> lines) : lines_(std::move(lines)) { findColumns(); }

  std::string fitted(std::size_t columns) const {
    std::size_t widest = 0;
    for (std::size_t c = 1; c < columns_.size(); ++c)
      widest = std::max(widest, columns_[c].end - columns_[c - 1].end);
    // Where a column of words leaves less than half of the line, its cells are broken too.
    const std::size_t key =
        std::min(columns_.front().end, std::max(columns / 2, columns - std::min(columns, widest)));
    std::string text;
    for (std::size_t c = 1; c < columns_.size();) {
      std::size_t last = c;
      while (last + 1 < columns_.size() &&
             key + columns_[last + 1].end - columns_[c - 1].end <= columns)
        ++last;
      if (c > 1) text += '\n';
      text += part(key, columns_[c - 1].end, columns_[last].end, columns);
      c = last + 1;
    }
    return text;
  }

  bool hasColumns() const { return columns_.size() > 1; }

 private:
  struct Column {
    std::size_t begin, end;
  };

  // Between columns of blanks in every line. Words below no header, and those of a header over
  // nothing, belong to the column on their right, where all end; next to the first column, which
  // is aligned to the left, to this.
  void findColumns() {
    std::vector<int> used(columnsOf(lines_[1]), 0);  // 1: by the header, 2: by rows, 3: by both
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (isRule(lines_[i])) continue;
      for (std::size_t c = 0; c < std::min(used.size(), columnsOf(lines_[i])); ++c)
        if (cut(lines_[i], c, c + 1) != " ") used[c] |= i == 0 ? 1 : 2;
    }
    bool over_nothing = false;
    for (std::size_t c = 0; c < used.size();) {
      if (used[c] == 0) {
        ++c;
        continue;
      }
      const std::size_t begin = c;
      int by = 0;
      for (; c < used.size() && used[c] != 0; ++c) by |= used[c];
      const bool goes_on =
          columns_.size() == 1 && (by == 2 || (by == 1 && begin == columns_.front().end + 1));
      if (over_nothing || goes_on)
        columns_.back().end = c;
      else
        columns_.push_back({begin, c});
      over_nothing = by != 3 && !goes_on && columns_.size() > 1;
    }
  }

  // Columns from `begin` on to `end`, the first of the table before them.
  std::string part(std::size_t key, std::size_t begin, std::size_t end, std::size_t columns) const {
    std::string text;
    for (const std::string& line : lines_) {
      if (isRule(line)) {
        text += std::string(std::min(columns, key + end - begin), '-') + '\n';
        continue;
      }
      const std::vector<std::string> names =
          cellLines(withoutTail(cut(line, 0, columns_.front().end)), key);
      const std::string padding(key - std::min(key, columnsOf(names.front())), ' ');
      std::string cells = cut(line, begin, end);
      if (key + end - begin > columns)
        cells = "  " + cells.substr(std::min(cells.find_first_not_of(' '), cells.size()));
      text += withoutTail(wrapped(names.front() + padding + cells, columns, key + 2)) + '\n';
      for (std::size_t i = 1; i < names.size(); ++i) text += names[i] + '\n';
    }
    return text;
  }

  std::vector<std::string> lines_;
  std::vector<Column> columns_;
};

// "  memory      125 GiB": what is said of it goes on below its beginning.
std::size_t indentOf(std::string_view line, std::size_t columns) {
  const std::size_t text = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = line.find("  ", text);
  if (gap != std::string_view::npos && gap < columns / 2) {
    const std::size_t value = line.find_first_not_of(' ', gap);
    if (value != std::string_view::npos && value < columns / 2) return value;
  }
  return text + 2;
}

std::string fittedLine(const std::string& line, std::size_t columns) {
  if (line.starts_with("score: ")) return line;  // programs look for it
  return isRule(line) ? line.substr(0, columns) : wrapped(line, columns, indentOf(line, columns));
}

}  // namespace

std::size_t terminalColumns() {
  winsize size = {};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    return std::clamp<std::size_t>(size.ws_col, kLeastColumns, kMostColumns);
  const std::string_view text = std::getenv("COLUMNS") != nullptr ? std::getenv("COLUMNS") : "";
  std::size_t columns = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), columns);
  if (error != std::errc() || end != text.data() + text.size() || columns == 0)
    return kTableColumnsLimit;
  return std::clamp(columns, kLeastColumns, kMostColumns);
}

std::size_t columnsOf(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<std::string> cellLines(std::string_view cell, std::size_t columns) {
  std::vector<std::string> lines;
  while (columnsOf(cell) > columns) {
    std::size_t end = byteOf(cell, columns);
    const std::size_t sign = cell.find_last_of("/, ", end - 1);
    if (sign != std::string_view::npos && sign + 1 > end / 3) end = sign + 1;
    lines.push_back(withoutTail(std::string(cell.substr(0, end))));
    cell.remove_prefix(end);
  }
  if (lines.empty() || !cell.empty()) lines.emplace_back(cell);
  return lines;
}

std::string wrapped(std::string_view line, std::size_t columns, std::size_t indent) {
  indent = std::min(indent, columns / 2);
  std::string text, rest(line);
  while (columnsOf(rest) > columns) {
    const std::size_t first = rest.find_first_not_of(' ');
    const std::size_t last = rest.rfind(' ', byteOf(rest, columns));
    const bool fits = last != std::string::npos && last > first;
    const std::size_t blank = fits ? last : rest.find(' ', first);
    if (blank == std::string::npos) break;
    const std::size_t next = rest.find_first_not_of(' ', blank);
    text += withoutTail(rest.substr(0, blank)) + '\n';
    rest = next == std::string::npos ? "" : std::string(indent, ' ') + rest.substr(next);
  }
  return text + rest;
}

std::string fitted(std::string_view text, std::size_t columns) {
  const std::vector<std::string> lines = linesOf(text);
  std::string out;
  for (std::size_t i = 0; i < lines.size();) {
    const bool is_table = i + 1 < lines.size() && !lines[i].empty() && isRule(lines[i + 1]);
    if (is_table && lines[i + 1].size() > columns) {
      std::size_t end = i;
      while (end < lines.size() && !lines[end].empty() &&
             columnsOf(lines[end]) <= lines[i + 1].size())
        ++end;
      const Table table({lines.begin() + static_cast<std::ptrdiff_t>(i),
                         lines.begin() + static_cast<std::ptrdiff_t>(end)});
      if (end > i + 1 && table.hasColumns()) {
        out += table.fitted(columns);
        i = end;
        continue;
      }
    }
    out += fittedLine(lines[i++], columns) + '\n';
  }
  if (!text.ends_with('\n') && !out.empty()) out.pop_back();
  return out;
}

void printFitted(std::string_view text) {
  fmt::print("{}", fitted(text, terminalColumns()));
}

}  // namespace glintmark
