// Work that ranks of mpirun share: the same bits as one rank's, and what happens when one is
// stopped.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <thread>

#include "host/core/atomic_file.h"
#include "host/report/record/records.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

constexpr int kRankCounts[] = {1, 2, 4};

// Two drivers' views of one processor stand for two devices of a kind.
const std::vector<std::string> kTwoDevices = {"POCL_DEVICES=pthread pthread"};

class Ranks : public testing::Test {
 protected:
  void SetUp() override {
    if (!canShareRanks()) GTEST_SKIP() << "mpirun or glintmark_mpi.so is not here";
  }
  const TempFolder folder_;
};

// What the program says, without what mpirun has to add.
std::string sentences(const std::string& text) {
  std::istringstream lines(text);
  std::string own;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("glintmark: ")) own += line + "\n";
  return own;
}

void expectSentence(const ProcessResult& result, int exit_code,
                    const std::vector<std::string>& parts) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  const std::string said = sentences(result.err);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << result.err;
  for (const std::string& part : parts)
    EXPECT_NE(said.find(part), std::string::npos) << "no '" << part << "' in " << result.err;
}

// Four surfaces, the last of them by few rays.
std::vector<std::string> shortSimulation(const std::string& checkpoint) {
  return {"simulate", "--quiet", "--model",      "smith",
          "--rays",   "3200000", "--checkpoint", checkpoint};
}

// The rank of a child of mpirun; -1 of another process.
int rankOf(int pid) {
  std::ifstream stream("/proc/" + std::to_string(pid) + "/environ");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  constexpr std::string_view kName = "OMPI_COMM_WORLD_RANK=";
  const std::size_t at = text.find(kName);
  return at == std::string::npos ? -1 : std::atoi(text.c_str() + at + kName.size());
}

// Rays that a checkpoint holds.
std::uint64_t raysIn(const std::string& checkpoint) {
  std::istringstream lines(readFile(checkpoint));
  std::string line;
  for (int i = 0; i < 3; ++i) std::getline(lines, line);
  return std::stoull(line);
}

constexpr std::uint64_t kBegun = 1048576;

// The process of a rank; 0 if it is not there yet.
int processOf(const Process& mpirun, int rank) {
  for (const int child : mpirun.children())
    if (rankOf(child) == rank) return child;
  return 0;
}

// A simulation without end by two ranks that carries on from a checkpoint of one surface. It casts
// by then: what asks it to save is followed.
Process startEndless(const std::string& checkpoint) {
  const std::vector<std::string> simulate = {"simulate", "--model", "smith", "--checkpoint",
                                             checkpoint};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), simulate.begin(), simulate.end());
    return more;
  };
  const ProcessResult begun = runGlintmark(with({"--quiet", "--rays", std::to_string(kBegun)}));
  EXPECT_EQ(begun.exit_code, 0) << begun.err;
  return Process::byRanks(2, with({"--rays", "1e13", "--resume"}),
                          {"OMPI_MCA_odls_base_sigkill_timeout=2"});
}

