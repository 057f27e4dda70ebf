#include "host/report/record/record_log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <utility>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/fnv1a.h"
#include "host/core/output_files.h"
#include "host/report/record/records.h"

namespace glintmark {
namespace {

void requireSameSetup(const RunInfo& old_run, const RunInfo& run, const std::string& path) {
  requireSharedFacts(path, "it was measured",
                     {{"program version", old_run.git, run.git},
                      {"device", old_run.device, run.device},
                      {"driver", old_run.driver, run.driver},
                      {"kernels, tables, scenes and meshes", old_run.inputs, run.inputs},
                      {"width", std::to_string(old_run.width), std::to_string(run.width)}});
}

// The last field of a line: "sum", of all that stands before it.
constexpr std::string_view kChecksumStart = ",\"sum\":\"";
constexpr std::size_t kChecksumBytes = kChecksumStart.size() + 16 + 2;

}  // namespace

void requireSharedFacts(const std::string& file, const char* made,
                        std::initializer_list<SharedFact> facts) {
  for (const SharedFact& fact : facts) {
    if (fact.before == fact.now) continue;
    throw Error(fmt::format(
        "cannot resume {}: {} with {} '{}', not '{}'; run without --resume to start over", file,
        made, fact.name, fact.before, fact.now));
  }
}

bool takeChecksum(std::string& line, const std::string& source) {
  if (line.size() < kChecksumBytes) return false;
  const std::string_view end = std::string_view(line).substr(line.size() - kChecksumBytes);
  if (!end.starts_with(kChecksumStart) || !end.ends_with("\"}")) return false;
  const std::string wanted(end.substr(kChecksumStart.size(), 16));
  line.resize(line.size() - kChecksumBytes);
  if (fmt::format("{:016x}", fnv1a(line)) != wanted)
    throw Error(
        fmt::format("{} is damaged: its checksum is another's; run without --resume to start "
                    "over",
                    source));
  line += '}';
  return true;
}

std::string withChecksum(std::string line) {
  line.pop_back();
  return line + fmt::format("{}{:016x}\"}}", kChecksumStart, fnv1a(line));
}

RecordLog::RecordLog(std::filesystem::path path, bool keep) : path_(std::move(path)) {
  const int start = keep ? 0 : O_TRUNC;
  // A pipe would be waited for, and what a symbolic link names would be emptied.
  descriptor_ =
      open(path_.c_str(),
           O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | start, 0644);
  if (descriptor_ < 0) {
    throw Error(fmt::format("cannot write {}: {}", path_.string(), std::strerror(errno)));
  }
}

RecordLog::RecordLog(RecordLog&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      records_(std::move(other.records_)) {}

RecordLog::~RecordLog() {
  if (descriptor_ >= 0) close(descriptor_);
}

LogContent parseLog(const std::string& text, const std::string& source) {
  LogContent content;
  std::vector<Record> batch;
  bool all_have = false;  // checksums; logs of earlier versions have none
  std::size_t begin = 0;
  for (int line_number = 1; begin < text.size(); ++line_number) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;
    std::string line = text.substr(begin, end - begin);
    const std::string line_source = fmt::format("{} line {}", source, line_number);
    begin = end + 1;
    const bool has_checksum = takeChecksum(line, line_source);
    if (line_number == 1) all_have = has_checksum;
    if (all_have && !has_checksum)
      throw Error(fmt::format("{} is damaged: its checksum is missing", line_source));
    if (line_number == 1) {
      content.run = parseHeaderLine(line, line_source);
    } else {
      LogLine parsed = parseRecordLine(line, line_source);
      batch.push_back(std::move(parsed.record));
      if (parsed.more > 0) continue;
    }
    std::ranges::move(batch, std::back_inserter(content.records));
    batch.clear();
    content.whole_bytes = begin;
  }
  return content;
}

RecordLog RecordLog::create(const std::filesystem::path& path, const RunInfo& run) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw Error(
        fmt::format("{} is no regular file, expected a log or none; remove it", path.string()));
  if (std::filesystem::is_regular_file(path, error)) {
    std::filesystem::path old = path;
    old += ".old";
    requireNoInput(path);
    requireNoInput(old);
    std::filesystem::rename(path, old, error);
    if (error) throw Error(fmt::format("cannot rename {}: {}", path.string(), error.message()));
  }
  RecordLog log(path, false);
  writeAll(log.descriptor_, withChecksum(headerLine(run)) + "\n", path);
  return log;
}

RecordLog RecordLog::resume(const std::filesystem::path& path, const RunInfo& run) {
  if (!std::filesystem::exists(path)) return create(path, run);
  LogContent content = parseLog(readFile(path, FileRole::kOwn), path.string());
  if (!content.run) return create(path, run);
  requireSameSetup(*content.run, run, path.string());

  RecordLog log(path, true);
  log.records_ = std::move(content.records);
  if (ftruncate(log.descriptor_, static_cast<off_t>(content.whole_bytes)) != 0) {
    throw Error(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  }
  return log;
}

void RecordLog::append(std::span<const Record> records) {
  std::string lines;
  for (std::size_t i = 0; i < records.size(); ++i)
    lines += withChecksum(recordLine(records[i], records.size() - 1 - i)) + "\n";
  const off_t size_before = lseek(descriptor_, 0, SEEK_END);
  try {
    writeAll(descriptor_, lines, path_);
    if (fsync(descriptor_) != 0 && errno != EINVAL) {
      throw Error(fmt::format("cannot write {}: {}", path_.string(), std::strerror(errno)));
    }
  } catch (const Error&) {
    // Not needed for a later resume; it keeps the log readable for people and gives the space back.
    if (size_before >= 0 && ftruncate(descriptor_, size_before) != 0) errno = 0;
    throw;
  }
  records_.insert(records_.end(), records.begin(), records.end());
}

std::vector<Record> RecordLog::recordsOf(const std::string& table, const std::string& case_name,
                                         const std::map<std::string, std::string>& config) const {
  std::vector<Record> found;
  for (const Record& record : records_) {
    const bool matches = record.table == table && record.case_ == case_name &&
                         std::ranges::includes(record.config, config);
    if (!matches) continue;
    const auto old = std::ranges::find(found, record.metric, &Record::metric);
    if (old == found.end()) {
      found.push_back(record);
    } else {
      *old = record;
    }
  }
  return found;
}

}  // namespace glintmark
