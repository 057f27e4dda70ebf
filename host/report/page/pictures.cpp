#include "host/report/page/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/report/page/html_text.h"
#include "host/report/picture/heatmap.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

constexpr const char* kHeatmapPrefix = "cells_";
constexpr const char* kAngleStrip = "angle_strip.png";
// A histogram that is read back from a picture is shown where its mean is the record's.
constexpr double kMeanTolerance = 0.02;

std::string withUnderscores(std::string name) {
  std::ranges::replace(name, '/', '_');
  std::ranges::replace(name, '=', '_');
  return name;
}

// "scene/view" and the method of "scene/view/method[/knob=value]"; the knob goes to the view.
struct ViewMethod {
  std::string view, method;
};
std::optional<ViewMethod> splitCase(const std::string& name) {
  const std::size_t first = name.find('/');
  const std::size_t second = first == std::string::npos ? first : name.find('/', first + 1);
  if (second == std::string::npos) return {};
  const std::size_t third = std::min(name.find('/', second + 1), name.size());
  return ViewMethod{name.substr(0, second) + name.substr(third),
                    name.substr(second + 1, third - second - 1)};
}

// Names of a strip's pictures, left to right, as the benchmarks put them.
std::string stripPanels(const std::string& table, const std::vector<std::string>& methods) {
  std::vector<std::string> panels = methods;
  if (table == "tao21") {
    panels.push_back("truth");
  } else {
    panels.insert(panels.begin(), "truth");
    for (const std::string& method : methods) panels.push_back("|" + method + " − truth|");
  }
  std::string joined;
  for (const std::string& panel : panels) joined += (joined.empty() ? "" : ";") + panel;
  return joined;
}

std::string missing(const std::string& what) {
  return "<p class=\"missing\">" + escapeHtml(what) + "</p>\n";
}

}  // namespace

ReportPicture readReportPicture(const std::filesystem::path& file) {
  ReportPicture picture;
  picture.name = file.filename().string();
  try {
    const Image image = readImage(file);
    if (picture.name.starts_with(kHeatmapPrefix)) picture.cells = heatmapDistribution(image);
    picture.png_bytes = readTextFile(file);
  } catch (const Error& error) {
    picture.problem = error.what();
  }
  return picture;
}

PictureShelf::PictureShelf(std::span<const ReportPicture> pictures, std::size_t most_bytes)
    : pictures_(pictures), taken_(pictures.size(), false), bytes_left_(most_bytes) {}

const ReportPicture* PictureShelf::take(const std::string& name) {
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    if (taken_[i] || pictures_[i].name != name) continue;
    taken_[i] = true;
    return &pictures_[i];
  }
  return nullptr;
}

std::string PictureShelf::image(const ReportPicture& picture, const std::string& alt) {
  if (!picture.problem.empty()) return missing(picture.problem);
  const std::string data = base64(picture.png_bytes);
  if (data.size() > bytes_left_)
    return missing(picture.name +
                   " is left out, the page would grow too large; it is in the folder");
  bytes_left_ -= data.size();
  return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", escapeHtml(alt), data);
}

std::string PictureShelf::figure(const std::string& name, const std::string& caption,
                                 const std::string& attributes, const std::string& below) {
  const ReportPicture* picture = take(name);
  if (picture == nullptr) return missing(name + " is not in the folder");
  return fmt::format("<figure{}>{}<figcaption>{}</figcaption>{}</figure>\n", attributes,
                     image(*picture, caption), escapeHtml(caption), below);
}

std::string PictureShelf::heatmaps(std::span<const Record> records) {
  std::string html;
  for (const std::string& name : caseNames(records)) {
    const Record* mean = CaseRecords(records, name).find("cells_mean");
    if (mean == nullptr) continue;
    const std::string file = kHeatmapPrefix + withUnderscores(name) + ".png";
    const auto found = std::ranges::find(pictures_, file, &ReportPicture::name);
    std::string below;
    if (found != pictures_.end() && found->cells.glint_px > 0 &&
        std::abs(found->cells.mean / mean->value.median - 1) < kMeanTolerance)
      below = histogramSvg(found->cells);
    html += figure(
        file,
        fmt::format("{}: {} cells a pixel in the mean", name, compactNumber(mean->value.median)),
        "", below);
  }
  if (html.empty()) return "";
  html =
      "<h3>Cells visited per pixel</h3>\n<p>False colours from 8 to 64 cells, pixels over cells "
      "below.</p>\n<div class=\"pictures\">\n" +
      html + "</div>\n<h3>Cells over the angle of view</h3>\n";
  if (std::ranges::find(pictures_, kAngleStrip, &ReportPicture::name) == pictures_.end())
    return html + missing(fmt::format("No angle strip in the folder; glintmark heatmap "
                                      "--sweep-angle -o FOLDER/{} draws one",
                                      kAngleStrip));
  return html + figure(kAngleStrip, "screen_plane, from steep to grazing");
}

