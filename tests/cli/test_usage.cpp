// Help, and what bad usage gives: one clear sentence, the right exit code, no files.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>

#include "host/core/atomic_file.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

// The program must end with `exit_code`, nothing on stdout, and one line on stderr that starts with
// its name and has every one of `parts`.
void expectError(const std::vector<std::string>& arguments, int exit_code,
                 const std::vector<std::string>& parts,
                 const std::vector<std::string>& environment = {}) {
  const ProcessResult result = runGlintmark(arguments, environment);
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(result.err.starts_with("glintmark: ")) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  for (const std::string& part : parts) {
    EXPECT_NE(result.err.find(part), std::string::npos) << "no '" << part << "' in " << result.err;
  }
}

TEST(Usage, HelpHasExamples) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--help"},
                                                {"info", "--help"},
                                                {"render", "--help"},
                                                {"heatmap", "--help"},
                                                {"export", "--help"},
                                                {"bench", "--help"}}) {
    const ProcessResult result = runGlintmark(words);
    EXPECT_EQ(result.exit_code, 0) << words[0];
    EXPECT_NE(result.out.find("Examples:\n  glintmark "), std::string::npos) << words[0];
    EXPECT_EQ(result.err, "");
  }
}

TEST(Usage, Version) {
  const ProcessResult result = runGlintmark({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  std::string version = readFile(GLINTMARK_SOURCE_DIR "/VERSION");
  version.pop_back();  // the end of its line
  EXPECT_TRUE(result.out.starts_with("glintmark " + version + " (")) << result.out;
  const std::string changes = readFile(GLINTMARK_SOURCE_DIR "/CHANGELOG.md");
  EXPECT_TRUE(changes.starts_with("# Changelog\n\n## " + version)) << changes.substr(0, 40);
}

TEST(Usage, UnknownNamesListTheKnownOnes) {
  expectError({}, 2, {"no command", "render", "bench"});
  expectError({"paint"}, 2, {"'paint'", "info, render, heatmap, export, bench"});
  expectError({"render", "snow", "-o", "a.png", "--fast"}, 2, {"'--fast'", "--view", "--device"});
  expectError({"render", "snow", "sand", "-o", "a.png"}, 2, {"'sand'", "too many"});
  expectError({"render", "nowhere", "-o", "a.png"}, 2, {"nowhere", "screen_plane", "snow"});
  expectError({"render", "screen_plane", "-o", "a.png", "--view", "up"}, 2,
              {"'up'", "steep", "grazing"});
  expectError({"render", "screen_plane", "-o", "a.png", "--method", "best"}, 2,
              {"'best'", "zk16", "exact"});
  expectError({"heatmap", "--scale", "log"}, 2, {"'log'", "fixed", "auto"});
  expectError({"bench", "zk17"}, 2, {"'zk17'", "zk16"});
  expectError({"bench", "--scene", "moon"}, 2, {"'moon'", "screen_plane, snow, dress, car"});
  expectError({"bench", "--view", "up"}, 2, {"'up'", "steep, grazing"});
}

TEST(Usage, MissingAndMalformedValues) {
  expectError({"render"}, 2, {"scene", "render --help"});
  expectError({"render", "snow"}, 2, {"--output", "required"});
  expectError({"bench", "--reps", "many"}, 2, {"--reps", "many"});
  expectError({"bench", "--reps", "0"}, 2, {"--reps 0"});
  expectError({"--width", "3", "info"}, 2, {"--width 3", "1, 4, 8 or 16"});
  expectError({"render", "screen_plane", "-o", "a.png", "--exposure", "0"}, 2, {"--exposure 0"});
}

// Of a shell's variable that was never set: as if the option were not there, they did nothing.
TEST(Usage, EmptyValuesAreRefused) {
  for (const char* option : {"--device", "--mesh", "--assets", "--set", "--threads", "--width"})
    expectError({option, "", "render", "screen_plane", "-o", "a.png"}, 2, {option, "is empty"});
  for (const char* option : {"--size", "--view", "--zoom", "--aov", "--trace", "--exposure"})
    expectError({"render", "screen_plane", "-o", "a.png", option, ""}, 2, {option, "is empty"});
  expectError({"report", ""}, 2, {"folder", "is empty"});
  expectError({"info", "--json", ""}, 2, {"--json", "is empty"});
}

TEST(Usage, ValuesThatDoNothingAreRefused) {
  expectError({"render", "screen_plane", "-o", "a.png", "--zoom", "0"}, 2, {"--zoom 0"});
  expectError({"render", "screen_plane", "-o", "a.png", "--truth", "0"}, 2,
              {"--truth 0", "from 1"});
  expectError({"--assets", "/nowhere", "info"}, 2, {"--assets '/nowhere' is not a folder"});
  for (const char* count : {"-1", "abc", "nan"})
    expectError({"--threads", count, "info"}, 2,
                {"--threads", std::string("'") + count + "' is not a number from 0 on"});
}

TEST(Usage, NamesThatTheSystemRefusesAreSaid) {
  const std::string name(5000, 'x');
  for (const std::vector<std::string>& words : {std::vector<std::string>{"report", name},
                                                {"compare", name, name},
                                                {"diff", name, name},
                                                {"render", "screen_plane", "-o", name + ".png"},
                                                {"fit", "gmm", name}})
    expectError(words, 2, {name.substr(0, 100)});
  expectError({"report", name}, 2, {"File name too long"});
}

TEST(Usage, Sizes) {
  for (const char* size : {"0x0", "1000000x1", "-1x5", "64", "64x", "x36", "64x36x1", "ax36"}) {
    expectError({"render", "screen_plane", "-o", "a.png", "--size", size}, 2,
                {"--size '" + std::string(size) + "'", "1920x1080"});
  }
}

TEST(Usage, Devices) {
  expectError({"--device", "no such device", "verify"}, 3, {"no such device", "0: "});
  expectError({"verify"}, 3, {"no OpenCL device"}, {"OCL_ICD_VENDORS=/nonexistent"});
  // The list comes first all the same.
  const ProcessResult info = runGlintmark({"info", "--device", "no such device"});
  EXPECT_EQ(info.exit_code, 3);
  EXPECT_NE(info.out.find("device 0: "), std::string::npos) << info.out;
  EXPECT_NE(info.err.find("no such device"), std::string::npos) << info.err;
  expectError({"bench", "-o", "unused_results_folder"}, 3, {"no OpenCL device"},
              {"OCL_ICD_VENDORS=/nonexistent"});
  EXPECT_FALSE(std::filesystem::exists("unused_results_folder"));
}

TEST(Usage, SceneFiles) {
  const TempFolder folder;
  writeFile(folder / "cut.toml", "description = \"a\"\n[mesh\n");
  writeFile(folder / "typo.toml",
            "descriptino = \"a\"\n" + readFile(GLINTMARK_SOURCE_DIR "/scenes/screen_plane.toml"));
  const std::string picture = folder / "a.png";
  expectError({"render", folder / "cut.toml", "-o", picture}, 2, {"cut.toml", "2"});
  expectError({"render", folder / "typo.toml", "-o", picture}, 2, {"descriptino", "description"});
  expectError({"render", folder / "none.toml", "-o", picture}, 2, {"none.toml"});
  expectError({"render", "screen_plane", "-o", picture, "--mesh", folder / "none.obj"}, 2,
              {"none.obj"});
  expectError({"render", "screen_plane", "-o", picture, "--set", "mesh.colour=1"}, 2, {"colour"});
  EXPECT_FALSE(std::filesystem::exists(picture));
}

TEST(Usage, OutputsAreCheckedBeforeWork) {
  const TempFolder folder;
  writeFile(folder / "file", "");
  expectError({"render", "screen_plane", "-o", folder / "a.jpg"}, 2, {"a.jpg", ".exr or .png"});
  expectError({"render", "screen_plane", "-o", folder / "none/a.png"}, 2, {"there is no folder"});
  expectError({"render", "screen_plane", "-o", folder / "file/a.png"}, 2, {"file/a.png"});
  expectError({"render", "screen_plane", "-o", folder / "a.png", "--aov", folder / "b.png"}, 2,
              {"b.png", ".exr"});
  expectError({"heatmap", "-o", folder / "a.exr"}, 2, {"a.exr", ".png"});
  expectError({"heatmap", "--csv", folder / "a.csv"}, 2, {"--sweep-angle"});
  expectError({"heatmap", "--sweep-angle", "--exr", folder / "a.exr"}, 2, {"--sweep-angle"});
  expectError({"bench", "-o", folder / "file"}, 2, {(folder / "file").string()});
  expectError({"bench", "-o", "/proc/glintmark"}, 2, {"/proc/glintmark"});
  expectError({"bench", "-o", folder / "r", "--json", folder / "none/a.json"}, 2, {"none/a.json"});
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST(Usage, AFullStandardOutputIsAnError) {
  const TempFolder folder;
  const std::string program = GLINTMARK_BINARY_DIR "/bin/glintmark";
  for (const std::string& words :
       {std::string("--help"), std::string("--version"), std::string("info"),
        "render screen_plane --size 32x18 --quiet -o " + (folder / "a.png").string(),
        "diff " + (folder / "a.png").string() + " " + (folder / "a.png").string(),
        "export screen_plane --size 32x18 --quiet -o " + (folder / "scene").string(),
        std::string("heatmap screen_plane --size 32x18 --quiet"),
        std::string("simulate --rays 1000 --quiet"),
        std::string("verify --only ^maths/ --quiet")}) {
    const std::string command =
        program + " " + words + " >/dev/full 2>" + (folder / "err").string();
    const int status = std::system(command.c_str());
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 2) << words;
    EXPECT_NE(readFile(folder / "err").find("cannot write the standard output"), std::string::npos)
        << words << ": " << readFile(folder / "err");
  }
}

}  // namespace
}  // namespace glintmark
