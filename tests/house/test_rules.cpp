// The rules of the house on made-up trees: each wall stands, and nothing else is one.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/house/house.h"

namespace glintmark::house {
namespace {

Order smallOrder() {
  return parseOrder(
      "# from the bottom up\norder core\norder ocl report\norder frame\n\n"
      "only CL/ host/ocl/opencl.h tests/sample/\ngenerated version.h\n");
}

// A tree in which nothing is wrong, with `path` in it that includes `name`.
Files treeWith(const std::string& path, const std::string& name) {
  Files files;
  for (const char* file :
       {"kernels/types.h", "kernels/wide/wide.clh", "kernels/glint/hash.clh", "host/core/error.h",
        "host/ocl/device.h", "host/report/picture/image.h", "host/report/record/record.h",
        "host/frame/frame.h", "host/frame/effect/lights.h", "bench/bench.h", "tests/mesh.h",
        "fuzz/entries.h"})
    files[file] = "#pragma once\n";
  const bool angle = name.starts_with('<');
  files[path] = "// One line.\n  #  include " + (angle ? name : '"' + name + '"') + "\n";
  return files;
}

std::string faultOf(const std::string& path, const std::string& name) {
  const auto faults = includeFaults(treeWith(path, name), smallOrder());
  EXPECT_LE(faults.size(), 1u);
  return faults.empty() ? "" : faults[0];
}

TEST(Walls, WhatIsBelowMayBeIncluded) {
  const std::pair<const char*, const char*> allowed[] = {
      {"host/frame/a.cpp", "host/ocl/device.h"},
      {"host/frame/a.h", "host/core/error.h"},
      {"host/frame/effect/a.cpp", "host/frame/frame.h"},
      {"host/report/picture/a.cpp", "host/report/record/record.h"},
      {"host/core/a.h", "kernels/types.h"},
      {"host/main.cpp", "host/frame/frame.h"},
      {"host/ocl/opencl.h", "<CL/opencl.hpp>"},
      {"tests/sample/a.cpp", "<CL/cl.h>"},
      {"host/core/a.cpp", "version.h"},
      {"host/core/a.cpp", "<vector>"},
      {"kernels/glint/a.clh", "hash.clh"},
      {"kernels/glint/a.clh", "wide/wide.clh"},
      {"kernels/glint/a.clh", "../wide/wide.clh"},
      {"bench/a.cpp", "tests/mesh.h"},
      {"tests/a/a.cpp", "fuzz/entries.h"},
      {"fuzz/a.cpp", "host/frame/frame.h"}};
  for (const auto& [path, name] : allowed)
    EXPECT_EQ(faultOf(path, name), "") << path << " includes " << name;
}

TEST(Walls, NothingElseMay) {
  struct Broken {
    const char *path, *name, *reason;
  };
  const Broken broken[] = {
      {"host/core/a.h", "host/frame/frame.h", "host/frame is above host/core"},
      {"host/report/record/a.h", "<host/frame/frame.h>", "host/frame is above host/report"},
      {"host/ocl/a.cpp", "host/report/record/record.h", "host/report stands beside host/ocl"},
      {"host/new/a.cpp", "host/core/error.h", "host/order.txt does not know host/new"},
      {"host/frame/a.cpp", "tests/mesh.h", "host includes nothing of tests"},
      {"host/frame/a.cpp", "bench/bench.h", "host includes nothing of bench"},
      {"tests/a.cpp", "bench/bench.h", "tests includes nothing of bench"},
      {"kernels/glint/a.clh", "../../host/core/error.h", "kernels include nothing but kernels"},
      {"kernels/types.clh", "<host/core/error.h>", "kernels include nothing but kernels"},
      {"host/ocl/device.cpp", "<CL/opencl.hpp>", "CL/ is for host/ocl/opencl.h only"},
      {"tests/a.cpp", "<CL/cl.h>", "CL/ is for host/ocl/opencl.h only"},
      {"host/frame/a.cpp", "frame.h", "there is no such file"},
      {"host/frame/a.cpp", "host/frame/gone.h", "there is no such file"}};
  for (const Broken& b : broken) {
    const std::string fault = faultOf(b.path, b.name);
    EXPECT_TRUE(fault.starts_with(std::string(b.path) + ":2: includes ")) << fault;
    EXPECT_NE(fault.find(b.reason), std::string::npos) << b.path << ": " << fault;
  }
}

TEST(Walls, OrdersThatAreNotUnderstoodAreErrors) {
  for (const char* text : {"order\n", "only CL/\n", "oder core\n"})
    EXPECT_THROW(parseOrder(text), std::runtime_error) << text;
}

TEST(Circles, OfModulesAreFound) {
  Files files = treeWith("host/frame/frame.cpp", "host/frame/effect/lights.h");
  EXPECT_TRUE(circles(files).empty());
  files["host/frame/effect/lights.cpp"] = "#include \"host/frame/frame.h\"\n";
  ASSERT_FALSE(circles(files).empty());
  EXPECT_EQ(circles(files)[0],
            "host/frame/effect/lights -> host/frame/frame -> host/frame/effect/lights");
}

TEST(Circles, OfFoldersAreFound) {
  Files files = treeWith("host/report/picture/a.cpp", "host/report/record/record.h");
  EXPECT_TRUE(circles(files).empty());
  files["host/report/record/b.cpp"] = "#include \"host/report/picture/image.h\"\n";
  ASSERT_FALSE(circles(files).empty());
  EXPECT_EQ(circles(files)[0], "host/report/picture -> host/report/record -> host/report/picture");
}

// --- Unnamed namespaces -------------------------------------------------------------------------

std::vector<std::string> faultsOfUnnamed(const std::string& a, const std::string& b,
                                         const std::string& folder = "host/core/") {
  return sharedUnnamed({{"host/core/a.cpp", "namespace {\n\n" + a + "\n}  // namespace\n"},
                        {folder + "b.cpp", "int k;\nnamespace {\n" + b + "\n}  // namespace\n"}});
}

TEST(Unnamed, OneNameInTwoSourcesOfAFolderIsAFault) {
  for (const char* declared :
       {"struct Thing {\n  int a;\n};", "class Thing : public Other {\n};",
        "enum class Thing { kA };", "constexpr int Thing = 3;  // \"{\"",
        "const std::string Thing[] = {\n  \"}\"\n};",
        "std::vector<int> Thing(const A& a) {\n  return {};\n}", "constexpr double Thing[2][3] = {",
        "A& Thing(int x,\n         int y) {\n}", "constexpr std::size_t Thing{2};"}) {
    const auto faults = faultsOfUnnamed("int before() {\n  return 1;\n}\n" + std::string(declared),
                                        std::string(declared) + "\nint after;");
    EXPECT_EQ(faults, std::vector<std::string>{"host/core/b.cpp: 'Thing' is also a name of "
                                               "host/core/a.cpp"})
        << declared;
    EXPECT_TRUE(faultsOfUnnamed(declared, declared, "host/ocl/").empty()) << declared;
  }
}

// What a line declares beside its first name, and names of types.
TEST(Unnamed, EveryNameOfALineCounts) {
  const auto faults = faultsOfUnnamed("constexpr int kOne = 1, kTwo = 2;\nusing Three = int;",
                                      "constexpr int kTwo = 3;\nstruct Three {\n};");
  EXPECT_EQ(faults.size(), 2u);
  EXPECT_TRUE(
      faultsOfUnnamed("constexpr int kOne = 1, kTwo = 2;", "constexpr int kThree = 3;").empty());
  EXPECT_TRUE(faultsOfUnnamed("using Three = int;", "using Three = int;").empty());
}

TEST(Unnamed, OtherFunctionsOfANameLocalNamesAndOutsidersAreNot) {
  EXPECT_TRUE(faultsOfUnnamed("int f(int x) {\n}", "int f(double x) {\n}").empty());
  EXPECT_TRUE(
      faultsOfUnnamed("int f() {\n  constexpr int kA = 1;\n}", "constexpr int kA = 1;").empty());
  EXPECT_TRUE(faultsOfUnnamed("}  // namespace\nint k;\nnamespace {", "").empty());
  EXPECT_TRUE(faultsOfUnnamed("// struct A {};", "struct A {};").empty());
}

// --- READMEs ------------------------------------------------------------------------------------

constexpr const char* kReadme =
    "# frame: one frame\n\nSee `frame.h`, `effect/` and `kernels/types.h`.\n\n"
    "May include `core/`, `ocl/`.\nAfter a change: `test_frame`, `glintmark verify`.\n";

std::vector<std::string> faultsOfReadme(const std::string& text, const std::string& name) {
  Files files = treeWith("host/frame/a.cpp", name);
  files["host/frame/README.md"] = text;
  files["tests/CMakeLists.txt"] = "glintmark_test(test_frame\n  LINK glintmark_frame)\n";
  std::vector<std::string> faults = readmeFaults(files, smallOrder(), definedPrograms(files));
  std::erase_if(faults, [](const std::string& f) { return !f.starts_with("host/frame/README"); });
  return faults;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST(Readmes, OfAFolderThatIsAsItSaysIsRight) {
  EXPECT_TRUE(faultsOfReadme(kReadme, "host/ocl/device.h").empty());
  EXPECT_TRUE(faultsOfReadme(kReadme, "host/frame/effect/lights.h").empty());
}

TEST(Readmes, ThatAreMissingAreFaults) {
  const auto faults = readmeFaults(treeWith("host/frame/a.cpp", "<vector>"), smallOrder(), {});
  for (const char* folder : {"host/core", "host/frame/effect", "kernels/wide"})
    EXPECT_EQ(std::ranges::count(faults, std::string(folder) + " has no README.md"), 1) << folder;
}

TEST(Readmes, ThatSayOtherwiseAreFaults) {
  struct Broken {
    std::string text, include, reason;
  };
  const Broken broken[] = {
      {kReadme + std::string(5, '\n'), "<vector>", "more than 10 lines"},
      {replaced(kReadme, "# frame:", "# frames:"), "<vector>", "does not begin with \"# frame: \""},
      {replaced(kReadme, "`frame.h`", "`gone.h`"), "<vector>", "there is no gone.h"},
      {replaced(kReadme, "`effect/`", "`effects/`"), "<vector>", "there is no effects/"},
      {replaced(kReadme, "May", "Might"), "<vector>", "does not say what the folder may include"},
      {kReadme, "host/report/record/record.h", "does not name host/report/record"},
      {replaced(kReadme, "`ocl/`", "`verify/`"), "<vector>", "names verify/, which"},
      {replaced(kReadme, "After", "Before"), "<vector>", "does not say what to run"},
      {replaced(kReadme, "`test_frame`", "`test_gone`"), "<vector>", "names test_gone, which no"}};
  for (const Broken& b : broken) {
    const auto faults = faultsOfReadme(b.text, b.include);
    EXPECT_TRUE(std::ranges::any_of(faults, [&](const std::string& f) {
      return f.find(b.reason) != std::string::npos;
    })) << b.reason;
  }
}

}  // namespace
}  // namespace glintmark::house
