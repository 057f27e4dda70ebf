#include "host/verify/verification.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/json_depth.h"
#include "host/report/record/record_log.h"
#include "host/report/record/records.h"
#include "host/verify/check_result_json.h"

namespace glintmark {
namespace {

// Text as XML 1.0 allows it; what it has no place for becomes a question mark.
std::string xmlText(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else if (c == '\n')
      escaped += "&#10;";
    else
      escaped +=
          static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e ? '?' : c;
  }
  return escaped;
}

std::string junitCase(const CheckResult& r) {
  const std::size_t slash = r.name.find('/');
  const std::string group = r.name.substr(0, slash);
  const std::string property = slash == std::string::npos ? r.name : r.name.substr(slash + 1);
  std::string text = fmt::format("  <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"",
                                 xmlText(group), xmlText(property), r.seconds);
  const std::string found = fmt::format("{}: {:.3g}, at most {:.3g}{}{}", r.measure, r.worst,
                                        r.bound, r.note.empty() ? "" : "; ", r.note);
  if (r.verdict == Verdict::kFail)
    return text + fmt::format("><failure message=\"{}\"/></testcase>\n", xmlText(found));
  if (r.verdict == Verdict::kSkipped)
    return text + fmt::format("><skipped message=\"{}\"/></testcase>\n", xmlText(r.note));
  return text + "/>\n";
}

void requireSameSetup(const RunInfo& old_run, const RunInfo& run, const std::string& file) {
  requireSharedFacts(file, "its checks ran",
                     {{"program version", old_run.git, run.git},
                      {"device", old_run.device, run.device},
                      {"driver", old_run.driver, run.driver},
                      {"kernels, tables and scenes", old_run.inputs, run.inputs},
                      {"platform", old_run.platform, run.platform},
                      {"width", std::to_string(old_run.width), std::to_string(run.width)}});
}

std::string lineOf(const CheckResult& result) {
  using Json = nlohmann::ordered_json;
  return withChecksum(
             checkResultJson(result).dump(-1, ' ', false, Json::error_handler_t::replace)) +
         "\n";
}

// The whole lines; the last may have been cut off.
std::vector<std::string> wholeLines(const std::string& text) {
  std::istringstream stream(text.substr(0, text.rfind('\n') + 1));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(std::move(line));
  return lines;
}

std::map<std::string, CheckResult> readLog(const std::filesystem::path& file, const RunInfo& run) {
  std::map<std::string, CheckResult> kept;
  if (!std::filesystem::exists(file)) return kept;
  std::vector<std::string> lines = wholeLines(readFile(file, FileRole::kOwn));
  if (lines.empty()) return kept;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (const std::string where = fmt::format("{} line {}", file.string(), i + 1);
        !takeChecksum(lines[i], where))
      throw Error(where +
                  " is damaged: its checksum is missing; run without --resume to start over");
  requireSameSetup(parseHeaderLine(lines.front(), file.string()), run, file.string());
  try {
    for (std::size_t i = 1; i < lines.size(); ++i) {
      checkJsonDepth(lines[i], file.string());
      CheckResult result = checkResultFromJson(nlohmann::ordered_json::parse(lines[i]));
      kept[result.name] = std::move(result);
    }
  } catch (const nlohmann::json::exception& error) {
    throw Error(fmt::format("{} is not a log of checks ({}); run without --resume to start over",
                            file.string(), error.what()));
  }
  return kept;
}

}  // namespace

std::size_t Verification::count(Verdict verdict) const {
  return static_cast<std::size_t>(std::ranges::count(results, verdict, &CheckResult::verdict));
}

std::string verificationJson(const Verification& v) {
  const RunInfo& run = v.run;
  nlohmann::ordered_json json = {{"schema", "glintmark.verification/1"},
                                 {"run",
                                  {{"date", run.date},
                                   {"git", run.git},
                                   {"command", run.command},
                                   {"cpu", run.cpu},
                                   {"cores", run.cores},
                                   {"device", run.device},
                                   {"driver", run.driver},
                                   {"platform", run.platform},
                                   {"width", run.width}}},
                                 {"chosen", v.chosen},
                                 {"passed", v.count(Verdict::kPass)},
                                 {"failed", v.count(Verdict::kFail)},
                                 {"skipped", v.count(Verdict::kSkipped)},
                                 {"seconds", v.seconds}};
  nlohmann::ordered_json& list = json["checks"] = nlohmann::ordered_json::array();
  for (const CheckResult& r : v.results) list.push_back(checkResultJson(r));
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string verificationJunit(const Verification& v) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuites>\n<testsuite name=\"glintmark verify\" tests=\"{}\" failures=\"{}\" "
      "errors=\"0\" skipped=\"{}\" time=\"{:.3f}\" timestamp=\"{}\">\n  <properties>\n",
      v.results.size(), v.count(Verdict::kFail), v.count(Verdict::kSkipped), v.seconds,
      xmlText(v.run.date));
  for (const auto& [name, value] : {std::pair{"device", v.run.device},
                                    {"driver", v.run.driver},
                                    {"platform", v.run.platform},
                                    {"width", std::to_string(v.run.width)},
                                    {"git", v.run.git},
                                    {"chosen", std::to_string(v.chosen)}})
    text += fmt::format("    <property name=\"{}\" value=\"{}\"/>\n", name, xmlText(value));
  text += "  </properties>\n";
  for (const CheckResult& r : v.results) text += junitCase(r);
  return text + "</testsuite>\n</testsuites>\n";
}

VerificationLog::VerificationLog(const std::filesystem::path& file, const RunInfo& run, bool resume)
    : file_(file) {
  if (resume) kept_ = readLog(file, run);
  std::string text = withChecksum(headerLine(run)) + "\n";
  for (const auto& [name, result] : kept_) text += lineOf(result);
  writeFile(file, text);  // whole or not at all: what was kept stays kept
  descriptor_ = open(file.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor_ < 0)
    throw Error(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)));
}

VerificationLog::~VerificationLog() {
  if (descriptor_ >= 0) close(descriptor_);
}

VerificationLog::VerificationLog(VerificationLog&& other) noexcept
    : file_(std::move(other.file_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      kept_(std::move(other.kept_)) {}

VerificationLog& VerificationLog::operator=(VerificationLog&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(kept_, other.kept_);
  return *this;
}

void VerificationLog::append(const CheckResult& result) {
  if (descriptor_ >= 0) writeAll(descriptor_, lineOf(result), file_);
}

void VerificationLog::discard() {
  std::error_code error;
  if (!file_.empty()) std::filesystem::remove(file_, error);
}

}  // namespace glintmark
