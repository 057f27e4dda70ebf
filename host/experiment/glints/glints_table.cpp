#include "host/experiment/glints/glints_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

constexpr double kAspects[] = {1, 4, 16};
constexpr double kLambdas[] = {0.5, 10, 1000};
constexpr double kLambdaOfMoreLights = 10;
constexpr int kMoreLights = 3;

// Of one case: as fast as it can, since what disturbs a machine only adds.
std::optional<double> leastOf(std::span<const Record> records, const std::string& case_name,
                              std::string_view metric) {
  const Record* record = CaseRecords(records, case_name).find(metric);
  if (record == nullptr || !record->valid) return {};
  return record->value.min;
}

std::string kindOf(const std::string& case_name) {
  const CaseName name = CaseName::parse(case_name);
  const std::string lights = name.value("lights").value_or("?");
  return fmt::format("1:{} n={}{}", name.value("aspect").value_or("?"),
                     name.value("lambda").value_or("?"), lights == "1" ? "" : " x" + lights);
}

std::string methodOf(const std::string& case_name) {
  return CaseName::parse(case_name).word(0);
}

// Values of a metric over all kinds that pass, of one method.
std::vector<double> valuesOf(std::span<const Record> records, const std::string& method,
                             std::string_view metric,
                             const std::function<bool(const CaseName&)>& passes) {
  std::vector<double> values;
  for (const std::string& case_name : caseNames(records))
    if (methodOf(case_name) == method && passes(CaseName::parse(case_name)))
      if (const auto value = leastOf(records, case_name, metric)) values.push_back(*value);
  return values;
}

bool isOneLight(const CaseName& name) {
  return name.value("lights") == "1";
}

// "1.2 to 3.4"; "-" where there is nothing.
std::string rangeText(const std::vector<double>& values) {
  if (values.empty()) return "-";
  const auto [least, most] = std::ranges::minmax(values);
  return fmt::format("{} to {}", compactNumber(least), compactNumber(most));
}

// First over second, kind by kind.
std::vector<double> quotients(std::span<const Record> records, const std::string& first,
                              const std::string& second, std::string_view metric) {
  const std::vector<double> a = valuesOf(records, first, metric, isOneLight),
                            b = valuesOf(records, second, metric, isOneLight);
  std::vector<double> values;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) values.push_back(a[i] / b[i]);
  return values;
}

// Greatest over least.
std::string spreadText(std::span<const Record> records, const std::string& method) {
  const std::vector<double> values = valuesOf(records, method, "ns_per_px", isOneLight);
  if (values.empty()) return "-";
  const auto [least, most] = std::ranges::minmax(values);
  return fmt::format("{} (zk16: {})", compactNumber(most / least), [&] {
    const std::vector<double> peers = valuesOf(records, "zk16", "ns_per_px", isOneLight);
    if (peers.empty()) return std::string("-");
    const auto [low, high] = std::ranges::minmax(peers);
    return compactNumber(high / low);
  }());
}

}  // namespace

const TableSpec& glintsSpec() {
  static const TableSpec spec = {
      .name = "glints",
      .title = "Methods of glints",
      .about =
          "Every glint method over footprints of several lengths, numbers of microdetails and "
          "lights: what a pixel costs, and how far its glints are from placed microdetails.",
      .source = "",
      .citation = "",
      .metrics =
          {{"ns_per_px",
            "ns",
            "time per pixel",
            "frames with glints minus the fastest without, kernel events in turn, over the pixels; "
            "all cores together; tables name the least",
            "`METHOD/aspect=…/lambda=…/lights=…`",
            {"ns_per_visited", "visited_mean", "error"}},
           {"visited_mean", "1", "visited",
            "cells, draws or particles that a pixel visits under all lights, whatever the method "
            "counts by"},
           {"ns_per_visited", "ns", "time per visited", "`ns_per_px` over `visited_mean`"},
           {"limited_share", "1", "cut short",
            "share of pixels whose footprint some limit of the method cuts"},
           {"kernel_instructions", "instructions", "instructions of the kernel",
            "machine code of the compiled kernel where the device gives it, for `width` pixels"},
           {"vector_512", "instructions", "512-bit instructions"},
           {"error", "1", "W1",
            "Wasserstein distance of the pixels' ratios to the smooth lobe to those of placed "
            "microdetails, as in table `accuracy`, of smaller samples; of one light"},
           {"variance_ratio", "1", "variance", "over that of placed microdetails"},
           {"bias", "1", "mean - 1", "of the ratios to the smooth lobe"},
           {"error_over_best", "1", "error at equal time",
            "`error` over the least of all methods that take at most 1.05 times the time; 1 where "
            "none is better"}},
      .cost_ratios = {},
      .headline = Headline{"error_over_best", "error over the best method's in the same time"},
      .score = "ns_per_px"};
  return spec;
}

