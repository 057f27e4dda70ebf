// The report's page in a real browser. Skipped only where there is no chromium.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "host/core/atomic_file.h"
#include "host/experiment/all_tables.h"
#include "host/report/page/html_report.h"
#include "host/report/page/runs_report.h"
#include "host/report/picture/heatmap.h"
#include "host/report/picture/image_io.h"
#include "host/report/picture/picture_strip.h"
#include "tests/browser/chromium.h"
#include "tests/experiment/sample_run.h"
#include "tests/report/sample_records.h"

namespace glintmark {
namespace {

constexpr int kPhoneWidth_px = 360;

class Page : public testing::Test {
 protected:
  void SetUp() override {
    if (findChromium().empty())
      GTEST_SKIP() << "chromium is not in PATH (Debian package chromium): the page is not tested";
    writePictures();
    html_ = htmlReport(sample_.results(), allTableSpecs(), pictures_, "results.json");
    page_ = folder_ / "page.html";
    writeFile(page_, html_);
  }

  // A heatmap, a strip; msbrdf's pictures and other heatmaps are missing.
  void writePictures() {
    Image cells(320, 180, 1);
    for (int y = 0; y < cells.height; ++y)
      for (int x = 0; x < cells.width; ++x) cells.at(x, y)[0] = static_cast<float>(8 + x % 9);
    writePng(heatmapPicture(cells, {.title = "snow/steep"}), folder_ / "cells_snow_steep.png");
    std::vector<std::pair<std::string, Image>> strip;
    for (const char* name : {"original", "tao21", "exact", "truth"}) {
      strip.emplace_back(name, Image(64, 48, 3));
      std::ranges::fill(strip.back().second.pixels, static_cast<float>(strip.size()) / 5);
    }
    writePng(pictureStrip(strip), folder_ / "tao21_area_cloth_near.png");
    for (const char* name : {"cells_snow_steep.png", "tao21_area_cloth_near.png"})
      pictures_.push_back(readReportPicture(folder_ / name));
  }

  // A data attribute that the page's script left on the root element.
  static std::string rootData(const std::string& dom, const std::string& name) {
    const std::string root = dom.substr(0, dom.find("<head"));
    const std::string key = "data-" + name + "=\"";
    const std::size_t begin = root.find(key);
    if (begin == std::string::npos) return "(none)";
    const std::size_t value = begin + key.size();
    return root.substr(value, root.find('"', value) - value);
  }

  std::filesystem::path screenshot(const std::string& name, std::vector<std::string> options) {
    std::filesystem::path file = folder_ / name;
    options.push_back("--screenshot=" + file.string());
    options.push_back("--window-size=1200,2400");
    const BrowserResult result = runChromium(page_, options);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.console, "");
    return file;
  }

  SampleRun sample_;
  TempFolder folder_;
  std::vector<ReportPicture> pictures_;
  std::string html_;
  std::filesystem::path page_;
};

// Mean and standard deviation of all display values.
std::pair<double, double> meanAndSpread(const Image& image) {
  double sum = 0, squares = 0;
  for (const float value : image.pixels) {
    sum += value;
    squares += static_cast<double>(value) * value;
  }
  const auto n = static_cast<double>(image.pixels.size());
  return {sum / n, std::sqrt(std::max(squares / n - sum / n * (sum / n), 0.0))};
}

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

TEST_F(Page, DrawsEveryChartWithoutAnyConsoleMessage) {
  EXPECT_LT(html_.size(), kMostPageBytes);
  const BrowserResult result = runChromium(page_, {"--dump-dom"});
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.console, "");
  EXPECT_EQ(rootData(result.out, "errors"), "0");
  // Two effects of accuracy; lights of tao21; orders of msbrdf.
  EXPECT_EQ(countOf(html_, "<canvas "), 4u);
  EXPECT_EQ(rootData(result.out, "charts"), "4");
  EXPECT_EQ(rootData(result.out, "drawn"), "4");
  EXPECT_EQ(rootData(result.out, "sliders"), "1");
  EXPECT_EQ(rootData(result.out, "overflow"), "0");
}

TEST_F(Page, OfManyRunsSortsByAClickOnAColumn) {
  const TableSpec table = {
      .name = "zk16", .title = "Glints", .metrics = {{"shading_ms", "ms"}}, .score = "shading_ms"};
  std::vector<NamedResults> runs;
  for (const double ms : {9.0, 100.0, 20.0}) {
    Record record = sampleRecord("snow/steep", "shading_ms", ms);
    runs.push_back({"results.json", {sampleRun(), {record}}});
    runs.back().results.run.device = "device " + std::to_string(runs.size());
  }
  std::string html = runsReport(runs, std::span(&table, 1));
  html.insert(html.rfind("</body>"),
              "<script>for (const n of [1, 2]) "
              "document.querySelectorAll('.sortable thead button')[5].click();</script>");
  writeFile(page_, html);
  const BrowserResult result = runChromium(page_, {"--dump-dom"});
  EXPECT_EQ(result.console, "");
  EXPECT_EQ(rootData(result.out, "drawn"), "1");
  const std::string rows = result.out.substr(result.out.find("<tbody>"));
  EXPECT_LT(rows.find("device 2"), rows.find("device 3"))
      << rows.substr(0, 2000);  // numbers, not words
  EXPECT_LT(rows.find("device 3"), rows.find("device 1"));
}

