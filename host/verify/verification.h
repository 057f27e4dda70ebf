// What a run of checks found: as files, and as it comes.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "host/report/record/record.h"
#include "host/verify/check.h"

namespace glintmark {

struct Verification {
  RunInfo run;
  std::vector<CheckResult> results;
  std::size_t chosen = 0;  // checks that were asked for; fewer results if it was interrupted
  double seconds = 0;

  std::size_t count(Verdict verdict) const;
};

/// Schema glintmark.verification/1.
std::string verificationJson(const Verification& verification);

/// JUnit's XML: one suite, a test case for each check, its group as the class.
std::string verificationJunit(const Verification& verification);

/// Results that are kept as they come: the run's line of JSON, then one for each check.
class VerificationLog {
 public:
  /// Keeps nothing.
  VerificationLog() = default;
  /// Starts `file`, or with `resume` carries on with what it holds whole. Throws Error if it cannot
  /// be written, or if what it holds was found by another program or on another device.
  VerificationLog(const std::filesystem::path& file, const RunInfo& run, bool resume);
  ~VerificationLog();
  VerificationLog(VerificationLog&& other) noexcept;
  VerificationLog& operator=(VerificationLog&& other) noexcept;

  /// Results of earlier runs by name.
  const std::map<std::string, CheckResult>& kept() const { return kept_; }
  void append(const CheckResult& result);
  /// Removes the file: its results stand elsewhere.
  void discard();

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::map<std::string, CheckResult> kept_;
};

}  // namespace glintmark
