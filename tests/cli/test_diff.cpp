// diff on pictures written here.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "host/core/atomic_file.h"
#include "host/report/picture/image_io.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

class Diff : public testing::Test {
 protected:
  std::string write(const std::string& name, int width, float value) {
    Image image(width, 20, 3);
    for (float& v : image.pixels) v = value;
    std::string file = folder_ / name;
    file.ends_with(".png") ? writePng(image, file) : writeExr(image, file);
    return file;
  }
  void expectRefused(std::vector<std::string> arguments, const std::string& sentence) {
    arguments.insert(arguments.begin(), "diff");
    const ProcessResult result = runGlintmark(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.out;
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find(sentence), std::string::npos) << result.err;
  }
  const TempFolder folder_;
};

TEST_F(Diff, PrintsAndWritesWhatItFinds) {
  const std::string a = write("a.exr", 24, 0.75f), b = write("b.exr", 24, 0.5f),
                    json = folder_ / "metrics.json", png = folder_ / "error.png",
                    exr = folder_ / "error.exr";
  const ProcessResult result = runGlintmark({"diff", a, b, "-o", png, "--json", json});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("24x20 pixels of radiance, 100 % of them not black"), std::string::npos)
      << result.out;
  EXPECT_NE(readFile(json).find("glintmark.difference/1"), std::string::npos);
  EXPECT_EQ(readImage(png).channels, 3);
  const ProcessResult relative =
      runGlintmark({"diff", a, b, "--no-hdr", "-o", exr, "--map", "relative", "--max", "1"});
  EXPECT_EQ(relative.exit_code, 0) << relative.err;
  EXPECT_EQ(relative.out.find("hdr_flip"), std::string::npos) << relative.out;
  const Image layers = readImage(exr);
  EXPECT_EQ(layers.channel_names.back(), "relative");
  EXPECT_NEAR(layers.at(5, 5)[3], 0.25 / 0.51, 1e-6);
}

TEST_F(Diff, BadInput) {
  const std::string a = write("a.exr", 24, 1), wide = write("wide.exr", 30, 1),
                    display = write("a.png", 24, 1);
  expectRefused({a, wide}, "24x20 and 30x20 pixels, expected two of one size");
  expectRefused({display, a}, "the first picture holds display values");
  expectRefused({a, folder_ / "none.exr"}, "none.exr");
  expectRefused({a, a, "-o", folder_ / "e.jpg"}, "must end in .exr or .png");
  expectRefused({a, a, "-o", folder_ / "e.png", "--map", "psnr"},
                "maps are absolute, flip, hdr_flip, relative");
  expectRefused({a, a, "--exposure", "0"}, "--exposure 0 is not a positive number");
  expectRefused({a, a, "--trim", "80"}, "--trim 80 is not a percentage from 0 to 50");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "e.png"));
}

// Of a broken picture one sentence is said, not what its library prints besides.
TEST_F(Diff, SaysOfBrokenPicturesOneSentence) {
  writePng(Image(64, 64, 3), folder_ / "a.png");
  const std::string whole = readFile(folder_ / "a.png");
  for (const std::size_t at : {whole.find("IDAT") + 6, whole.size() - 6}) {
    std::string broken = whole;
    broken[at] = static_cast<char>(broken[at] ^ 0x55);
    writeFile(folder_ / "b.png", broken);
    const ProcessResult result = runGlintmark({"diff", folder_ / "b.png", folder_ / "a.png"});
    EXPECT_EQ(std::ranges::count(result.err, '\n'), result.exit_code == 0 ? 0 : 1) << result.err;
    EXPECT_EQ(result.err.find("libpng"), std::string::npos) << result.err;
  }
}

// Outputs replace what stands there: never what they are made from, and not each other.
TEST(OwnFiles, AreWrittenOverNothingThatIsRead) {
  const TempFolder folder;
  const std::filesystem::path a = folder / "a.exr", link = folder / "link.exr";
  writeExr(Image(8, 8, 3), a);
  std::filesystem::create_symlink(a, link);
  const std::string before = readFile(a);
  for (const std::filesystem::path& output : {a, link, folder.path() / "." / "a.exr"}) {
    const ProcessResult result = runGlintmark({"diff", a, a, "-o", output});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("written over what is read"), std::string::npos) << result.err;
  }
  EXPECT_EQ(readFile(a), before);
  const std::string map = "environment.image='" + a.string() + "'";
  EXPECT_EQ(runGlintmark({"render", "screen_plane", "-o", a, "--set", map}).exit_code, 2);
  EXPECT_EQ(readFile(a), before);
  const std::filesystem::path b = folder / "b.png";
  const ProcessResult twice = runGlintmark({"diff", a, a, "-o", b, "--json", b});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_NE(twice.err.find("is the file of -o too"), std::string::npos) << twice.err;
  // Neither is there yet, and one is spelt otherwise.
  const std::string near = std::filesystem::proximate(b).string();
  ASSERT_FALSE(std::filesystem::exists(b));
  const ProcessResult spelt = runGlintmark({"diff", a, a, "-o", near, "--json", "./" + near});
  EXPECT_EQ(spelt.exit_code, 2) << spelt.err;
}

TEST(OwnFiles, AreNoneThatASceneReadsBesideItsFile) {
  const TempFolder folder;
  const std::filesystem::path sky = folder / "sky.exr", scene = folder / "s.toml";
  writeExr(Image(8, 8, 3), sky);
  writeFile(scene, readFile(GLINTMARK_SOURCE_DIR "/scenes/screen_plane.toml"));
  const std::string before = readFile(sky);
  const ProcessResult result =
      runGlintmark({"render", scene, "--set", "environment.image='sky.exr'", "-o", sky});
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_NE(result.err.find("written over what is read"), std::string::npos) << result.err;
  writeFile(scene, readFile(GLINTMARK_SOURCE_DIR "/scenes/screen_plane.toml") +
                       "\n[environment]\nimage = \"sky.exr\"\n");
  const ProcessResult named = runGlintmark({"render", scene, "-o", sky});
  EXPECT_EQ(named.exit_code, 2) << named.err;
  EXPECT_NE(named.err.find("written over what is read"), std::string::npos) << named.err;
  EXPECT_EQ(readFile(sky), before);
  const ProcessResult fit = runGlintmark({"fit", "gmm", sky, "-o", sky});
  EXPECT_EQ(fit.exit_code, 2);
  EXPECT_NE(fit.err.find("written over what is read"), std::string::npos) << fit.err;
  const ProcessResult log = runGlintmark({"verify", "--only", "^device/", "--json",
                                          folder / "v.json", "--junit", folder / "v.json.partial"});
  EXPECT_EQ(log.exit_code, 2) << log.err;
}

}  // namespace
}  // namespace glintmark
