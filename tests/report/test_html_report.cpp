#include "host/report/page/html_report.h"
#include "host/report/page/html_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/report/picture/heatmap.h"
#include "tests/report/sample_records.h"

namespace glintmark {
namespace {

// RFC 4648, section 10.
TEST(HtmlReport, Base64TestVectors) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe" + std::string(1, '\0')).substr(0, 3), "//4");
}

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

Results pageResults() {
  Record timed = sampleRecord("snow/steep", "shading_ms", 42);
  timed.paper = 2.5;
  Record broken = sampleRecord("snow/grazing", "shading_ms", 99);
  broken.valid = false;
  broken.note = "not valid: <script>alert(1)</script>";
  return {sampleRun(), {timed, broken, sampleRecord("snow/steep", "raster_ms", 12.5)}};
}

TEST(HtmlReport, ShowsFactsPaperAndRatio) {
  const std::string page = htmlReport(pageResults(), {}, {}, "results.json");
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_NE(page.find("<td>2.50</td><td class=\"here\">42.0</td>"), std::string::npos);
  EXPECT_NE(page.find("1.000\">16.8</td>"), std::string::npos);  // 42 / 2.5, the longest bar
  EXPECT_NE(page.find("cpu-device"), std::string::npos);
  EXPECT_NE(page.find("99.0!"), std::string::npos);
  EXPECT_EQ(countOf(page, "<table>"), countOf(page, "</table>"));
}

TEST(HtmlReport, ABusyMachineIsSaid) {
  Results results = pageResults();
  const char* const said = "the machine was busy";
  EXPECT_EQ(htmlReport(results, {}, {}, "results.json").find(said), std::string::npos);
  results.run.busy = "others kept 1.9 of 2 processors busy";
  const std::string html = htmlReport(results, {}, {}, "results.json");
  EXPECT_NE(html.find(said), std::string::npos);
  EXPECT_NE(html.find(results.run.busy), std::string::npos);
}

TEST(HtmlReport, NothingIsLoadedAndNothingEscapes) {
  const std::string page = htmlReport(pageResults(), {}, {}, "results.json");
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("href=\"http"), std::string::npos);
  EXPECT_EQ(countOf(page, "<link"), 1u);  // the empty icon
  EXPECT_NE(page.find("<link rel=\"icon\" href=\"data:,\">"), std::string::npos);
  EXPECT_EQ(page.find("<script>alert(1)"), std::string::npos);
  EXPECT_EQ(countOf(page, "<script"), 3u);  // records, Chart.js, ours
  EXPECT_EQ(countOf(page, "</script>"), 3u);
  EXPECT_NE(page.find("Some &quot;quoted&quot; processor"), std::string::npos);
}

TEST(HtmlReport, RecordsCanBeReadBack) {
  const std::string page = htmlReport(pageResults(), {}, {}, "results.json");
  const std::string open = "id=\"records\">";
  const std::size_t begin = page.find(open) + open.size();
  const auto json = nlohmann::json::parse(page.substr(begin, page.find("</script>") - begin));
  ASSERT_EQ(json.size(), 3u);
  EXPECT_EQ(json[1]["note"], "not valid: <script>alert(1)</script>");
}

TEST(HtmlReport, PicturesAreInside) {
  const ReportPicture picture{"cells & more.png", "foobar", "", {}};
  const std::string page = htmlReport(pageResults(), {}, {&picture, 1}, "results.json");
  EXPECT_NE(page.find("data:image/png;base64,Zm9vYmFy"), std::string::npos);
  EXPECT_NE(page.find("cells &amp; more.png"), std::string::npos);
}

TEST(HtmlReport, PicturesThatCannotBeReadAreSaidInTheirPlace) {
  const ReportPicture broken{"other.png", "", "cannot read <it>", {}};
  EXPECT_NE(htmlReport(pageResults(), {}, {&broken, 1}, "r").find("cannot read &lt;it&gt;"),
            std::string::npos);
}

TEST(HtmlReport, PicturesThatWouldMakeItTooLargeAreLeftOut) {
  const std::vector<ReportPicture> pictures = {{"first.png", std::string(3'000'000, 'a'), "", {}},
                                               {"second.png", std::string(6'000'000, 'b'), "", {}}};
  const std::string page = htmlReport(pageResults(), {}, pictures, "results.json");
  EXPECT_LT(page.size(), kMostPageBytes);
  EXPECT_EQ(countOf(page, "data:image/png"), 1u);
  EXPECT_NE(page.find("second.png is left out"), std::string::npos);
}

TEST(HtmlReport, HistogramsAreReadBackFromHeatmaps) {
  Image cells(330, 20, 1);
  for (int x = 0; x < cells.width; ++x)
    for (int y = 0; y < cells.height; ++y)
      cells.at(x, y)[0] = x < 57 ? static_cast<float>(8 + x) : (x % 2 == 0 ? -1.0f : 0.0f);
  Image picture = heatmapPicture(cells, {});
  for (float& value : picture.pixels) value = std::round(value * 255) / 255;  // as a PNG has it
  const CellDistribution read = heatmapDistribution(picture), truth = cellDistribution(cells);
  EXPECT_EQ(read.pixels_by_count, truth.pixels_by_count);
  EXPECT_EQ(read.mean, truth.mean);
  EXPECT_EQ(countOf(histogramSvg(read), "<rect"), 57u);
  EXPECT_EQ(histogramSvg(cellDistribution(Image(0, 0, 1))), "");
}

TEST(HtmlText, LinksAreRelativeAndPercentEncoded) {
  EXPECT_EQ(linkTo("results.json"), "./results.json");
  EXPECT_EQ(linkTo("../a b/50%#?\"'<.json"), "./../a%20b/50%25%23%3F%22%27%3C.json");
  EXPECT_EQ(linkTo("javascript:x"), "./javascript%3Ax");
  EXPECT_EQ(linkTo("\xC3\xA4"), "./%C3%A4");
}

}  // namespace
}  // namespace glintmark