// The checks above can fail: a page whose script throws is noticed.
TEST_F(Page, AThrowingScriptIsNoticed) {
  std::string broken = html_;
  broken.insert(broken.rfind("</script>"), "\nthrow new Error(\"on purpose\");\n");
  writeFile(page_, broken);
  const BrowserResult result = runChromium(page_, {"--dump-dom"});
  EXPECT_NE(result.console.find("on purpose"), std::string::npos) << result.console;
}

TEST_F(Page, ScreenshotsAreNotBlankAndDarkIsDark) {
  constexpr double kLeastSpread = 0.05;  // a blank page has 0
  const auto [light, light_spread] = meanAndSpread(
      readImage(screenshot("light.png", {"--blink-settings=preferredColorScheme=1"})));
  const auto [dark, dark_spread] =
      meanAndSpread(readImage(screenshot("dark.png", {"--blink-settings=preferredColorScheme=0"})));
  EXPECT_GT(light_spread, kLeastSpread);
  EXPECT_GT(dark_spread, kLeastSpread);
  EXPECT_GT(light, 0.7);
  EXPECT_LT(dark, 0.3);
}

TEST_F(Page, ReadableWithoutScript) {
  std::string bare = html_;
  for (std::size_t at = 0; (at = bare.find("<script")) != std::string::npos;)
    bare.erase(at, bare.find("</script>", at) + 9 - at);
  writeFile(page_, bare);
  const auto [mean, spread] = meanAndSpread(readImage(screenshot("plain.png", {})));
  EXPECT_GT(spread, 0.05) << mean;
}

// Windows have a least width, so the page is opened in a frame as narrow as a phone. The frame's
// parent also moves the slider.
TEST_F(Page, APhoneScrollsNoSidewaysAndTheSliderAnswers) {
  writeFile(folder_ / "phone.html",
            "<!doctype html><html><head><title>phone</title></head><body><iframe src=\"page.html\" "
            "style=\"width:" +
                std::to_string(kPhoneWidth_px) +
                "px;height:700px;border:0\"></iframe><script>\n"
                "addEventListener(\"load\", () => setTimeout(() => {\n"
                "  const page = document.querySelector(\"iframe\").contentDocument;\n"
                "  const data = document.documentElement.dataset;\n"
                "  data.wide = page.documentElement.scrollWidth;\n"
                "  data.errors = page.documentElement.dataset.errors;\n"
                "  const range = page.querySelector(\".slider input[type=range]\");\n"
                "  range.focus();\n"
                "  data.focused = page.activeElement === range;\n"
                "  const canvas = page.querySelector(\".strip canvas\");\n"
                "  data.height = canvas.height;\n"
                "  const scratch = document.createElement(\"canvas\").getContext(\"2d\", "
                "{willReadFrequently: true});\n"
                "  const level = () => (scratch.drawImage(canvas, 0, 0), scratch.getImageData(5, "
                "20, 1, 1).data[0]);\n"
                "  range.value = 100;\n"
                "  range.dispatchEvent(new Event(\"input\"));\n"
                "  data.left = level();\n"
                "  range.value = 0;\n"
                "  range.dispatchEvent(new Event(\"input\"));\n"
                "  data.right = level();\n"
                "}, 1000));\n</script></body></html>\n");
  const BrowserResult result = runChromium(folder_ / "phone.html", {"--dump-dom"});
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.console, "");
  EXPECT_EQ(rootData(result.out, "errors"), "0");
  EXPECT_EQ(rootData(result.out, "wide"), std::to_string(kPhoneWidth_px));
  EXPECT_EQ(rootData(result.out, "focused"), "true");
  EXPECT_EQ(rootData(result.out, "height"), "48") << "without the names";
  EXPECT_EQ(rootData(result.out, "left"), "51");    // original: 1/5
  EXPECT_EQ(rootData(result.out, "right"), "204");  // truth: 4/5
}

TEST_F(Page, PrintsToPdf) {
  const std::filesystem::path pdf = folder_ / "page.pdf";
  const BrowserResult result =
      runChromium(page_, {"--print-to-pdf=" + pdf.string(), "--no-pdf-header-footer"});
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.console, "");
  const std::string bytes = readFile(pdf);
  EXPECT_TRUE(bytes.starts_with("%PDF-"));
  EXPECT_GE(countOf(bytes, "/Type /Page\n"), 2u);
}

}  // namespace
}  // namespace glintmark
