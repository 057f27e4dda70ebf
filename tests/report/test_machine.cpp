// What a process may use of a machine, from files as control groups of both versions write them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>

#include "host/core/atomic_file.h"
#include "host/core/free_memory.h"
#include "host/report/record/machine.h"
#include "tests/report/sample_records.h"
#include "tests/report/temp_folder.h"

namespace glintmark {
namespace {

class Machine : public testing::Test {
 protected:
  void put(const std::string& file, const std::string& text) {
    const std::filesystem::path path = root_ / file;
    std::filesystem::create_directories(path.parent_path());
    writeFile(path, text);
  }
  std::filesystem::path root() const { return root_.path(); }

 private:
  TempFolder root_;
};

int allowedCores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

TEST_F(Machine, CoresAreThoseThatAffinityAndQuotasLeave) {
  EXPECT_EQ(usableCores(root()), allowedCores()) << "no control groups";
  put("proc/self/cgroup", "0::/user/app\n");
  put("sys/fs/cgroup/user/app/cpu.max", "max 100000\n");
  EXPECT_EQ(usableCores(root()), allowedCores());
  put("sys/fs/cgroup/user/cpu.max", "50000 100000\n");
  EXPECT_EQ(usableCores(root()), 1) << "a parent's quota holds, too";
  put("sys/fs/cgroup/user/cpu.max", "110000 100000\n");
  EXPECT_EQ(usableCores(root()), std::min(2, allowedCores())) << "a core and a bit need two";
}

TEST_F(Machine, QuotasOfTheFirstVersion) {
  put("proc/self/cgroup", "3:cpu,cpuacct:/box\n2:memory:/box\n");
  put("sys/fs/cgroup/cpu/box/cpu.cfs_quota_us", "-1\n");
  put("sys/fs/cgroup/cpu/box/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(usableCores(root()), allowedCores());
  put("sys/fs/cgroup/cpu/box/cpu.cfs_quota_us", "80000\n");
  EXPECT_EQ(usableCores(root()), 1);
}

TEST_F(Machine, OneCoreIsOne) {
  cpu_set_t all, one;
  CPU_ZERO(&all);
  ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
  CPU_ZERO(&one);
  for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &all)) CPU_SET(cpu, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(usableCores(root()), 1);
  sched_setaffinity(0, sizeof all, &all);
}

TEST_F(Machine, MemoryIsTheLeastThatAnyoneLeaves) {
  EXPECT_EQ(freeMemoryBytes(root()), 0u) << "nobody says";
  put("proc/meminfo", "MemTotal: 8000 kB\nMemAvailable:    4000 kB\n");
  EXPECT_EQ(freeMemoryBytes(root()), 4096000u);
  put("proc/self/cgroup", "0::/app\n");
  put("sys/fs/cgroup/app/memory.max", "max\n");
  put("sys/fs/cgroup/app/memory.current", "500000\n");
  EXPECT_EQ(freeMemoryBytes(root()), 4096000u);
  put("sys/fs/cgroup/app/memory.max", "1000000\n");
  EXPECT_EQ(freeMemoryBytes(root()), 500000u);
  put("sys/fs/cgroup/app/memory.stat", "anon 400000\ninactive_file 100000\n");
  EXPECT_EQ(freeMemoryBytes(root()), 600000u) << "cached files can go";
}

TEST_F(Machine, MemoryOfTheFirstVersion) {
  put("proc/meminfo", "MemAvailable: 4000 kB\n");
  put("proc/self/cgroup", "2:memory:/box\n");
  put("sys/fs/cgroup/memory/box/memory.limit_in_bytes", "9223372036854771712\n");
  put("sys/fs/cgroup/memory/box/memory.usage_in_bytes", "700000\n");
  EXPECT_EQ(freeMemoryBytes(root()), 4096000u);
  put("sys/fs/cgroup/memory/memory.limit_in_bytes", "1000000\n");
  put("sys/fs/cgroup/memory/memory.usage_in_bytes", "900000\n");
  EXPECT_EQ(freeMemoryBytes(root()), 100000u);
}

TEST_F(Machine, StateIsLoadAndMeanClock) {
  put("proc/loadavg", "1.50 0.70 0.30 2/300 1234\n");
  put("proc/cpuinfo", "processor\t: 0\ncpu MHz\t\t: 2000.5\nprocessor\t: 1\ncpu MHz\t\t: 3000.5\n");
  const MachineState state = machineState(root());
  EXPECT_EQ(state.load, 1.5);
  EXPECT_EQ(state.clock_mhz, 2500.5);
}

TEST_F(Machine, OthersAreCountedAndThisProcessIsNot) {
  put("proc/stat", "cpu 0 0 0 0 0 0 0 0 0 0\n");
  const MachineWatch watch(root());
  EXPECT_EQ(watch.othersCores(), 0);
  put("proc/stat", "cpu 100000000 0 0 0 0 0 0 0 0 0\n");
  EXPECT_GT(watch.othersCores(), 100);
  // A processor that this process may not use is not in its way.
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  ASSERT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
  int ours = 0, another = 0;
  while (!CPU_ISSET(ours, &allowed)) ++ours;
  while (CPU_ISSET(another, &allowed)) ++another;
  put("proc/stat", fmt::format("cpu 100000000 0 0 0 0 0 0 0 0 0\ncpu{} 0 0 0 0 0 0 0 0 0 0\n"
                               "cpu{} 100000000 0 0 0 0 0 0 0 0 0\n",
                               ours, another));
  EXPECT_EQ(watch.othersCores(), 0);
}

TEST(Busy, IsSaidOfPeaksThatMovedAndOfOthers) {
  RunInfo run = sampleRun();
  EXPECT_EQ(busyText(run), "");
  run.begin = {1, 3000, 200, 20};
  run.end = {1, 3000, 185, 19};
  EXPECT_EQ(busyText(run), "") << "within a tenth";
  run.end.peak_gflops = 150;
  EXPECT_EQ(busyText(run), "its FMA peak moved from 200 to 150 GFLOP/s");
  run.others_cores = 1;
  EXPECT_EQ(busyText(run),
            "its FMA peak moved from 200 to 150 GFLOP/s; others kept 1.0 of 2 processors busy");
  run = sampleRun();
  run.throttled_s = 3;
  EXPECT_EQ(busyText(run), "a quota took 3.0 s from it");
}

}  // namespace
}  // namespace glintmark
