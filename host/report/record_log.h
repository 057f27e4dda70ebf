// The running log of a benchmark: one JSON line per record, on the disk before the next is
// measured.
#pragma once
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/report/record.h"

namespace glintmark {

class RecordLog {
 public:
  /// Starts an empty log, replacing an old one.
  static RecordLog create(const std::filesystem::path& path, const RunInfo& run);
  /// Opens a log to carry on with it. A last line that was cut off is dropped. If there is no log,
  /// starts one. Throws Error if the log is of another schema, device, width or program version, or
  /// if a line before the last is damaged.
  static RecordLog resume(const std::filesystem::path& path, const RunInfo& run);

  ~RecordLog();
  RecordLog(RecordLog&& other) noexcept;
  RecordLog& operator=(RecordLog&&) = delete;

  /// Appends the records and waits until they are on the disk.
  void append(std::span<const Record> records);
  /// All records of the log, old ones first.
  const std::vector<Record>& records() const { return records_; }
  /// The latest record of each metric of a case, among those whose configuration has every entry of
  /// `config` (and perhaps more), in the order of the log.
  std::vector<Record> recordsOf(const std::string& table, const std::string& case_name,
                                const std::map<std::string, std::string>& config) const;

 private:
  RecordLog(std::filesystem::path path, bool keep);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::vector<Record> records_;
};

}  // namespace glintmark
