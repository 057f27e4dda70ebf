#include "host/report/page/html_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "host/report/record/text_table.h"

namespace glintmark {

std::string escapeHtml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string linkTo(std::string_view path) {
  constexpr std::string_view kPlain = "-._~/";
  std::string link = path.starts_with('/') ? "" : "./";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       kPlain.find(c) != std::string_view::npos;
    link += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return link;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

std::string numberHtml(const Record& record) {
  const std::string text = compactNumber(record.value.median);
  return record.valid ? text
                      : fmt::format("<span class=\"bad\" title=\"{}\">{}!</span>",
                                    escapeHtml(record.note), text);
}

std::vector<std::string> distinctValues(std::span<const Record> records,
                                        std::string Record::*field) {
  std::vector<std::string> names;
  for (const Record& record : records)
    if (std::ranges::find(names, record.*field) == names.end()) names.push_back(record.*field);
  return names;
}

std::string tableHtml(const std::string& caption, const std::vector<std::string>& header,
                      const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<div class=\"wide\"><table>\n";
  if (!caption.empty()) html += "<caption>" + caption + "</caption>\n";
  html += "<thead><tr>";
  for (const std::string& name : header) html += "<th scope=\"col\">" + name + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) html += fmt::format("<tr>{}</tr>\n", fmt::join(row, ""));
  return html + "</tbody></table></div>\n";
}

std::string cellHtml(const std::string& html) {
  return "<td>" + html + "</td>";
}

std::string rowNameHtml(const std::string& html) {
  return "<th scope=\"row\">" + html + "</th>";
}

}  // namespace glintmark
