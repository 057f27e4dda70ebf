// One self-contained page of a run: facts, the papers' tables beside ours, charts, pictures.
#pragma once
#include <span>
#include <string>

#include "host/report/records.h"

namespace glintmark {

struct ReportPicture {
  std::string name;       // file name, "cells_snow_steep.png"
  std::string png_bytes;  // the file as it is
};

/// The page as HTML. It loads nothing: style, script, charts' library and pictures are part of it.
/// Tables and pictures show without script. `source` names the results file, which is linked.
std::string htmlReport(const Results& results, std::span<const ReportPicture> pictures,
                       const std::string& source);

/// `text` with &, <, > and quotes as HTML writes them.
std::string escapeHtml(std::string_view text);

/// RFC 4648.
std::string base64(std::string_view bytes);

}  // namespace glintmark