std::vector<GlintsKind> glintsKinds() {
  std::vector<GlintsKind> kinds;
  for (const double aspect : kAspects) {
    for (const double lambda : kLambdas) kinds.push_back({{aspect, lambda}, 1});
    kinds.push_back({{aspect, kLambdaOfMoreLights}, kMoreLights});
  }
  return kinds;
}

std::string glintsCase(const std::string& method, const GlintsKind& kind) {
  CaseName name{{method}};
  name.knobs.emplace_back("aspect", kind.stage.aspect);
  name.knobs.emplace_back("lambda", kind.stage.lambda);
  name.knobs.emplace_back("lights", kind.lights);
  return name.text();
}

std::string glintsTableText(std::span<const Record> records) {
  TextTable table({"pixels", "method", "ns/px", "visited", "ns/each", "cut", "instr.", "W1",
                   "variance", "mean-1", "/best"});
  std::vector<std::string> kinds;
  for (const std::string& case_name : caseNames(records))
    if (std::ranges::find(kinds, kindOf(case_name)) == kinds.end())
      kinds.push_back(kindOf(case_name));
  for (const std::string& kind : kinds) {
    if (kind != kinds.front()) table.addRule();
    std::string shown = kind;  // on the first line
    for (const std::string& case_name : caseNames(records)) {
      if (kindOf(case_name) != kind) continue;
      const CaseRecords one(records, case_name);
      const auto least = [&](std::string_view metric) {
        const Record* record = one.find(metric);
        return record == nullptr ? std::string("-")
                                 : compactNumber(record->value.min) + (record->valid ? "" : "!");
      };
      table.addRow({std::exchange(shown, ""), methodOf(case_name), least("ns_per_px"),
                    one.text("visited_mean"), least("ns_per_visited"), one.text("limited_share"),
                    one.count("kernel_instructions"), one.text("error"), one.text("variance_ratio"),
                    one.text("bias"), one.text("error_over_best")});
    }
  }
  return table.toString() +
         "\n1:a: sides of a footprint; n: microdetails that reflect in it; x3: of each of 3 "
         "lights.\n"
         "ns: least of all repetitions. visited: cells, draws (deliot) or particles (kemppinen). "
         "W1,\n"
         "variance (over the truth's), mean: against placed microdetails, where one light is. "
         "/best:\n"
         "W1 over the least of methods that are as fast.\n";
}

std::string glintsClaimsText(std::span<const Record> records) {
  TextTable table({"claim", "of", "here"});
  const auto over = [&](const char* peer) {
    return rangeText(quotients(records, peer, "deliot_belcour", "ns_per_px"));
  };
  const auto range = [&](const char* method, const char* metric, double lambda) {
    return rangeText(valuesOf(records, method, metric, [lambda](const CaseName& name) {
      return isOneLight(name) && (lambda == 0 || name.number("lambda") == lambda);
    }));
  };
  table.addRow({"1.5 to 5 times faster than the state of the art", "[DB23]",
                over("published_zk16") + " published_zk16"});
  table.addRow({"", "", over("zk16") + " zk16"});
  table.addRow({"", "", over("distributed") + " distributed"});
  table.addRow({"stable performance: slowest over fastest", "[DB23]",
                spreadText(records, "deliot_belcour")});
  table.addRow({"the correct statistics: variance over the truth's", "[DB23]",
                range("deliot_belcour", "variance_ratio", 0)});
  table.addRow({"", "corrected", range("deliot_corrected", "variance_ratio", 0)});
  table.addRow(
      {"constant time: slowest over fastest", "[KPT25]", spreadText(records, "kemppinen")});
  table.addRow({"converges to the lobe as pixels hold more: W1 at n=0.5", "[KPT25]",
                range("kemppinen", "error", 0.5)});
  table.addRow({"and at n=1000", "[KPT25]", range("kemppinen", "error", 1000)});
  table.addRow(
      {"normalised distributions of slopes: mean - 1", "[CSDD20]", range("chermain", "bias", 0)});
  table.addRow({"", "corrected", range("chermain_corrected", "bias", 0)});
  table.addRow({"converges to the lobe as pixels hold more: W1 at n=0.5", "[CSDD20]",
                range("chermain", "error", 0.5)});
  table.addRow({"and at n=1000", "[CSDD20]", range("chermain", "error", 1000)});
  table.addRow({"8 to 64 cells a pixel", "[ZK16]", range("zk16", "visited_mean", 0) + " zk16"});
  table.addRow({"", "", range("published_zk16", "visited_mean", 0) + " published_zk16"});
  return "What the literature claims, and here, under one light\n" + table.toString();
}

}  // namespace glintmark
