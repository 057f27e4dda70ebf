// Results of checks as lines of JSON, for the pipe from a child process and for the log.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "host/verify/check.h"

namespace glintmark {

nlohmann::ordered_json checkResultJson(const CheckResult& result);
/// Inverse; an unknown worst error is infinite. Throws nlohmann's exceptions.
CheckResult checkResultFromJson(const nlohmann::ordered_json& json);

}  // namespace glintmark
