// Drivers that die, hang or run out of resources cost `verify` one check; what was found is kept.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/report/record/records.h"
#include "tests/faulty_driver/faulty.h"

namespace glintmark {
namespace {

using Json = nlohmann::json;

// Its second check alone launches probeFma.
constexpr const char* kTwoChecks = "^device/";

Json resultOf(const Json& json, const std::string& name) {
  for (const Json& check : json["checks"])
    if (check["name"] == name) return check;
  return {};
}

struct Fault {
  const char* faults;
  const char* note;
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.faults;
}

class Survival : public testing::TestWithParam<Fault> {};

TEST_P(Survival, OneCheckFailsTheOthersRun) {
  const TempFolder folder;
  const ProcessResult result = runFaulty({"verify", "--only", kTwoChecks, "--timeout", "20",
                                          "--json", folder / "v.json", "--junit", folder / "v.xml"},
                                         GetParam().faults);
  EXPECT_EQ(result.exit_code, 1) << result.err << result.out;
  EXPECT_NE(result.err.find("[1/2] device/structs\n[2/2] device/fma\n"), std::string::npos)
      << result.err;
  const Json json = Json::parse(readFile(folder / "v.json"));
  EXPECT_EQ(json["passed"], 1);
  EXPECT_EQ(json["failed"], 1);
  const std::string note = resultOf(json, "device/structs")["note"];
  EXPECT_NE(note.find(GetParam().note), std::string::npos) << note;
  EXPECT_EQ(resultOf(json, "device/fma")["verdict"], "pass");
  const std::string junit = readFile(folder / "v.xml");
  EXPECT_NE(junit.find("tests=\"2\" failures=\"1\""), std::string::npos) << junit;
  EXPECT_NE(junit.find("classname=\"device\" name=\"structs\""), std::string::npos) << junit;
  EXPECT_NE(junit.find(GetParam().note), std::string::npos) << junit;
  EXPECT_EQ(folder.entryCount(), 2u);
}

INSTANTIATE_TEST_SUITE_P(All, Survival,
                         testing::Values(Fault{"crash=probeTypeSizes", "ended by signal 11"},
                                         Fault{"stall=probeTypeSizes",
                                               "gave no answer within 20 s"},
                                         Fault{"exit=probeTypeSizes", "ended with exit code 7"},
                                         Fault{"resources=probeTypeSizes", "CL_OUT_OF_RESOURCES"},
                                         Fault{"skip=probeTypeSizes", ""}),
                         [](const auto& tested) {
                           const std::string faults = tested.param.faults;
                           return faults.substr(0, faults.find('='));
                         });

std::vector<std::string> whole(const TempFolder& folder) {
  return {"verify", "--only", "^(device|seeds)/", "--json", folder / "v.json"};
}

// The last check hangs: it is the signal that ends the run, and all before it is kept.
void interruptAndResume(int signal, int exit_code) {
  const TempFolder folder;
  Process process(whole(folder), faultyEnvironment("stall=probeFma"));
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(100);
  const auto reached = [&] { return process.errSoFar().find("device/fma") != std::string::npos; };
  while (!reached() && std::chrono::steady_clock::now() < give_up)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  process.send(signal);
  const ProcessResult stopped = process.wait();
  EXPECT_EQ(stopped.exit_code, exit_code) << stopped.err;
  EXPECT_NE(stopped.err.find("interrupted; 1 of 4 checks ran, --resume carries on"),
            std::string::npos)
      << stopped.err;
  EXPECT_EQ(Json::parse(readFile(folder / "v.json"))["passed"], 1);
  EXPECT_TRUE(std::filesystem::exists(folder / "v.json.partial"));

  std::vector<std::string> resume = whole(folder);
  resume.push_back("--resume");
  const ProcessResult resumed = runGlintmark(resume);
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(resumed.err.find("device/structs"), std::string::npos) << resumed.err;
  const Json json = Json::parse(readFile(folder / "v.json"));
  EXPECT_EQ(json["passed"], 4);
  EXPECT_EQ(json["chosen"], 4);
  EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(Interrupts, CtrlCKeepsWhatWasFound) {
  interruptAndResume(SIGINT, 130);
}
TEST(Interrupts, RequestsToEndKeepWhatWasFound) {
  interruptAndResume(SIGTERM, 143);
}

// A child must not outlive its parent.
TEST(Interrupts, AKilledRunLeavesNoProcess) {
  const TempFolder folder;
  Process process(whole(folder), faultyEnvironment("stall=probeFma"));
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(100);
  while (process.errSoFar().find("device/fma") == std::string::npos &&
         std::chrono::steady_clock::now() < give_up)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const std::vector<int> children = process.children();
  ASSERT_EQ(children.size(), 1u);
  process.kill();
  process.wait();
  const auto gone = [&] { return ::kill(children[0], 0) != 0; };
  while (!gone() && std::chrono::steady_clock::now() < give_up)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(gone());
}

TEST(Resume, NeedsTheSameDeviceAndAFile) {
  const TempFolder folder;
  const ProcessResult bare = runGlintmark({"verify", "--resume"});
  EXPECT_EQ(bare.exit_code, 2);
  EXPECT_NE(bare.err.find("--resume needs the --json or --junit file"), std::string::npos);
  Process process(whole(folder), faultyEnvironment("stall=probeFma"));
  while (process.isRunning() && process.errSoFar().find("device/fma") == std::string::npos)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  process.send(SIGTERM);
  process.wait();
  std::vector<std::string> other = whole(folder);
  other.insert(other.end(), {"--resume", "--width", "1"});
  const ProcessResult refused = runGlintmark(other);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("its checks ran with width"), std::string::npos) << refused.err;
}

TEST(Opening, ADriverThatDiesThereIsNoUsableDevice) {
  const ProcessResult result = runFaulty({"verify", "--only", kTwoChecks}, "exit=opening");
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_NE(result.err.find("the process that opened the OpenCL device ended with exit code 7"),
            std::string::npos)
      << result.err;
}

// A request to end leaves the log and the trace of a benchmark.
TEST(Bench, KeepsRecordsAndTraceAtARequestToEnd) {
  const TempFolder folder;
  Process process({"bench", "zk16", "--quiet", "--scene", "screen_plane", "--size", "160x90",
                   "--reps", "10000", "-o", folder / "run", "--trace", folder / "trace.json"});
  while (process.isRunning() && !std::filesystem::exists(folder / "run/records.jsonl"))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  process.send(SIGTERM);
  const ProcessResult result = process.wait();
  EXPECT_EQ(result.exit_code, 143) << result.err;
  EXPECT_NE(result.err.find("--resume carries on"), std::string::npos) << result.err;
  EXPECT_FALSE(Json::parse(readFile(folder / "trace.json"))["traceEvents"].empty());
}

// Its programs of four lanes alone make the compiler die: the others are measured, and what was
// lost is all that is left for a sound driver.
TEST(Bench, ACompilerThatDiesCostsTheCaseAtHand) {
  const TempFolder folder;
  const std::vector<std::string> arguments = {"scale",  "screen_plane", "--axis", "lanes",
                                              "--size", "64x36",        "--reps", "1",
                                              "-o",     folder / "r"};
  const ProcessResult result = runFaulty(arguments, "build=WIDTH=4");
  EXPECT_EQ(result.exit_code, 1) << result.err << result.out;
  const std::string lost = "scaling screen_plane/steep/lanes=4 is lost";
  EXPECT_NE(result.err.find("note: " + lost + ", its process ended by signal 11"),
            std::string::npos)
      << result.err;
  EXPECT_NE(result.out.find(lost + ": its process ended by signal 11"), std::string::npos)
      << result.out;
  const Results results = readResults(folder / "r/results.json");
  EXPECT_EQ(std::ranges::count(results.records, "shading_ms", &Record::metric), 3);
  std::vector<std::string> resume = arguments;
  resume.push_back("--resume");
  const ProcessResult resumed = runGlintmark(resume);
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(countOf(resumed.out, "is lost"), 0u) << resumed.out;
  const Results whole = readResults(folder / "r/results.json");
  EXPECT_EQ(std::ranges::count(whole.records, "shading_ms", &Record::metric), 4);
}

// Methods are measured together, and lost one by one.
TEST(Bench, ACompilerThatDiesOfAMethodCostsThatMethodAlone) {
  const TempFolder folder;
  const ProcessResult result =
      runFaulty({"bench", "tao21", "--scene", "area_glass", "--view", "far", "--size", "32x18",
                 "--reps", "1", "-o", folder / "r"},
                "build=LTC_METHOD=1");
  EXPECT_EQ(result.exit_code, 1) << result.err << result.out;
  EXPECT_EQ(countOf(result.out, " is lost: "), 1u) << result.out;
  EXPECT_NE(result.out.find("tao21 area_glass/far/tao21 is lost: its process ended by signal 11"),
            std::string::npos)
      << result.out;
  const Results results = readResults(folder / "r/results.json");
  // Four of the five methods.
  EXPECT_EQ(std::ranges::count(results.records, "shading_ms", &Record::metric), 4);
}

TEST(Bench, ACompilerThatDiesOfANormalMethodCostsThatMethodAlone) {
  const TempFolder folder;
  const ProcessResult result = runFaulty({"bench", "tan05", "--scene", "desert", "--view", "far",
                                          "--reps", "1", "--width", "16", "-o", folder / "r"},
                                         "build=NORMAL_METHOD=vmf_lobes");
  EXPECT_EQ(result.exit_code, 1) << result.err << result.out;
  EXPECT_EQ(countOf(result.out, " is lost: "), 1u) << result.out;
  EXPECT_NE(result.out.find("tan05 desert/far/vmf_lobes is lost: its process ended by signal 11"),
            std::string::npos)
      << result.out;
  const Results results = readResults(folder / "r/results.json");
  EXPECT_EQ(std::ranges::count(results.records, "fps", &Record::metric), 13);
}

// A rank has nobody to go on in its place: what ended the run is said in one sentence.
TEST(Bench, ADriverThatEndsARankIsSaidOnce) {
  if (!canShareRanks()) GTEST_SKIP() << "mpirun or glintmark_mpi.so is not here";
  for (const auto& [faults, how] :
       {std::pair("crash=shade", "signal 11"), std::pair("exit=shade", "exit code 7")}) {
    const TempFolder folder;
    std::vector<std::string> environment = faultyEnvironment(faults);
    environment.emplace_back("POCL_DEVICES=pthread pthread");
    const ProcessResult result = runByRanks(2,
                                            {"bench", "zk16", "--quiet", "--scene", "screen_plane",
                                             "--size", "64x36", "--reps", "1", "-o", folder / "r"},
                                            environment);
    EXPECT_NE(result.exit_code, 0);
    EXPECT_EQ(countOf(result.err, "glintmark: "), 1u) << result.err;
    EXPECT_NE(result.err.find("of 2: its process ended "), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(how), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(" in zk16 screen_plane/"), std::string::npos) << result.err;
  }
}

TEST(Bench, ADriverThatDiesInEveryCaseIsNoUsableDevice) {
  const TempFolder folder;
  const ProcessResult result = runFaulty({"bench", "zk16", "--quiet", "--scene", "screen_plane",
                                          "--size", "64x36", "--reps", "1", "-o", folder / "r"},
                                         "exit=shade");
  EXPECT_EQ(result.exit_code, 3) << result.err << result.out;
  EXPECT_EQ(result.err,
            "glintmark: nothing could be measured: zk16 screen_plane/grazing is lost, its process "
            "ended with exit code 7\n");
}

// The process that measures must not outlive the one that was started.
TEST(Bench, AKilledRunLeavesNoProcess) {
  const TempFolder folder;
  Process process({"bench", "zk16", "--quiet", "--scene", "screen_plane", "--size", "64x36",
                   "--reps", "10000", "-o", folder / "run"});
  while (process.isRunning() && !std::filesystem::exists(folder / "run/records.jsonl"))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const std::vector<int> children = process.children();
  ASSERT_EQ(children.size(), 1u);
  process.kill();
  process.wait();
  const auto give_up = std::chrono::steady_clock::now() + kPatience;
  const auto gone = [&] { return ::kill(children[0], 0) != 0; };
  while (!gone() && std::chrono::steady_clock::now() < give_up)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(gone());
}

}  // namespace
}  // namespace glintmark