std::string PictureShelf::strips(const std::string& table, std::span<const Record> records) {
  std::vector<std::pair<std::string, std::vector<std::string>>> views;
  for (const std::string& name : caseNames(records)) {
    const auto parts = splitCase(name);
    if (!parts || parts->method.find('=') != std::string::npos) continue;
    auto found = std::ranges::find(views, parts->view, &decltype(views)::value_type::first);
    if (found == views.end()) found = views.insert(views.end(), {parts->view, {}});
    found->second.push_back(parts->method);
  }
  std::string html;
  for (const auto& [view, methods] : views) {
    const std::string file = table + "_" + withUnderscores(view) + ".png";
    const bool here = std::ranges::find(pictures_, file, &ReportPicture::name) != pictures_.end();
    // Distances of [TAN05]'s zoom-out are measured without a picture each.
    if (!here && table == "tan05") continue;
    html += figure(file, view,
                   fmt::format(" class=\"strip\" data-panels=\"{}\"",
                               escapeHtml(stripPanels(table, methods))));
  }
  if (html.empty()) return "";
  return "<h3>Side by side</h3>\n<p>Choose two pictures and move the slider.</p>\n<div "
         "class=\"strips\">\n" +
         html + "</div>\n";
}

std::string PictureShelf::tablePictures(const std::string& table, std::span<const Record> records) {
  std::string html;
  if (table == "zk16") html += heatmaps(records);
  if (table == "tao21" || table == "tan05") html += strips(table, records);
  if (table == "msbrdf") {
    html += "<div class=\"pictures large\">\n" +
            figure("msbrdf_energy.png", "Energy over roughness and incidence") +
            figure("msbrdf_sweep.png", "Rough clay: rows by model, columns by roughness") +
            "</div>\n";
  }
  if (table == "effects") take("effects_matrix.png");  // the table has its numbers
  std::string more;
  for (const ReportPicture& picture : pictures_)
    if (picture.name.starts_with(table + "_") &&
        !taken_[static_cast<std::size_t>(&picture - pictures_.data())])
      more += figure(picture.name, picture.name);
  return more.empty() ? html : html + "<div class=\"pictures\">\n" + more + "</div>\n";
}

std::string PictureShelf::otherPictures() {
  std::string html;
  for (std::size_t i = 0; i < pictures_.size(); ++i)
    if (!taken_[i]) html += figure(pictures_[i].name, pictures_[i].name);
  return html.empty() ? ""
                      : "<section>\n<h2 id=\"pictures\">More pictures</h2>\n<div "
                        "class=\"pictures\">\n" +
                            html + "</div>\n</section>\n";
}

std::string histogramSvg(const CellDistribution& cells) {
  if (cells.glint_px == 0) return "";
  constexpr int kWidth = 360, kHeight = 64, kBase = 50, kFirst = 8, kLast = 64;
  const auto most = *std::ranges::max_element(cells.pixels_by_count);
  const double step = static_cast<double>(kWidth) / (kLast - kFirst + 1);
  std::string bars;
  for (int n = kFirst; n <= kLast && n < static_cast<int>(cells.pixels_by_count.size()); ++n) {
    const std::size_t pixels = cells.pixels_by_count[static_cast<std::size_t>(n)];
    if (pixels == 0) continue;
    const double height =
        std::max(kBase * static_cast<double>(pixels) / static_cast<double>(most), 0.5);
    bars += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>{} cells: {} "
        "px</title></rect>",
        (n - kFirst) * step, kBase - height, step * 0.86, height, n, pixels);
  }
  return fmt::format(
      "<svg class=\"histogram\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Pixels over cells, "
      "from {:.0f} to {:.0f}, mean {:.1f}\">{}<text x=\"0\" y=\"62\">8</text><text x=\"{}\" "
      "y=\"62\" "
      "text-anchor=\"middle\">cells a pixel</text><text x=\"{}\" y=\"62\" "
      "text-anchor=\"end\">64</text></svg>",
      kWidth, kHeight, cells.min, cells.max, cells.mean, bars, kWidth / 2, kWidth);
}

}  // namespace glintmark
