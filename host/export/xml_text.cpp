#include "host/export/xml_text.h"

#include <cassert>

#include "host/core/xml_escape.h"

namespace glintmark {
void XmlText::line(std::string_view tag, const Attributes& attributes, std::string_view end) {
  body_.append(2 * open_.size(), ' ').append("<").append(tag);
  for (const auto& [name, value] : attributes)
    body_.append(" ").append(name).append("=\"").append(escapedXml(value)).append("\"");
  body_.append(end).append("\n");
}

void XmlText::open(std::string_view tag, const Attributes& attributes) {
  line(tag, attributes, ">");
  open_.emplace_back(tag);
}

void XmlText::close() {
  assert(!open_.empty());
  const std::string tag = std::move(open_.back());
  open_.pop_back();
  body_.append(2 * open_.size(), ' ').append("</").append(tag).append(">\n");
}

void XmlText::leaf(std::string_view tag, const Attributes& attributes) {
  line(tag, attributes, "/>");
}

std::string XmlText::text() const {
  assert(open_.empty());
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n" + body_;
}

}  // namespace glintmark
