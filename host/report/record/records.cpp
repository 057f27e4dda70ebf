#include "host/report/record/records.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/fnv1a.h"
#include "host/core/json_depth.h"

namespace glintmark {
namespace {

using Json = nlohmann::ordered_json;

Json stateToJson(const MachineState& state) {
  return {{"load", state.load},
          {"clock_mhz", state.clock_mhz},
          {"peak_gflops", state.peak_gflops},
          {"peak_gbs", state.peak_gbs}};
}

Json runToJson(const RunInfo& run) {
  return {{"date", run.date},
          {"git", run.git},
          {"command", run.command},
          {"cpu", run.cpu},
          {"cores", run.cores},
          {"device", run.device},
          {"driver", run.driver},
          {"platform", run.platform},
          {"width", run.width},
          {"peak_gflops", run.peak_gflops},
          {"peak_gbs", run.peak_gbs},
          {"inputs", run.inputs},
          {"memory_bytes", run.memory_bytes},
          {"begin", stateToJson(run.begin)},
          {"end", stateToJson(run.end)},
          {"others_cores", run.others_cores},
          {"throttled_s", run.throttled_s},
          {"busy", run.busy}};
}

// A whole number that T can hold; the library casts whatever number it finds.
template <typename T>
T wholeNumber(const Json& json, const char* name) {
  const double value = json.at(name).get<double>();
  if (!(value >= 0 && value <= 1e9 && value == std::floor(value)))
    throw Error(fmt::format("field {} is {}, not a whole number from 0 to 1e9", name, value));
  return static_cast<T>(value);
}

MachineState stateFromJson(const Json& json) {
  return {json.at("load").get<double>(), json.at("clock_mhz").get<double>(),
          json.at("peak_gflops").get<double>(), json.at("peak_gbs").get<double>()};
}

RunInfo runFromJson(const Json& json) {
  RunInfo run;
  json.at("date").get_to(run.date);
  json.at("git").get_to(run.git);
  json.at("command").get_to(run.command);
  json.at("cpu").get_to(run.cpu);
  run.cores = wholeNumber<int>(json, "cores");
  json.at("device").get_to(run.device);
  json.at("driver").get_to(run.driver);
  json.at("platform").get_to(run.platform);
  run.width = wholeNumber<int>(json, "width");
  json.at("peak_gflops").get_to(run.peak_gflops);
  json.at("peak_gbs").get_to(run.peak_gbs);
  run.inputs = json.value("inputs", "");
  if (!json.contains("busy")) return run;  // of an older program
  run.memory_bytes = static_cast<unsigned long long>(json.at("memory_bytes").get<double>());
  run.begin = stateFromJson(json.at("begin"));
  run.end = stateFromJson(json.at("end"));
  json.at("others_cores").get_to(run.others_cores);
  json.at("throttled_s").get_to(run.throttled_s);
  json.at("busy").get_to(run.busy);
  return run;
}

bool isFinite(const Summary& s) {
  return std::isfinite(s.median) && std::isfinite(s.min) && std::isfinite(s.p95) &&
         std::isfinite(s.stddev);
}

Json recordToJson(const Record& record) {
  // nlohmann writes NaN and infinity as null.
  return {{"table", record.table},
          {"case", record.case_},
          {"metric", record.metric},
          {"unit", record.unit},
          {"median", record.value.median},
          {"min", record.value.min},
          {"p95", record.value.p95},
          {"stddev", record.value.stddev},
          {"n", record.value.n},
          {"paper", record.paper ? Json(*record.paper) : Json(nullptr)},
          {"valid", record.valid && isFinite(record.value)},
          {"note", record.note},
          {"config", record.config},
          {"timer", record.timer}};
}

double numberOrNan(const Json& json) {
  return json.is_null() ? std::nan("") : json.get<double>();
}

Record recordFromJson(const Json& json) {
  Record record;
  json.at("table").get_to(record.table);
  json.at("case").get_to(record.case_);
  json.at("metric").get_to(record.metric);
  json.at("unit").get_to(record.unit);
  record.value.median = numberOrNan(json.at("median"));
  record.value.min = numberOrNan(json.at("min"));
  record.value.p95 = numberOrNan(json.at("p95"));
  record.value.stddev = numberOrNan(json.at("stddev"));
  record.value.n = wholeNumber<std::size_t>(json, "n");
  if (!json.at("paper").is_null()) record.paper = json.at("paper").get<double>();
  json.at("valid").get_to(record.valid);
  json.at("note").get_to(record.note);
  json.at("config").get_to(record.config);
  if (json.contains("timer")) json.at("timer").get_to(record.timer);
  return record;
}

Json parse(const std::string& text, const std::string& source) {
  checkJsonDepth(text, source);
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw Error(fmt::format("{} is not valid JSON or was cut off (byte {})", source, error.byte));
  } catch (const Json::out_of_range&) {
    throw Error(fmt::format("{} holds a number that is too large", source));
  }
}

void requireSchema(const Json& json, const std::string& source) {
  const bool named = json.is_object() && json.contains("schema") && json["schema"].is_string();
  if (!named) throw Error(fmt::format("{} names no results schema", source));
  const std::string schema = json["schema"];
  if (schema != kResultsSchema) {
    throw Error(fmt::format("{} has schema '{}', but this program reads '{}'", source, schema,
                            kResultsSchema));
  }
}

// Runs `read`, turning missing fields and wrong types into an Error.
template <typename Read>
auto readFields(const std::string& source, Read read) {
  try {
    return read();
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", source, error.what()));
  } catch (const Json::exception& error) {
    throw Error(
        fmt::format("{} lacks a field or has one of the wrong type ({})", source, error.what()));
  }
}

// Text in the file may come from user paths that are not UTF-8; bad bytes are replaced.
std::string dump(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

// Keys in order, numbers as doubles: however a tool spells what the file holds, it stays the same.
nlohmann::json canonical(const Json& json) {
  if (json.is_number()) return json.get<double>();
  if (!json.is_structured()) return json;
  nlohmann::json out = json.is_array() ? nlohmann::json::array() : nlohmann::json::object();
  for (const auto& [key, value] : json.items())
    if (json.is_array())
      out.push_back(canonical(value));
    else
      out[key] = canonical(value);
  return out;
}

constexpr const char* kSumKey = "sum";

// Of all of a file but its sum.
std::string sumOf(Json file) {
  file.erase(kSumKey);
  return fmt::format("{:016x}",
                     fnv1a(canonical(file).dump(-1, ' ', false, Json::error_handler_t::replace)));
}

void requireSum(const Json& file, const std::string& source) {
  if (file.contains(kSumKey) && file[kSumKey] != sumOf(file))
    throw Error(
        fmt::format("{} is damaged or was edited: its checksum is another's; take the file as it "
                    "was written, or take \"{}\" out of one that was edited on purpose",
                    source, kSumKey));
}

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

std::string toJson(const Results& results) {
  Json records = Json::array();
  for (const Record& record : results.records) records.push_back(recordToJson(record));
  Json file = {{"schema", kResultsSchema}, {"run", runToJson(results.run)}, {"records", records}};
  file[kSumKey] = sumOf(file);
  return dump(file, 1) + "\n";
}

Results fromJson(const std::string& text, const std::string& source) {
  const Json json = parse(text, source);
  requireSchema(json, source);
  requireSum(json, source);
  return readFields(source, [&] {
    Results results;
    results.run = runFromJson(json.at("run"));
    for (const Json& record : json.at("records")) {
      results.records.push_back(recordFromJson(record));
    }
    return results;
  });
}

std::string headerLine(const RunInfo& run) {
  return dump({{"schema", kResultsSchema}, {"run", runToJson(run)}}, -1);
}

std::string recordLine(const Record& record, std::optional<std::size_t> more) {
  Json json = recordToJson(record);
  if (more) json["more"] = *more;
  return dump(json, -1);
}

RunInfo parseHeaderLine(const std::string& line, const std::string& source) {
  const Json json = parse(line, source);
  requireSchema(json, source);
  return readFields(source, [&] { return runFromJson(json.at("run")); });
}

LogLine parseRecordLine(const std::string& line, const std::string& source) {
  const Json json = parse(line, source);
  return readFields(source, [&] {
    return LogLine{recordFromJson(json),
                   json.contains("more") ? wholeNumber<std::size_t>(json, "more") : 0};
  });
}

std::string toCsv(const std::vector<Record>& records) {
  std::set<std::string> keys;
  for (const Record& record : records)
    for (const auto& [key, value] : record.config) keys.insert(key);
  std::string csv = "table,case,metric,unit,median,min,p95,stddev,n,paper,valid,note,timer";
  for (const std::string& key : keys) csv += fmt::format(",{}", csvField("config." + key));
  csv += "\n";
  for (const Record& record : records) {
    const Summary& v = record.value;
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", csvField(record.table),
                       csvField(record.case_), csvField(record.metric), csvField(record.unit),
                       v.median, v.min, v.p95, v.stddev, v.n,
                       record.paper ? fmt::format("{}", *record.paper) : "", record.valid,
                       csvField(record.note), csvField(record.timer));
    for (const std::string& key : keys) {
      const auto found = record.config.find(key);
      csv += ',';
      if (found != record.config.end()) csv += csvField(found->second);
    }
    csv += "\n";
  }
  return csv;
}

Results readResults(const std::filesystem::path& path) {
  return fromJson(readFile(path), path.string());
}

}  // namespace glintmark
