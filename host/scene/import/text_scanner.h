// Numbers and words of text files.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace glintmark {

/// The number that `word` is: decimal with a point or a lone comma, with or without digits on
/// either side of it, a sign, an exponent (also Fortran's D); nan, inf and how Windows writes them.
/// Beyond the range of doubles: 0 or infinity. Nothing for any other word.
std::optional<double> parseNumber(std::string_view word);

/// Takes the next word of a line off it, up to a blank or a tab; empty at the end.
std::string_view takeWord(std::string_view& line);

/// Lines of a text that end in \n, \r\n or \r.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  /// False at the end of the text. `line` comes without its end.
  bool next(std::string_view& line);
  /// Of the line that next() gave last, from 1.
  std::size_t number() const { return number_; }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// Bytes of a text file as UTF-8 without a byte order mark; UTF-16 with one is converted.
std::string toUtf8(std::string bytes);

}  // namespace glintmark
