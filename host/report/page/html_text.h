// Text and numbers as HTML.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/report/record/record.h"

namespace glintmark {

/// `text` with &, <, > and quotes as HTML writes them.
std::string escapeHtml(std::string_view text);

/// A relative path as the address of a link: what is not plain in a URI is written %XX, and a first
/// step with a colon is no scheme. [RFC 3986]
std::string linkTo(std::string_view path);

/// RFC 4648.
std::string base64(std::string_view bytes);

/// The median as a short number; marked, with the reason as tooltip, if it is not valid.
std::string numberHtml(const Record& record);

/// Distinct values of a field, in the order of their first appearance.
std::vector<std::string> distinctValues(std::span<const Record> records,
                                        std::string Record::*field);

/// A table that scrolls sideways where it must. `caption` and the cells are HTML; every cell of
/// `rows` is a whole <td> or <th> element.
std::string tableHtml(const std::string& caption, const std::vector<std::string>& header,
                      const std::vector<std::vector<std::string>>& rows);

/// A cell, and one that names its row; `html` goes in as it is.
std::string cellHtml(const std::string& html);
std::string rowNameHtml(const std::string& html);

}  // namespace glintmark
