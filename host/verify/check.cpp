#include "host/verify/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/error.h"
#include "host/core/stopwatch.h"

namespace glintmark {

Finding Finding::skipped(const std::string& reason) {
  Finding finding(0);
  finding.skipped_ = true;
  finding.violated_ = reason;
  return finding;
}

void Finding::add(double error) {
  worst_ = std::max(worst_, std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
}

void Finding::addMost(std::vector<double> errors, std::size_t least) {
  require(errors.size() >= least, "too few lights mirror enough");
  std::ranges::sort(errors);
  if (!errors.empty()) add(errors[errors.size() * 9 / 10]);
}

void Finding::require(bool holds, const std::string& what) {
  if (!holds && violated_.empty()) violated_ = what;
}

std::string verdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPass:
      return "pass";
    case Verdict::kFail:
      return "FAIL";
    case Verdict::kSkipped:
      break;
  }
  return "skipped";
}

CheckResult runCheck(const Check& check, const CheckContext& context) {
  CheckResult result;
  result.name = check.name;
  result.measure = check.measure;
  const Stopwatch watch;
  try {
    const Finding finding = check.run(context);
    result.verdict = finding.isSkipped() ? Verdict::kSkipped
                     : finding.passes()  ? Verdict::kPass
                                         : Verdict::kFail;
    result.worst = finding.worst();
    result.bound = finding.bound();
    result.note = finding.note();
  } catch (const DeviceError&) {
    throw;
  } catch (const Error& error) {
    result.verdict = Verdict::kFail;
    result.judged = false;
    result.worst = std::numeric_limits<double>::infinity();
    result.note = error.what();
  }
  result.seconds = watch.elapsedNs() * 1e-9;
  return result;
}

}  // namespace glintmark
