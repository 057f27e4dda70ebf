#include "host/report/record/trace_file.h"

#include <nlohmann/json.hpp>
#include <set>

#include "host/core/atomic_file.h"
#include "host/core/trace.h"

namespace glintmark {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kHostProcess = 1, kDeviceProcess = 2, kQueue = 1;

double microseconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-3;
}

Json metadata(const char* what, int process, int thread, const std::string& name) {
  return {
      {"ph", "M"}, {"name", what}, {"pid", process}, {"tid", thread}, {"args", {{"name", name}}}};
}

Json complete(const std::string& category, const std::string& name, int process, int thread,
              std::int64_t begin_ns, std::int64_t end_ns) {
  return {{"ph", "X"},
          {"cat", category},
          {"name", name},
          {"pid", process},
          {"tid", thread},
          {"ts", microseconds(begin_ns)},
          {"dur", microseconds(end_ns - begin_ns)}};
}

}  // namespace

std::string traceJson(const RunInfo& run) {
  Json events = Json::array();
  events.push_back(metadata("process_name", kHostProcess, 0, "host: " + run.cpu));
  events.push_back(metadata("process_name", kDeviceProcess, 0, "device: " + run.device));
  events.push_back(metadata("thread_name", kDeviceProcess, kQueue, "queue"));
  std::set<int> threads;
  for (const HostInterval& i : hostIntervals()) {
    if (threads.insert(i.thread).second)
      events.push_back(
          metadata("thread_name", kHostProcess, i.thread, "thread " + std::to_string(i.thread)));
    events.push_back(complete(i.category, i.name, kHostProcess, i.thread, i.begin_ns, i.end_ns));
  }
  for (const DeviceInterval& i : deviceIntervals()) {
    Json event = complete(i.category, i.name, kDeviceProcess, kQueue, i.begin_ns, i.end_ns);
    event["args"] = {{"queued_us", microseconds(i.queued_ns)}};
    if (!i.fits) event["args"]["note"] = "the device's clock contradicts the host's";
    events.push_back(std::move(event));
  }
  const Json trace = {{"displayTimeUnit", "ms"},
                      {"otherData",
                       {{"date", run.date},
                        {"git", run.git},
                        {"command", run.command},
                        {"device", run.device},
                        {"driver", run.driver},
                        {"platform", run.platform},
                        {"width", run.width}}},
                      {"traceEvents", std::move(events)}};
  return trace.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void writeTrace(const std::filesystem::path& file, const RunInfo& run) {
  stopTrace();
  writeFile(file, traceJson(run));
}

}  // namespace glintmark
