#include "host/report/page/pictures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/report/page/html_text.h"
#include "host/report/picture/heatmap.h"
#include "host/report/picture/image_io.h"
#include "host/report/picture/picture_strip.h"
#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

// A histogram that is read back from a picture is shown where its mean is the record's.
constexpr double kMeanTolerance = 0.02;

// Names of a strip's pictures, left to right, as the benchmarks put them.
std::string stripPanels(const PictureGroup& group, const std::vector<std::string>& methods) {
  std::vector<std::string> panels = methods;
  panels.insert(group.truth_first ? panels.begin() : panels.end(), "truth");
  if (group.differences)
    for (const std::string& method : methods) panels.push_back("|" + method + " − truth|");
  return fmt::format("{}", fmt::join(panels, ";"));
}

// The views of cases scene/view/method, knobs with the view, each with its methods.
std::vector<std::pair<CaseName, std::vector<std::string>>> methodsByView(
    std::span<const Record> records) {
  std::vector<std::pair<CaseName, std::vector<std::string>>> views;
  for (const std::string& text : caseNames(records)) {
    const CaseName name = CaseName::parse(text);
    if (name.words.size() < 3) continue;
    const CaseName view{{name.words[0], name.words[1]}, name.knobs};
    auto found = std::ranges::find(views, view, &decltype(views)::value_type::first);
    if (found == views.end()) found = views.insert(views.end(), {view, {}});
    found->second.push_back(name.words[2]);
  }
  return views;
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
    if (isHeatmapFile(picture.name)) picture.cells = heatmapDistribution(image);
    picture.name_height_px = stripNameHeight(image);
    picture.png_bytes = readFile(file);
  } catch (const Error& error) {
    picture.problem = error.what();
  }
  return picture;
}

PictureShelf::PictureShelf(std::span<const ReportPicture> pictures, std::size_t most_bytes)
    : pictures_(pictures), taken_(pictures.size(), false), bytes_left_(most_bytes) {}

bool PictureShelf::has(const std::string& name) const {
  return std::ranges::find(pictures_, name, &ReportPicture::name) != pictures_.end();
}

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

std::string PictureShelf::heatmaps(const PictureGroup& group, std::span<const Record> records) {
  std::string html;
  for (const std::string& name : caseNames(records)) {
    const Record* mean = CaseRecords(records, name).find(group.metric);
    if (mean == nullptr) continue;
    const std::string file = heatmapFile(CaseName::parse(name));
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
  return html.empty() ? "" : "<div class=\"pictures\">\n" + html + "</div>\n";
}

std::string PictureShelf::strips(const PictureGroup& group, const std::string& table,
                                 std::span<const Record> records) {
  std::string html;
  for (const auto& [view, methods] : methodsByView(records)) {
    const std::string file = table + "_" + view.fileStem() + ".png";
    if (group.optional && !has(file)) continue;
    const auto found = std::ranges::find(pictures_, file, &ReportPicture::name);
    html += figure(file, view.text(),
                   fmt::format(" class=\"strip\" data-panels=\"{}\" data-name-height=\"{}\"",
                               escapeHtml(stripPanels(group, methods)),
                               found == pictures_.end() ? 0 : found->name_height_px));
  }
  return html.empty() ? "" : "<div class=\"strips\">\n" + html + "</div>\n";
}

std::string PictureShelf::singles(const PictureGroup& group) {
  std::string html;
  for (const PictureSpec& picture : group.pictures)
    html += !has(picture.file) && !picture.missing.empty() ? missing(picture.missing)
                                                           : figure(picture.file, picture.caption);
  return group.large ? "<div class=\"pictures large\">\n" + html + "</div>\n" : html;
}

std::string PictureShelf::groupHtml(const PictureGroup& group, const std::string& table,
                                    std::span<const Record> records) {
  if (!group.metric.empty() &&
      std::ranges::find(records, group.metric, &Record::metric) == records.end())
    return "";
  std::string html;
  switch (group.kind) {
    case PictureGroup::Kind::kSingle:
      html = singles(group);
      break;
    case PictureGroup::Kind::kHeatmaps:
      html = heatmaps(group, records);
      break;
    case PictureGroup::Kind::kStrips:
      html = strips(group, table, records);
      break;
    case PictureGroup::Kind::kHidden:
      for (const PictureSpec& picture : group.pictures) take(picture.file);
      break;
  }
  if (html.empty()) return "";
  if (!group.text.empty()) html = fmt::format("<p>{}</p>\n", escapeHtml(group.text)) + html;
  if (!group.heading.empty()) html = fmt::format("<h3>{}</h3>\n", escapeHtml(group.heading)) + html;
  return html;
}

std::string PictureShelf::tablePictures(const TableSpec& table, std::span<const Record> records) {
  std::string html;
  for (const PictureGroup& group : table.pictures) html += groupHtml(group, table.name, records);
  std::string more;
  for (const ReportPicture& picture : pictures_)
    if (picture.name.starts_with(table.name + "_") &&
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
