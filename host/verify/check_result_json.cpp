#include "host/verify/check_result_json.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace glintmark {

nlohmann::ordered_json checkResultJson(const CheckResult& r) {
  nlohmann::ordered_json json = {{"name", r.name},       {"verdict", verdictName(r.verdict)},
                                 {"worst", nullptr},     {"bound", r.bound},
                                 {"of", r.measure},      {"note", r.note},
                                 {"seconds", r.seconds}, {"judged", r.judged}};
  if (std::isfinite(r.worst)) json["worst"] = r.worst;
  return json;
}

CheckResult checkResultFromJson(const nlohmann::ordered_json& json) {
  CheckResult r;
  json.at("name").get_to(r.name);
  const std::string verdict = json.at("verdict");
  for (const Verdict v : {Verdict::kPass, Verdict::kFail, Verdict::kSkipped})
    if (verdictName(v) == verdict) r.verdict = v;
  r.worst = json.at("worst").is_null() ? std::numeric_limits<double>::infinity()
                                       : json.at("worst").get<double>();
  json.at("bound").get_to(r.bound);
  json.at("of").get_to(r.measure);
  json.at("note").get_to(r.note);
  json.at("seconds").get_to(r.seconds);
  r.judged = json.value("judged", true);
  return r;
}

}  // namespace glintmark
