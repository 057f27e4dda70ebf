#include <sys/stat.h>

#include <cstring>
#include <iterator>
#include <vector>

#include "host/ocl/kernel_folder.h"
#include "tests/ocl/ocl_test.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

class ProgramCacheTest : public OclTest {
 protected:
  Program build(const std::string& options = "") {
    return ProgramCache(device_).getWithOptions("tiny.cl", options);
  }

  std::vector<fs::path> entries() const {
    if (!fs::exists(cache_)) return {};
    return {fs::directory_iterator(cache_), fs::directory_iterator()};
  }

  // The one entry there must be.
  fs::path entry() const {
    const std::vector<fs::path> all = entries();
    EXPECT_EQ(all.size(), 1u);
    return all.at(0);
  }

  // Damages the entry; the next build must notice, compile again and leave a good entry.
  void expectRebuiltAfter(const std::string& damage, const std::string& content) {
    build();
    writeFile(entry(), content);
    const Program rebuilt = build();
    EXPECT_FALSE(rebuilt.fromDiskCache()) << damage;
    EXPECT_EQ(runCount(device_, rebuilt), 3u) << damage;
    EXPECT_TRUE(build().fromDiskCache()) << damage;
  }

  std::string goodEntry() {
    build();
    return readFile(entry());
  }

  Device device_;
};

TEST_F(ProgramCacheTest, MemoryHitTakesNoBuild) {
  ProgramCache cache(device_);
  const Program first = cache.getWithOptions("tiny.cl", "-D A=1");
  const Program again = cache.getWithOptions("tiny.cl", "-D A=1");
  const Program other = cache.getWithOptions("tiny.cl", "-D A=2");
  EXPECT_GT(first.buildNs(), 0);
  EXPECT_EQ(again.buildNs(), 0);
  EXPECT_GT(other.buildNs(), 0);
  EXPECT_EQ(runCount(device_, again), 3u);
}

TEST_F(ProgramCacheTest, DiskHitRunsTheStoredBinary) {
  const Program first = build();
  EXPECT_FALSE(first.fromDiskCache());
  const Program second = build();
  EXPECT_TRUE(second.fromDiskCache());
  EXPECT_GT(second.buildNs(), 0);
  EXPECT_EQ(runCount(device_, second), 3u);
  EXPECT_FALSE(second.binary().empty());
  EXPECT_EQ(entries().size(), 1u) << "no temporary files stay behind";
}

TEST_F(ProgramCacheTest, OptionsKeyTheDiskCache) {
  build("-D A=1");
  EXPECT_FALSE(build("-D A=2").fromDiskCache());
  EXPECT_TRUE(build("-D A=1").fromDiskCache());
  EXPECT_EQ(entries().size(), 2u);
}

TEST_F(ProgramCacheTest, ChangedIncludeIsCompiledAndReplacesTheEntry) {
  ProgramCache cache(device_);
  EXPECT_EQ(runCount(device_, cache.getWithOptions("tiny.cl", "")), 3u);
  writeFile(kernels_ / "tiny.clh", "#define STEP 5u\n");
  const Program changed = cache.getWithOptions("tiny.cl", "");
  EXPECT_FALSE(changed.fromDiskCache());
  EXPECT_EQ(runCount(device_, changed), 5u) << "memory cache";
  const Program stored = build();
  EXPECT_TRUE(stored.fromDiskCache());
  EXPECT_EQ(runCount(device_, stored), 5u) << "disk cache";
  EXPECT_EQ(entries().size(), 1u) << "stale entries do not pile up";
}

// A header in a folder within a folder; its name counts as well as its text.
TEST_F(ProgramCacheTest, ChangesInSubfoldersChangeTheKey) {
  fs::create_directories(kernels_ / "part" / "inner");
  writeFile(kernels_ / "part" / "inner" / "step.clh", "#define STEP 3u\n");
  writeFile(kernels_ / "tiny.clh", "#include \"part/inner/step.clh\"\n");
  const std::uint64_t before = hashKernels(kernels_);
  EXPECT_EQ(runCount(device_, build()), 3u);
  EXPECT_TRUE(build().fromDiskCache());
  writeFile(kernels_ / "part" / "inner" / "step.clh", "#define STEP 7u\n");
  const Program changed = build();
  EXPECT_FALSE(changed.fromDiskCache());
  EXPECT_EQ(runCount(device_, changed), 7u);
  EXPECT_NE(hashKernels(kernels_), before);

  const std::uint64_t changed_text = hashKernels(kernels_);
  fs::rename(kernels_ / "part" / "inner" / "step.clh", kernels_ / "part" / "step.clh");
  EXPECT_NE(hashKernels(kernels_), changed_text);
}

TEST_F(ProgramCacheTest, EmptyAndTruncatedEntriesAreRebuilt) {
  const std::string good = goodEntry();
  expectRebuiltAfter("empty", "");
  for (const std::size_t size : {std::size_t{5}, std::size_t{24}, good.size() / 2, good.size() - 1})
    expectRebuiltAfter("truncated to " + std::to_string(size), good.substr(0, size));
}

TEST_F(ProgramCacheTest, DamagedEntriesAreRebuilt) {
  const std::string good = goodEntry();
  // Magic, key length, key, middle and end of the binary.
  for (const std::size_t at :
       {std::size_t{3}, std::size_t{25}, std::size_t{40}, good.size() / 2, good.size() - 1}) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x40);
    expectRebuiltAfter("bit flipped at " + std::to_string(at), bad);
  }
  expectRebuiltAfter("trailing byte", good + "x");
}

