// The running log of a benchmark: one JSON line per record, on the disk before the next is
// measured.
#pragma once
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/report/record/record.h"

namespace glintmark {

/// A fact of a run that whoever resumes it must share: its name, as it was, and as it is.
struct SharedFact {
  const char* name;
  const std::string &before, &now;
};
/// Throws Error naming the first of `facts` that differs; `made`: what was done with it, "it was
/// measured" say.
void requireSharedFacts(const std::string& file, const char* made,
                        std::initializer_list<SharedFact> facts);

/// What a log holds up to the end of its last whole batch.
struct LogContent {
  std::optional<RunInfo> run;  // nothing if not even the first line is whole
  std::vector<Record> records;
  std::size_t whole_bytes = 0;  // of the text, up to there
};

/// Reads the text of a log. The end of a log may be cut off, in the middle of a line or of a batch;
/// that batch is left out. Throws Error for another schema, damage before the last line, and a line
/// that is not as it was written.
LogContent parseLog(const std::string& text, const std::string& source);

/// A line of a log, which is a JSON object, with a field "sum" at its end: a hash of all before it.
std::string withChecksum(std::string line);
/// Takes that field off again; false if there is none. Throws Error naming `source` if the line is
/// not what it was.
bool takeChecksum(std::string& line, const std::string& source);

class RecordLog {
 public:
  /// Starts an empty log. An old one is kept as `<path>.old`, in place of what had that name.
  static RecordLog create(const std::filesystem::path& path, const RunInfo& run);
  /// Opens a log to carry on with it. A batch that was cut off is dropped. If there is no log,
  /// starts one. Throws Error if the log is of another schema, device, driver, width, program
  /// version or other inputs, or if a line before the last is damaged.
  static RecordLog resume(const std::filesystem::path& path, const RunInfo& run);

  ~RecordLog();
  RecordLog(RecordLog&& other) noexcept;
  RecordLog& operator=(RecordLog&&) = delete;

  /// Appends the records as one batch, which a resumed log holds whole or not at all, and waits
  /// until they are on the disk. Throws Error if they cannot be written; the log is as before then.
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
