// XML, element by element.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace glintmark {

class XmlText {
 public:
  using Attributes = std::vector<std::pair<std::string, std::string>>;

  /// An element whose children follow, up to close().
  void open(std::string_view tag, const Attributes& attributes);
  void close();
  /// An element without children.
  void leaf(std::string_view tag, const Attributes& attributes);
  /// All that was written, with a declaration. Every element is closed.
  std::string text() const;

 private:
  void line(std::string_view tag, const Attributes& attributes, std::string_view end);

  std::string body_;
  std::vector<std::string> open_;
};

}  // namespace glintmark
