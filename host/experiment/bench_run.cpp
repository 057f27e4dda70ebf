#include "host/experiment/bench_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <thread>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/core/progress.h"
#include "host/core/trace.h"
#include "host/experiment/interrupt.h"
#include "host/experiment/run_inputs.h"
#include "host/experiment/survival.h"
#include "host/ocl/device_clock.h"
#include "host/parallel/ranks.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/records.h"
#include "host/report/record/terminal_text.h"

namespace glintmark {
namespace {

std::map<std::string, std::string> measurementKey(const CommonOptions& common,
                                                  const BenchOptions& options, int lanes) {
  std::map<std::string, std::string> key = {{"size", options.size},
                                            {"method", options.method},
                                            {"reps", std::to_string(options.reps)},
                                            {"width", std::to_string(lanes)}};
  if (common.timer != "auto") key["timer"] = common.timer;
  if (options.noise > 0) key["noise"] = fmt::format("{}", options.noise);
  if (options.max_time_s > 0) key["max_time_s"] = fmt::format("{}", options.max_time_s);
  if (options.warmup != 1) key["warmup"] = std::to_string(options.warmup);
  key.insert(options.more_key.begin(), options.more_key.end());
  if (!common.overrides.empty()) key["set"] = fmt::format("{}", fmt::join(common.overrides, " "));
  if (!common.mesh_file.empty()) key["mesh"] = common.mesh_file;
  if (!common.asset_folder.empty()) key["assets"] = common.asset_folder;
  return key;
}

// "first; second" as two lines.
std::string onLines(const std::string& reasons) {
  std::string text;
  for (std::size_t begin = 0; begin < reasons.size();) {
    const std::size_t end = std::min(reasons.find("; ", begin), reasons.size());
    text += "  " + reasons.substr(begin, end - begin) + "\n";
    begin = end + 2;
  }
  return text;
}

constexpr std::chrono::milliseconds kLook{2};  // for what other ranks send
constexpr double kMostTime_s = 30 * 86400.0;

// When so many seconds from now are over; 0: never.
Repetitions::Clock::time_point inSeconds(double seconds) {
  using Clock = Repetitions::Clock;
  if (!(seconds > 0)) return Clock::time_point::max();
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

// The end of one of `shares` equal parts of the time until then.
Repetitions::Clock::time_point shareOf(Repetitions::Clock::time_point until, std::size_t shares) {
  if (until == Repetitions::Clock::time_point::max()) return until;
  const auto now = Repetitions::Clock::now();
  return now + (until - now) / static_cast<std::ptrdiff_t>(std::max<std::size_t>(shares, 1));
}

// Of the time that the options give, what processes that died have left; 0: it has no end.
double timeLeft(const BenchOptions& options) {
  constexpr double kNext_s = 1e-9;
  if (options.max_time_s == 0) return 0;
  return std::max(kNext_s, options.max_time_s - secondsOfLostProcesses());
}

// "zk16 snow/steep is lost: ...", a line each.
std::string lostText() {
  std::string text;
  for (const LostCase& lost : lostCases())
    text += fmt::format("\n{} is lost: its process {}.\n", lost.name, lost.how);
  return text;
}

// The folder, once it is known that the results can be written.
std::filesystem::path checkedFolder(const BenchOptions& options) {
  if (options.reps < 1 || options.reps > 10000)
    throw Error(fmt::format("--reps {} is not from 1 to 10000", options.reps));
  if (options.warmup < 1 || options.warmup > 10000)
    throw Error(fmt::format("--warmup {} is not from 1 to 10000", options.warmup));
  if (!(options.noise >= 0 && options.noise <= 1))
    throw Error(fmt::format("--noise {} is not a percentage from 0 to 100", 100 * options.noise));
  if (!(options.max_time_s >= 0 && options.max_time_s <= kMostTime_s))
    throw Error(fmt::format("--max-time {} is not a number of seconds from 0 to {}",
                            options.max_time_s, kMostTime_s));
  if (!allRanks().isFirst()) return options.folder;
  requireWritableFolder(options.folder);
  const std::filesystem::path folder = options.folder;
  std::vector<OutputFile> outputs = {{"--json", options.json}, {"--csv", options.csv}};
  for (const char* name : {"results.json", "results.csv", "table.txt"})
    outputs.push_back({"-o", (folder / name).string()});
  announceOutputs(outputs);
  return options.folder;
}

RunInfo describeRunWithPeaks(const Session& session, const BenchOptions& options, Device& device,
                             ProgramCache& cache, bool times) {
  RunInfo info = describeRun(session, device);
  info.inputs = hashInputs(session.common, options.scenes);
  if (!times) return info;
  const DevicePeaks peaks = measurePeaks(device, cache, info.width);
  info.peak_gflops = peaks.gflops;
  info.peak_gbs = peaks.gbs;
  info.begin.peak_gflops = peaks.gflops;
  info.begin.peak_gbs = peaks.gbs;
  return info;
}

// The log of the first rank; others have none.
std::optional<RecordLog> openLog(const BenchOptions& options, const RunInfo& info) {
  if (!allRanks().isFirst()) return std::nullopt;
  const std::filesystem::path file = std::filesystem::path(options.folder) / "records.jsonl";
  return options.resume ? RecordLog::resume(file, info) : RecordLog::create(file, info);
}

}  // namespace

BenchRun::BenchRun(const Session& session, const BenchOptions& options)
    : session_(session),
      options_(options),
      device_(openDevice(session.common)),
      size_(parseSize(options.size)),
      method_(parseMethod(options.method)),
      folder_(checkedFolder(options)),
      times_(timesOnItsDevice()),
      lock_(allRanks().isFirst() ? std::make_unique<FolderLock>(folder_) : nullptr),
      cache_(device_),
      info_(describeRunWithPeaks(session, options, device_, cache_, times_)),
      key_(measurementKey(session.common, options, info_.width)),
      log_(openLog(options, info_)),
      until_(inSeconds(timeLeft(options))),
      table_until_(until_),
      case_until_(until_) {
  if (allRanks().isFirst()) removeAbandonedFiles(folder_);
  allRanks().any(false);  // peaks are measured before others use the processors
}

std::vector<Record> BenchRun::loggedCase(const std::string& table, const std::string& case_name,
                                         const std::vector<std::string>& metrics) const {
  std::vector<Record> records = log_->recordsOf(table, case_name, key_);
  const bool whole = std::ranges::all_of(metrics, [&](const std::string& metric) {
    return std::ranges::find(records, metric, &Record::metric) != records.end();
  });
  return whole ? records : std::vector<Record>();
}

// Of all ranks: which cases are missing, as the first knows, and who measures them.
void BenchRun::deal(Cases& cases, const std::vector<std::string>& metrics) {
  const Ranks& ranks = allRanks();
  cases.records.resize(cases.names.size());
  std::vector<std::string> missing;
  for (std::size_t i = 0; ranks.isFirst() && i < cases.names.size(); ++i) {
    if (isLost(cases.table, cases.names[i])) continue;
    cases.records[i] = loggedCase(cases.table, cases.names[i], metrics);
    if (cases.records[i].empty())
      missing.push_back(std::to_string(i));
    else
      ++cases.kept;
  }
  std::istringstream words(ranks.fromFirst(fmt::format("{}", fmt::join(missing, " "))));
  std::vector<std::string> names;
  for (std::size_t i = 0; words >> i;) {
    cases.missing.push_back(i);
    names.push_back(cases.names[i]);
  }
  const std::vector<std::string> timing = ranks.gather(times_ ? "times" : "");
  std::vector<int> measurers;
  for (std::size_t i = 0; i < timing.size(); ++i)
    if (!timing[i].empty()) measurers.push_back(static_cast<int>(i));
  cases.measurers = dealCases(names, measurers);
}

void BenchRun::take(Cases& cases, CaseMessage message) {
  if (!message.file.empty()) {
    writeFile(folder_ / message.file, message.content);
    return;
  }
  ++cases.arrived;
  if (message.records.empty()) {
    ++left_out_;
    return;
  }
  log_->append(message.records);
  cases.records[message.index] = std::move(message.records);
  ++cases.kept;
}

void BenchRun::takeArrived(Cases& cases) {
  for (const RankMessage& message : allRanks().arrived()) take(cases, unpackMessage(message.bytes));
}

// At the rank that measures it; `to_come`: so many cases share the time that is left to the table.
void BenchRun::measureOne(Cases& cases, std::size_t index, std::size_t to_come) {
  const std::string& name = cases.names[index];
  CaseMessage message{.index = index};
  if (Repetitions::Clock::now() < until_) {
    case_until_ = shareOf(table_until_, to_come);
    stopIfInterrupted();
    const CaseAtHand at_hand(cases.table, name);
    const TraceScope scope("case", isTracing() ? cases.table + "/" + name : std::string());
    const Timer timer = device_.clock().timer();
    message.records = cases.measure(name);
    // A case that two clocks have timed is measured again by the one that is left.
    if (device_.clock().timer() != timer) message.records = cases.measure(name);
  } else if (records_.empty() && cases.kept == 0 && allRanks().isFirst()) {
    throw Error(fmt::format("--max-time {} s is too short for one repetition of {} {}",
                            options_.max_time_s, cases.table, name));
  }
  if (allRanks().isFirst())
    take(cases, std::move(message));
  else
    allRanks().post(packMessage(message));
}

// The cases that are dealt to this rank; at the first also what others send, until all are there.
void BenchRun::measureMine(Cases& cases) {
  const Ranks& ranks = allRanks();
  Progress progress(session_.common.quiet);
  const auto mine = [&](std::size_t i) { return cases.measurers[i] == ranks.rank(); };
  std::size_t to_come = 0;
  for (std::size_t i = 0; i < cases.missing.size(); ++i) to_come += mine(i);
  for (std::size_t i = 0; i < cases.missing.size(); ++i) {
    if (!mine(i)) continue;
    const std::size_t index = cases.missing[i];
    progress.show(static_cast<int>(index), static_cast<int>(cases.names.size()),
                  cases.table + " " + cases.names[index]);
    measureOne(cases, index, to_come--);
    if (ranks.isFirst()) takeArrived(cases);
  }
  while (ranks.isFirst() && cases.arrived < cases.missing.size()) {
    stopIfInterrupted();
    std::this_thread::sleep_for(kLook);
    takeArrived(cases);
  }
}

// Of all ranks; the first says how well they shared it.
void BenchRun::prepareShared(const std::function<void()>& prepare) const {
  const Ranks& ranks = allRanks();
  const SharedTime time(ranks);
  prepare();
  const SharedTime::Spent spent = time.spent();
  if (session_.common.quiet) return;
  fmt::print(stderr, "note: what cases share took {} ranks {:.2f} s, {:.1f} % of it waiting\n",
             ranks.size(), spent.wall_s, 100 * spent.waiting);
}

void BenchRun::measureCases(const std::string& table, const std::vector<std::string>& cases,
                            const std::vector<std::string>& metrics,
                            const std::function<std::vector<Record>(const std::string&)>& measure,
                            const std::function<void()>& prepare) {
  Cases all{table, cases, measure};
  const auto kept = [&] {
    if (allRanks().isFirst()) takeArrived(all);
    return Interrupted(
        fmt::format("interrupted; {} of {} cases of table {} are kept in {}, --resume carries on",
                    all.kept, cases.size(), table, (folder_ / "records.jsonl").string()));
  };
  try {
    deal(all, metrics);
    if (prepare && !all.missing.empty() && &allRanks() != &aloneRanks()) prepareShared(prepare);
    measureMine(all);
  } catch (const Interrupted&) {
    throw kept();
  } catch (const Error&) {
    // A compiler inside the OpenCL runtime may drop its files at Ctrl-C: no fault of the kernel.
    if (InterruptGuard::interrupted()) throw kept();
    throw;
  }
  for (const std::vector<Record>& records : all.records)
    records_.insert(records_.end(), records.begin(), records.end());
}

void BenchRun::keepPicture(const Image& picture, const std::string& file) {
  if (allRanks().isFirst()) return writePng(picture, folder_ / file);
  const std::filesystem::path copy =
      std::filesystem::temp_directory_path() / fmt::format("glintmark_{}_{}", getpid(), file);
  writePng(picture, copy);
  CaseMessage message{.file = file, .content = readFile(copy, FileRole::kOwn)};
  std::filesystem::remove(copy);
  allRanks().post(packMessage(message));
}

Repetitions BenchRun::reps() const {
  return {options_.reps, options_.noise, case_until_};
}

void BenchRun::shareTime(std::size_t tables) {
  table_until_ = shareOf(until_, tables);
}

void BenchRun::addDerived(const std::vector<Record>& derived) {
  for (const Record& record : derived) {
    const auto last = std::find_if(records_.rbegin(), records_.rend(), [&](const Record& other) {
      return other.table == record.table && other.case_ == record.case_;
    });
    records_.insert(last.base(), record);
  }
}

ShadingOptions BenchRun::shading() const {
  return {.width_px = size_.width_px, .height_px = size_.height_px, .lanes = info_.width};
}

Record BenchRun::record(const TableSpec& table, const std::string& case_name,
                        const std::string& metric, const std::vector<double>& samples,
                        const std::string& note) const {
  Record record;
  record.table = table.name;
  record.case_ = case_name;
  record.metric = metric;
  record.unit = table.metric(metric).unit;
  record.value = summarize(samples);
  record.note = note;
  record.config = key_;
  record.timer = timerName(device_.clock().timer());
  return record;
}

std::vector<Record> BenchRun::recordsOf(const std::string& table) const {
  std::vector<Record> chosen;
  std::ranges::copy_if(records_, std::back_inserter(chosen),
                       [&](const Record& record) { return record.table == table; });
  return chosen;
}

void BenchRun::noteEnd() {
  // Before the peaks, which keep the processors busy themselves.
  info_.end = machineState();
  info_.others_cores = watch_.othersCores();
  info_.throttled_s = watch_.throttledSeconds();
  const DevicePeaks peaks = measurePeaks(device_, cache_, info_.width);
  info_.end.peak_gflops = peaks.gflops;
  info_.end.peak_gbs = peaks.gbs;
  info_.busy = busyText(info_);
}

int BenchRun::finish(const std::string& tables) {
  noteEnd();
  std::string text = tables;
  if (std::ranges::count(records_, "wall", &Record::timer) > 0)
    text += "\nKernels are timed by the wall clock.\n";
  if (left_out_ > 0)
    text += fmt::format("\n{} cases are left out: the {} s of --max-time were over.\n", left_out_,
                        options_.max_time_s);
  text += lostText();
  if (!info_.busy.empty()) text += "\nThe machine was busy:\n" + onLines(info_.busy);
  const std::string json = toJson({info_, records_}), csv = toCsv(records_);
  try {
    writeFile(folder_ / "results.json", json);
    writeFile(folder_ / "results.csv", csv);
    writeFile(folder_ / "table.txt", text);
    if (!options_.json.empty()) writeFile(options_.json, json);
    if (!options_.csv.empty()) writeFile(options_.csv, csv);
  } catch (const Error& error) {
    throw Error(fmt::format("{}; all records are in {}, --resume writes the files from them",
                            error.what(), (folder_ / "records.jsonl").string()));
  }
  printText("{}", text);
  fmt::print("\nwritten to {}\n", folder_.string());
  const bool whole = std::ranges::all_of(records_, &Record::valid) && lostCases().empty();
  return whole ? kExitDone : kExitCheckFailed;
}

std::vector<std::string> selectNames(const std::vector<std::string>& known,
                                     const std::vector<std::string>& chosen) {
  if (chosen.empty()) return known;
  std::vector<std::string> names;
  std::ranges::copy_if(known, std::back_inserter(names), [&](const std::string& name) {
    return std::ranges::find(chosen, name) != chosen.end();
  });
  return names;
}

std::string invalidText(std::span<const Record> records) {
  std::string text, last_case;
  for (const Record& record : records) {
    if (record.valid || record.case_ == last_case) continue;
    text += fmt::format("{} {:.75}\n", record.case_, record.note);
    last_case = record.case_;
  }
  return text;
}

void stopIfInterrupted() {
  if (InterruptGuard::interrupted()) throw Interrupted("interrupted");
}

}  // namespace glintmark
