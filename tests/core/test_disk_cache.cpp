// The cache's folder: its owner's alone.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "host/core/atomic_file.h"
#include "host/core/disk_cache.h"
#include "tests/damaged_bytes.h"
#include "tests/report/temp_folder.h"

namespace glintmark {
namespace {

class Caches : public testing::Test {
 protected:
  Caches() { setenv("GLINTMARK_CACHE_DIR", (folder_ / "deep/cache").c_str(), 1); }
  ~Caches() override {
    unsetenv("GLINTMARK_CACHE_DIR");
    umask(mask_);
  }

  mode_t modeOf(const std::filesystem::path& path) const {
    struct stat status = {};
    EXPECT_EQ(stat(path.c_str(), &status), 0) << path;
    return status.st_mode & 0777;
  }

  const TempFolder folder_;
  const mode_t mask_ = umask(0);  // the most open there is
};

TEST_F(Caches, FoldersAreTheirOwnersWhateverTheUmask) {
  const DiskCache cache = DiskCache::fromEnvironment();
  cache.store("name", "key", "code");
  EXPECT_EQ(modeOf(folder_ / "deep/cache"), 0700u);
  EXPECT_EQ(cache.load("name", "key"), "code");
  chmod((folder_ / "deep/cache").c_str(), 0777);
  EXPECT_EQ(cache.load("name", "key"), "code");
  EXPECT_EQ(modeOf(folder_ / "deep/cache"), 0700u);
}

TEST_F(Caches, WhatBelongsToSomeoneElseIsNotUsed) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  const DiskCache cache = DiskCache::fromEnvironment();
  cache.store("name", "key", "code");
  const std::filesystem::path place = folder_ / "deep/cache";
  const auto entry = std::filesystem::directory_iterator(place)->path();
  ASSERT_EQ(chown(entry.c_str(), 12345, 12345), 0);
  EXPECT_FALSE(cache.load("name", "key"));
  ASSERT_EQ(chown(entry.c_str(), 0, 0), 0);
  EXPECT_TRUE(cache.load("name", "key"));
  ASSERT_EQ(chown(place.c_str(), 12345, 12345), 0);
  EXPECT_FALSE(cache.load("name", "key"));
  cache.store("other", "key", "code");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(place), {}), 1);
}

TEST_F(Caches, LinksInThePlaceOfEntriesAreNotFollowed) {
  const DiskCache cache = DiskCache::fromEnvironment();
  cache.store("name", "key", "code");
  const auto entry = std::filesystem::directory_iterator(folder_ / "deep/cache")->path();
  std::filesystem::rename(entry, folder_ / "moved");
  std::filesystem::create_symlink(folder_ / "moved", entry);
  EXPECT_FALSE(cache.load("name", "key"));
  const std::string before = readFile(folder_ / "moved");
  cache.store("name", "key", "other");
  EXPECT_EQ(readFile(folder_ / "moved"), before);
}

TEST_F(Caches, EveryWrongBitMisses) {
  const DiskCache cache = DiskCache::fromEnvironment();
  const std::string key = "version 2 of 16x16 texels", content = "what took long to compute";
  cache.store("name", key, content);
  const auto entry = std::filesystem::directory_iterator(folder_ / "deep/cache")->path();
  const std::string good = readFile(entry);
  withEachBitFlipped(good, good.size(), 1,
                     [&](const std::string& damaged, const std::string& place) {
                       std::ofstream(entry, std::ios::binary) << damaged;
                       EXPECT_FALSE(cache.load("name", key)) << place;
                     });
  for (std::size_t bytes = 0; bytes < good.size(); ++bytes) {
    std::ofstream(entry, std::ios::binary) << good.substr(0, bytes);
    EXPECT_FALSE(cache.load("name", key)) << bytes;
  }
  cache.store("name", key, content);
  EXPECT_EQ(cache.load("name", key), content);
}

}  // namespace
}  // namespace glintmark