void waitUntilItCasts(const Process& process, const std::string& checkpoint) {
  for (int i = 0; i < 600 && raysIn(checkpoint) == kBegun; ++i) {
    if (const int first = processOf(process, 0); first > 0) kill(first, SIGCONT);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_GT(raysIn(checkpoint), kBegun);
}

// mpirun of Open MPI 5 kills ranks half a second after it has asked them to end, which may be
// sooner than they come together, and hands on nothing of what they say by then.
bool ranksAreAwaited() {
  return openMpiVersion() < 5;
}

// What a rank says last, once.
void expectLastWords(const std::string& errors, const std::string& words) {
  if (!ranksAreAwaited()) return;
  const std::string said = sentences(errors);
  EXPECT_EQ(countOf(said, words), 1u) << errors;
  EXPECT_NE(said.find("run.sim, --resume carries on"), std::string::npos) << errors;
}

// Does it hold what one rank casts in as many rays?
void expectBitsOfOneRank(const TempFolder& folder, const std::string& checkpoint) {
  const std::string other = folder / "one.sim";
  ASSERT_EQ(runGlintmark({"simulate", "--quiet", "--model", "smith", "--rays",
                          std::to_string(raysIn(checkpoint)), "--checkpoint", other})
                .exit_code,
            0);
  EXPECT_EQ(readFile(checkpoint), readFile(other));
}

TEST_F(Ranks, SimulationsAreThoseOfOneRank) {
  const std::string alone = folder_ / "alone.sim";
  const ProcessResult one = runGlintmark(shortSimulation(alone));
  ASSERT_EQ(one.exit_code, 0) << one.err;
  const std::string table = one.out.substr(0, one.out.find(" s, "));
  for (const int count : kRankCounts) {
    const std::string file = folder_ / ("by" + std::to_string(count) + ".sim");
    const ProcessResult shared = runByRanks(count, shortSimulation(file));
    ASSERT_EQ(shared.exit_code, 0) << shared.err;
    EXPECT_EQ(readFile(file), readFile(alone)) << count;
    EXPECT_EQ(shared.out.substr(0, table.rfind('\n')), table.substr(0, table.rfind('\n')));
    EXPECT_EQ(countOf(shared.out, "million rays per second"), 1u) << shared.out;
  }
}

TEST_F(Ranks, SaysTheSlopesOfTheLastSurface) {
  const std::vector<std::string> words = {"simulate", "--quiet", "--rays", "2200000"};
  const auto slopes = [](const std::string& text) {
    const std::size_t at = std::min(text.find("slope variance"), text.size());
    return text.substr(at, text.find('\n', text.find("effective", at)) - at);
  };
  const std::string one = slopes(runGlintmark(words).out);
  EXPECT_EQ(countOf(one, "effective"), 1u);
  EXPECT_EQ(slopes(runByRanks(2, words).out), one);
}

TEST_F(Ranks, AnyNumberOfThemCarriesOn) {
  const std::string file = folder_ / "run.sim", alone = folder_ / "alone.sim";
  std::vector<std::string> begin = shortSimulation(file);
  begin[5] = "2097152";
  ASSERT_EQ(runByRanks(2, begin).exit_code, 0);
  std::vector<std::string> more = shortSimulation(file);
  more.push_back("--resume");
  ASSERT_EQ(runByRanks(4, more).exit_code, 0);
  ASSERT_EQ(runGlintmark(shortSimulation(alone)).exit_code, 0);
  EXPECT_EQ(readFile(file), readFile(alone));
}

TEST_F(Ranks, AnInterruptedRunKeepsWhatAllHaveCast) {
  const std::string file = folder_ / "run.sim";
  Process process = startEndless(file);
  waitUntilItCasts(process, file);
  const std::uint64_t before = raysIn(file);
  process.interrupt();
  const ProcessResult result = process.wait();
  EXPECT_NE(result.exit_code, 0);
  expectLastWords(result.err, "glintmark: interrupted; ");
  EXPECT_GE(raysIn(file), before + (ranksAreAwaited() ? 1 : 0));
  expectBitsOfOneRank(folder_, file);
}

TEST_F(Ranks, ADeadRankLosesNothingThatWasKept) {
  const std::string file = folder_ / "run.sim";
  Process process = startEndless(file);
  waitUntilItCasts(process, file);
  const std::uint64_t before = raysIn(file);
  EXPECT_EQ(kill(processOf(process, 1), SIGKILL), 0);
  const ProcessResult result = process.wait();
  EXPECT_NE(result.exit_code, 0);
  expectLastWords(result.err, "glintmark: interrupted, and a rank did not answer; ");
  EXPECT_GE(raysIn(file), before);
  expectBitsOfOneRank(folder_, file);
}

TEST_F(Ranks, WhatIsWrongEverywhereIsSaidOnce) {
  expectSentence(runByRanks(4, {"simulate", "--alpha", "9"}), 2, {"roughness along x 9"});
  expectSentence(runByRanks(4, {"simulate", "--rais", "9"}), 2, {"--rais"});
  expectSentence(runByRanks(2, {"verify"}), 2,
                 {"does not share its work among 2 ranks", "simulate, accuracy, bench or fit"});
  expectSentence(runByRanks(2, {"simulate", "--device", "nothing"}), 3, {"'nothing'"});
  expectSentence(runByRanks(2, {"fit", "gmm", "disk", "--on", "device"}), 2, {"--on device"});
  const ProcessResult help = runByRanks(2, {"simulate", "--help"});
  EXPECT_EQ(countOf(help.out, "--checkpoint"), 2u) << help.out;  // its option, and an example
}

// Each of them would believe that it is alone.
TEST_F(Ranks, ThoseOfAnotherLauncherAreRefused) {
  expectSentence(runGlintmark({"simulate"}, {"PMI_RANK=0", "PMI_SIZE=4"}), 2,
                 {"started 4 ranks, but 1 of them", "Open MPI's mpirun"});
}

TEST_F(Ranks, WhatIsTimedHasADeviceOfItsOwn) {
  const ProcessResult refused =
      runByRanks(2, {"bench", "zk16", "-o", folder_ / "r", "--size", "32x18"});
  expectSentence(refused, 2,
                 {"ranks without devices: 2 ranks on", "have 1 of", "one rank per device"});
}

// Records by case and metric.
std::map<std::string, Record> recordsIn(const std::string& folder) {
  std::map<std::string, Record> records;
  for (const Record& record : readResults(folder + "/results.json").records)
    records[record.case_ + " " + record.metric] = record;
  return records;
}

std::vector<std::string> smallBench(const std::string& folder) {
  return {"bench", "zk16",   "--quiet", "--scene", "screen_plane", "--size",
          "64x36", "--reps", "1",       "-o",      folder};
}

TEST_F(Ranks, CasesAreDealtOutAndLoggedInOnePlace) {
  const std::string shared = folder_ / "shared", alone = folder_ / "alone";
  const ProcessResult two = runByRanks(2, smallBench(shared), kTwoDevices);
  ASSERT_EQ(two.exit_code, 0) << two.err << two.out;
  ASSERT_EQ(runGlintmark(smallBench(alone)).exit_code, 0);
  const auto ours = recordsIn(shared), theirs = recordsIn(alone);
  ASSERT_EQ(ours.size(), theirs.size());
  for (const auto& [name, record] : theirs) {
    ASSERT_TRUE(ours.contains(name)) << name;
    EXPECT_TRUE(ours.at(name).valid) << name;
    if (!record.metric.starts_with("cells_")) continue;
    EXPECT_EQ(ours.at(name).value.median, record.value.median) << name;
  }
  for (const char* picture :
       {"zk16_screen_plane_steep_cells.png", "zk16_screen_plane_grazing_cells.png"})
    EXPECT_EQ(std::filesystem::exists(std::filesystem::path(shared) / picture),
              std::filesystem::exists(std::filesystem::path(alone) / picture))
        << picture;
  // Nothing is left to measure.
  const std::string log = readFile(shared + "/records.jsonl");
  std::vector<std::string> again = smallBench(shared);
  again.push_back("--resume");
  ASSERT_EQ(runByRanks(2, again, kTwoDevices).exit_code, 0);
  EXPECT_EQ(readFile(shared + "/records.jsonl"), log);
}

// Errors and truths of a run of accuracy, bit by bit.
std::map<std::string, std::uint64_t> errorsIn(const std::string& folder) {
  std::map<std::string, std::uint64_t> errors;
  for (const auto& [name, record] : recordsIn(folder))
    if (record.metric == "error" || record.metric == "truth_stderr" || record.metric == "rel_mse")
      errors[name] = std::bit_cast<std::uint64_t>(record.value.median);
  return errors;
}

void expectTruthsOfOneRank(const TempFolder& folder, const std::string& size,
                           const std::vector<std::string>& words) {
  const auto into = [&](const std::string& name) {
    std::vector<std::string> all = {"accuracy", "--quiet", "--reps", "1",
                                    "--size",   size,      "-o",     folder / name};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  };
  const ProcessResult alone = runGlintmark(into("alone"));
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  const auto expected = errorsIn(folder / "alone");
  EXPECT_FALSE(expected.empty());
  for (const int count : {2, 4}) {
    const std::string name = "by" + std::to_string(count);
    const ProcessResult shared = runByRanks(count, into(name));
    ASSERT_EQ(shared.exit_code, 0) << shared.err;
    EXPECT_EQ(errorsIn(folder / name), expected) << count;
    EXPECT_EQ(countOf(shared.out, "written to"), 1u);
  }
}

TEST_F(Ranks, SampledTruthsAreThoseOfOneRank) {
  // So many pixels that a replicate takes two launches.
  expectTruthsOfOneRank(folder_, "180x101",
                        {"ltc", "--scene", "area_plane/front", "--knob", "horizon"});
}

TEST_F(Ranks, SimulatedTruthsAreThoseOfOneRank) {
  expectTruthsOfOneRank(folder_, "32x18", {"msbrdf", "--rays", "100000", "--knob", "model"});
}

TEST_F(Ranks, FitsAreThoseOfOneRank) {
  const auto fitted = [&](const std::string& what, int count) {
    const std::string file = folder_ / (what + std::to_string(count));
    std::vector<std::string> words = {"fit", "ltc", "--size", "8", "--quiet", "-o", file};
    if (what == "gmm")
      words = {"fit", "gmm", "disk", "--size", "512", "--refit", "--quiet", "-o", file};
    const ProcessResult result = count == 0 ? runGlintmark(words) : runByRanks(count, words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(countOf(result.out, "fitted"), 1u) << result.out;
    // Of mixtures the head has the time that it took, and a checksum over it stands at the end.
    const std::string bytes = readFile(file);
    return what == "gmm" ? bytes.substr(64, bytes.size() - 80) : bytes;
  };
  for (const char* what : {"ltc", "gmm"}) {
    const std::string alone = fitted(what, 0);
    for (const int count : kRankCounts) EXPECT_TRUE(fitted(what, count) == alone) << what << count;
  }
  const std::vector<std::string> meso = {"fit", "meso", "--grid", "4"};
  EXPECT_EQ(runByRanks(4, meso).out, runGlintmark(meso).out);
}

TEST_F(Ranks, LobesAreThoseOfOneRank) {
  const auto words = [&](const std::string& name) {
    return std::vector<std::string>{"fit",           "lobes", "--quiet", "--rays",      "1000",
                                    "--mirror-rays", "1000",  "-o",      folder_ / name};
  };
  ASSERT_EQ(runGlintmark(words("alone")).exit_code, 0);
  const ProcessResult shared = runByRanks(2, words("shared"));
  ASSERT_EQ(shared.exit_code, 0) << shared.err;
  for (const char* file : {"multiscatter.json", "free_lobes.csv", "lobe_errors.txt"})
    EXPECT_EQ(readFile(folder_ / (std::string("shared/") + file)),
              readFile(folder_ / (std::string("alone/") + file)))
        << file;
}

}  // namespace
}  // namespace glintmark
