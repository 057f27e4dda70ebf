// One table of a scene file: typed reads that check ranges, and a complaint about keys nobody read.
//
// Every read declares its key as known, so that finish() can list the known ones.
#pragma once
#include <toml++/toml.h>

#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glintmark {

/// Whatever a scene says ends in floats.
inline constexpr double kLargestNumber = std::numeric_limits<float>::max();

/// A closed range of numbers, or open at its lower end. NaN and infinity are never inside.
struct Range {
  double low = -kLargestNumber;
  double high = kLargestNumber;
  bool open_low = false;

  bool contains(double value) const {
    return (open_low ? value > low : value >= low) && value <= high;
  }
  /// As in "a number in (0, 1]".
  std::string text() const;
};
inline constexpr Range kFinite{};
inline constexpr Range kPositive{0, kLargestNumber, true};
inline constexpr Range kNotNegative{0, kLargestNumber, false};

/// "FILE:LINE: " of a node, the whole "--set KEY=VALUE: " if it came from the command line.
std::string locate(const toml::node& node, const std::string& file);

class SceneTable {
 public:
  /// `path` is the dotted path of the table for messages, empty for the file itself.
  SceneTable(const toml::table& table, std::string path, std::string file);

  bool has(std::string_view key);
  double number(std::string_view key, double fallback, const Range& range = kFinite);
  int integer(std::string_view key, int fallback, int low, int high);
  bool flag(std::string_view key, bool fallback);
  std::string text(std::string_view key, const std::string& fallback = "");
  /// Three numbers, or one that stands for all three.
  glm::dvec3 vector3(std::string_view key, const glm::dvec3& fallback,
                     const Range& range = kFinite);
  /// Two numbers, or one that stands for both.
  glm::dvec2 vector2(std::string_view key, const glm::dvec2& fallback,
                     const Range& range = kFinite);
  /// A list of colours, each three numbers.
  std::vector<glm::dvec3> colours(std::string_view key, const Range& range);
  std::optional<SceneTable> table(std::string_view key);
  /// The tables of [[key]], in order. Their paths carry their names, or else their positions.
  std::vector<SceneTable> tables(std::string_view key);
  /// All keys of this table with text values, in alphabetical order.
  std::vector<std::pair<std::string, std::string>> textEntries();

  /// Throws Error: where the key stands, its path, and the complaint ("is -1, expected ...").
  [[noreturn]] void fail(std::string_view key, const std::string& complaint) const;
  /// Throws Error if a key of the table was never asked for.
  void finish() const;

  bool isText(std::string_view key);
  const std::string& path() const { return path_; }
  const std::string& file() const { return file_; }

 private:
  const toml::node* find(std::string_view key);
  std::string pathOf(std::string_view key) const;
  double checkedNumber(std::string_view key, const toml::node& node, const Range& range) const;
  template <int kCount>
  glm::vec<kCount, double> vector(std::string_view key, const toml::node& node,
                                  const Range& range) const;

  const toml::table* table_;
  std::string path_;
  std::string file_;
  std::vector<std::string> known_;
};

}  // namespace glintmark
