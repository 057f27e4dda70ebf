// One `bench` command: the device, the options, the log, and the cases that it measures.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/core/image.h"
#include "host/experiment/case_message.h"
#include "host/experiment/repetitions.h"
#include "host/experiment/session.h"
#include "host/frame/shading_options.h"
#include "host/ocl/compute.h"
#include "host/report/record/folder_lock.h"
#include "host/report/record/machine.h"
#include "host/report/record/record.h"
#include "host/report/record/record_log.h"
#include "host/report/record/table_spec.h"

namespace glintmark {

struct BenchOptions {
  std::vector<std::string> scenes, views;  // empty: all
  std::string size = "1920x1080", method = defaultMethod();
  int reps = 9;  // of every measurement, at least
  double noise =
      0;  // standard error of a median that ends it, as a fraction of the median; 0: none
  double max_time_s = 0;  // for all that is measured; 0: as long as it takes
  int warmup = 1;         // frames before those that are timed
  std::string folder = "results/latest";
  std::string json, csv;  // further copies, empty for none
  std::string trace;      // file for the run's intervals, empty for none
  bool resume = false;
  std::uint64_t rays = 0;  // most rays of a simulation, where a command has simulations
  std::map<std::string, std::string> more_key{};  // further entries of BenchRun::key()
};

/// What a table measures and prints. Cases are measured in order, each once. Where several ranks
/// run it, files, records and the log are the first's; each that has a device of its own measures
/// some of the cases.
class BenchRun {
 public:
  /// Of all ranks. Checks the options, the folder and the files, opens the device, locks the
  /// folder, measures the device's peaks and opens the log. Throws Error for whatever is wrong with
  /// them.
  BenchRun(const Session& session, const BenchOptions& options);

  const Session& session() const { return session_; }
  const BenchOptions& options() const { return options_; }
  const std::filesystem::path& folder() const { return folder_; }
  /// What the options' size and method say.
  ImageSize size() const { return size_; }
  GlintMethod method() const { return method_; }
  /// Of the rasterizer; 0: all cores.
  int threads() const { return session_.common.threads; }
  /// Defaults at the options' size and with the run's lanes; the method stays the default.
  ShadingOptions shading() const;
  Device& device() { return device_; }
  ProgramCache& cache() { return cache_; }
  const RunInfo& info() const { return info_; }

  /// Options of the command line that tell one measurement of a case from another; every record's
  /// configuration starts from them.
  const std::map<std::string, std::string>& key() const { return key_; }

  /// How often the case that is being measured is timed: as the options say, and not beyond its
  /// share of the time.
  Repetitions reps() const;

  /// The table that is measured next is one of so many that share the time that is left.
  void shareTime(std::size_t tables);

  /// Measures the cases that the log does not hold whole (a record of each of `metrics`, measured
  /// with the same key), shows progress, and logs each as soon as it is there. Records of both
  /// kinds are kept in the order of `cases`. After Ctrl-C throws Interrupted, which says what is
  /// kept. Cases for which no time is left are left out; throws Error if nothing is measured then.
  /// Of all ranks, each of which calls `measure` for the cases that are dealt to it alone; before,
  /// if a launcher started them and any case is missing, each calls `prepare`, which may share its
  /// work.
  void measureCases(const std::string& table, const std::vector<std::string>& cases,
                    const std::vector<std::string>& metrics,
                    const std::function<std::vector<Record>(const std::string& case_name)>& measure,
                    const std::function<void()>& prepare = {});

  /// Writes a picture of the case that is being measured to `file` in the folder, at the first
  /// rank.
  void keepPicture(const Image& picture, const std::string& file);

  /// Adds records that follow from measured ones, each behind the last record of its case. They are
  /// not logged: a resumed run makes them anew.
  void addDerived(const std::vector<Record>& derived);

  /// A record of `table` in the metric's unit, with the key as its configuration; `samples` not
  /// empty. Throws Error if the table has no such metric.
  Record record(const TableSpec& table, const std::string& case_name, const std::string& metric,
                const std::vector<double>& samples, const std::string& note = "") const;

  /// Records of this run, of one table or of all, in order.
  std::vector<Record> recordsOf(const std::string& table) const;
  const std::vector<Record>& records() const { return records_; }

  /// Measures the peaks once more, writes results.json, results.csv, table.txt and the copies asked
  /// for, and prints the tables, which clock timed them and whether the machine was busy.
  /// Returns kExitCheckFailed if some record is not valid. Throws Error if a file cannot be
  /// written; the log has all records then.
  int finish(const std::string& tables);

 private:
  // One call of measureCases().
  struct Cases {
    const std::string& table;
    const std::vector<std::string>& names;
    const std::function<std::vector<Record>(const std::string&)>& measure;
    std::vector<std::size_t> missing{};          // of the names, which the log does not hold
    std::vector<int> measurers{};                // of the missing ones: a rank each
    std::vector<std::vector<Record>> records{};  // by name; at the first rank
    std::size_t kept = 0, arrived = 0;           // names with records; of the missing ones
  };
  std::vector<Record> loggedCase(const std::string& table, const std::string& case_name,
                                 const std::vector<std::string>& metrics) const;
  void prepareShared(const std::function<void()>& prepare) const;
  void deal(Cases& cases, const std::vector<std::string>& metrics);
  void measureMine(Cases& cases);
  void measureOne(Cases& cases, std::size_t index, std::size_t to_come);
  void take(Cases& cases, CaseMessage message);
  void takeArrived(Cases& cases);

  void noteEnd();

  const Session& session_;
  const BenchOptions& options_;
  MachineWatch watch_;
  Device device_;
  ImageSize size_;
  GlintMethod method_;
  std::filesystem::path folder_;      // made only once there is a device
  bool times_;                        // does this rank measure cases?
  std::unique_ptr<FolderLock> lock_;  // at the first rank
  ProgramCache cache_;
  RunInfo info_;
  std::map<std::string, std::string> key_;
  std::optional<RecordLog> log_;  // at the first rank
  std::vector<Record> records_;
  Repetitions::Clock::time_point until_, table_until_, case_until_;  // when time is over
  std::size_t left_out_ = 0;                                         // cases, for want of time
};

/// One table: what it says of itself, and how `bench` measures and prints it.
struct BenchTable {
  TableSpec spec;
  std::vector<std::string> scenes{}, views{};          // what --scene and --view may name
  void (*measure)(BenchRun& run) = nullptr;            // null: a command of its own measures it
  std::string (*text)(const BenchRun& run) = nullptr;  // at most kTableColumnsLimit columns
};

/// Names among `known` that `chosen` names, in the order of `known`; all if `chosen` is empty.
std::vector<std::string> selectNames(const std::vector<std::string>& known,
                                     const std::vector<std::string>& chosen);

/// "zk16/snow/steep not valid: why", one line per case with a record that is not valid.
std::string invalidText(std::span<const Record> records);

/// Throws Interrupted if Ctrl-C was pressed; for use between repetitions.
void stopIfInterrupted();

}  // namespace glintmark
