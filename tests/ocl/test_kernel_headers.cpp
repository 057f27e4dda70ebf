// The kernels' headers: each compiles when it is included alone, templates say what they want, and
// kernels/README.md lists them.
#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>

#include "host/ocl/kernel_folder.h"
#include "tests/ocl/ocl_test.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

bool isTemplate(const fs::path& file) {
  return file.string().ends_with("_template.clh");
}

// Paths in the kernel folder.
std::vector<fs::path> headers() {
  std::vector<fs::path> found;
  for (const fs::path& file : kernelFiles(kKernels))
    if (file.extension() != ".cl") found.push_back(file.lexically_relative(kKernels));
  return found;
}

KernelConfig everythingOff() {
  KernelConfig config;
  config.glint = config.size_variation = config.cone_lights = false;
  config.planes = PlaneMask::all();
  return config;
}

KernelConfig everythingOn(int lanes) {
  KernelConfig config;
  config.width = lanes;
  config.all_materials = config.groove = config.glint_colour = config.light_cone = true;
  config.diffuse = config.count_cells = config.normal_map = config.ltc = true;
  config.light_shapes = config.light_texture = config.lobe_masking = true;
  config.metal_compensation = MetalCompensation::kScaled;
  config.multiscatter = Multiscatter::kRefit;
  config.ltc_method = LtcMethod::kTao21;
  config.normal_method = NormalMethod::kGmm;
  config.lobes = 4;
  config.planes = PlaneMask::all();
  return config;
}

// A copy of the project's kernels in which programs can be put beside them.
class KernelHeaders : public OclTest {
 protected:
  KernelHeaders() { fs::copy(kKernels, kernels_, fs::copy_options::recursive); }

  // The message of a program that includes `header` and nothing else; "" if it compiles.
  std::string includedAlone(const fs::path& header, const KernelConfig& config) {
    const std::string name = fmt::format("alone{}.cl", programs_++);
    writeFile(kernels_ / name, fmt::format("#include \"{}\"\n", header.string()));
    std::string message = errorOf([&] {
      ProgramCache cache(device_);
      cache.get(name, config);
    });
    std::smatch dump;  // what a failed build leaves
    if (std::regex_search(message, dump, std::regex("sources are in ([^)]+)\\)")))
      fs::remove_all(dump[1].str());
    return message;
  }

  void expectAllCompile(const KernelConfig& config) {
    setenv("GLINTMARK_CACHE_DIR", "off", 1);
    for (const fs::path& header : headers())
      if (!isTemplate(header)) {
        EXPECT_EQ(includedAlone(header, config), "") << header;
      }
  }

  Device device_;
  int programs_ = 0;
};

TEST_F(KernelHeaders, CompileAloneAtOneLaneWithEverythingOff) {
  expectAllCompile(everythingOff());
}

TEST_F(KernelHeaders, CompileAloneAtEightLanesWithEverythingOn) {
  expectAllCompile(everythingOn(8));
}

TEST_F(KernelHeaders, CompileAloneWithEveryMethod) {
  setenv("GLINTMARK_CACHE_DIR", "off", 1);
  for (const fs::path& header : headers())
    if (const std::string file = header.filename(); file.starts_with("method_")) {
      KernelConfig config = everythingOn(1);
      config.lobes = 2;  // as many float4 as a cell of the table of cosines has
      EXPECT_EQ(includedAlone(header, config), "") << header;
    }
  for (const NormalMethod method : {NormalMethod::kLean, NormalMethod::kGmm}) {
    KernelConfig config = everythingOn(8);
    config.normal_method = method;
    config.lobes = 2;
    EXPECT_EQ(includedAlone("shade_pixels.clh", config), "") << static_cast<int>(method);
  }
}

TEST_F(KernelHeaders, TemplatesSayWhatTheyWant) {
  int templates = 0;
  for (const fs::path& header : headers()) {
    const std::string text = readFile(kKernels / header);
    const bool called_so = text.find("// A template") != std::string::npos;
    EXPECT_EQ(called_so, isTemplate(header)) << header;
    if (!isTemplate(header)) continue;
    ++templates;
    const std::string message = includedAlone(header, everythingOn(1));
    EXPECT_NE(message.find(header.filename().string() + ": "), std::string::npos) << message;
  }
  EXPECT_GE(templates, 5);
}

// Guards are called after the file, those of methods after their folder as well. Templates that may
// be included again have none.
TEST(KernelFolder, HeadersAreGuardedByTheirName) {
  for (const fs::path& header : headers()) {
    std::string name = header.filename().replace_extension();
    if (name.starts_with("method_")) name.insert(0, header.parent_path().string() + "_");
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
    const std::string text = readFile(kKernels / header);
    const std::string_view suffix = header.extension() == ".h" ? "_H" : "_CLH";
    const bool guarded =
        text.find(fmt::format("#ifndef GLINTMARK_{}{}\n", name, suffix)) != std::string::npos;
    const bool repeated =
        isTemplate(header) &&
        std::regex_search(text, std::regex("may\\s+(// )?be\\s+(// )?included\\s+(// )?again"));
    EXPECT_NE(guarded, repeated) << header;
  }
}

TEST(KernelFolder, ReadmeListsEveryFileAndNoOther) {
  const std::string readme = readFile(kKernels / "README.md");
  const std::string table = readme.substr(0, readme.find("\n## "));
  std::set<std::string> listed, there;
  const std::regex file_name("`([a-z0-9_/]+\\.(?:cl|clh|h))`");
  for (auto it = std::sregex_iterator(table.begin(), table.end(), file_name);
       it != std::sregex_iterator(); ++it)
    listed.insert((*it)[1].str());
  for (const fs::path& file : kernelFiles(kKernels))
    there.insert(file.lexically_relative(kKernels).string());
  EXPECT_EQ(listed, there);
}

}  // namespace
}  // namespace glintmark