TEST_F(ProgramCacheTest, IntactEntryThatTheDriverRefusesIsRebuilt) {
  const std::string good = goodEntry();
  const std::size_t magic_size = good.find('\n') + 1;
  std::uint64_t key_size = 0;
  std::memcpy(&key_size, good.data() + magic_size, sizeof key_size);
  const std::string binary = "not a program of any device";
  const std::uint64_t numbers[2] = {binary.size(), fnv1a(binary)};
  expectRebuiltAfter("foreign binary",
                     good.substr(0, magic_size + sizeof key_size + key_size) +
                         std::string(reinterpret_cast<const char*>(numbers), sizeof numbers) +
                         binary);
}

TEST_F(ProgramCacheTest, UnusableFolderIsNoCache) {
  setenv("GLINTMARK_CACHE_DIR", "/dev/null/cache", 1);
  for (int i = 0; i < 2; ++i) {
    const Program program = build();
    EXPECT_FALSE(program.fromDiskCache());
    EXPECT_EQ(runCount(device_, program), 3u);
  }
}

TEST_F(ProgramCacheTest, OffWritesNothing) {
  setenv("GLINTMARK_CACHE_DIR", "off", 1);
  build();
  EXPECT_FALSE(build().fromDiskCache());
  EXPECT_TRUE(entries().empty());
  EXPECT_FALSE(fs::exists("off"));
}

// Other things may still be kept.
TEST_F(ProgramCacheTest, ProgramsAloneMayBeLeftOut) {
  setenv("GLINTMARK_PROGRAM_CACHE", "off", 1);
  build();
  EXPECT_FALSE(build().fromDiskCache());
  EXPECT_TRUE(entries().empty());
  setenv("GLINTMARK_PROGRAM_CACHE", "on", 1);
  build();
  EXPECT_TRUE(build().fromDiskCache());
  unsetenv("GLINTMARK_PROGRAM_CACHE");
}

TEST_F(ProgramCacheTest, XdgFolderIsTheDefault) {
  unsetenv("GLINTMARK_CACHE_DIR");
  const char* before = getenv("XDG_CACHE_HOME");
  const std::string saved = before ? before : "";
  setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
  build();
  EXPECT_FALSE(fs::is_empty(folder_.path() / "glintmark"));
  before ? setenv("XDG_CACHE_HOME", saved.c_str(), 1) : unsetenv("XDG_CACHE_HOME");
}

TEST_F(ProgramCacheTest, OptionsOfTheLayerAreAdded) {
  const std::string options = build("-D A=1").options();
  EXPECT_TRUE(options.starts_with("-D A=1 -cl-std=CL1.2")) << options;
  EXPECT_EQ(options.find("-cl-fp32-correctly-rounded-divide-sqrt") != std::string::npos,
            device_.info().correctly_rounded_divide_sqrt)
      << options;
  EXPECT_TRUE(options.ends_with(" -I " + kernels_.string())) << options;
  EXPECT_EQ(options.find("fast-relaxed"), std::string::npos);
}

TEST_F(ProgramCacheTest, KernelFolderMayHaveBlanksInItsPath) {
  const fs::path blank = folder_.path() / "a folder" / "kernels";
  fs::create_directories(blank);
  fs::copy(kernels_, blank);
  setenv("GLINTMARK_KERNELS", blank.c_str(), 1);
  EXPECT_EQ(runCount(device_, build()), 3u);
}

TEST_F(ProgramCacheTest, FailedBuildSaysWhatAndLeavesEverything) {
  writeFile(kernels_ / "broken.cl",
            "#include \"tiny.clh\"\n__kernel void k(__global uint* o) { o[0] = STEPP; }\n");
  const std::string message =
      errorOf([&] { ProgramCache(device_).getWithOptions("broken.cl", "-D WIDTH=4"); });
  EXPECT_TRUE(message.starts_with("kernel file 'broken.cl' does not build on '" +
                                  device_.info().name + "': "))
      << message;
  EXPECT_NE(message.find("STEPP"), std::string::npos) << message;
  EXPECT_NE(message.find("broken.cl:2:"), std::string::npos) << "file and line: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;

  const std::string marker = "(options, log and sources are in ";
  const std::size_t at = message.find(marker);
  ASSERT_NE(at, std::string::npos) << message;
  const fs::path dump = message.substr(at + marker.size(), message.size() - at - marker.size() - 1);
  EXPECT_TRUE(readFile(dump / "options.txt").starts_with("-D WIDTH=4 -cl-std=CL1.2"));
  EXPECT_NE(readFile(dump / "build.log").find("STEPP"), std::string::npos);
  EXPECT_EQ(readFile(dump / "broken.cl"), readFile(kernels_ / "broken.cl"));
  EXPECT_EQ(readFile(dump / "tiny.clh"), readFile(kernels_ / "tiny.clh"));
  fs::remove_all(dump);
  EXPECT_TRUE(entries().empty()) << "a failed build is not stored";
}

TEST_F(ProgramCacheTest, MissingFilesAndFoldersAreNamed) {
  EXPECT_EQ(errorOf([&] { ProgramCache(device_).getWithOptions("none.cl", ""); }),
            "kernel file 'none.cl' is not in the kernel folder '" + kernels_.string() + "'");
  setenv("GLINTMARK_KERNELS", "/nonexistent", 1);
  EXPECT_EQ(errorOf([&] { ProgramCache cache(device_); }),
            "GLINTMARK_KERNELS is '/nonexistent', which is not a folder");
}

TEST_F(ProgramCacheTest, WithoutEnvironmentTheProjectsKernelsAreFound) {
  unsetenv("GLINTMARK_KERNELS");
  EXPECT_TRUE(fs::exists(fs::path(kernelFolder()) / "probes/probe.cl")) << kernelFolder();
}

}  // namespace
}  // namespace glintmark
