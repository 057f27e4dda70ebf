#include "fuzz/entries.h"

#include <toml++/toml.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "host/core/error.h"
#include "host/experiment/all_tables.h"
#include "host/fit/anisotropic_table.h"
#include "host/fit/ltc_table.h"
#include "host/mixture/mixture_cache.h"
#include "host/mixture/mixture_file.h"
#include "host/report/page/html_report.h"
#include "host/report/record/comparison.h"
#include "host/report/record/record_log.h"
#include "host/report/record/records.h"
#include "host/scene/import_mesh.h"
#include "host/scene/read_scene_parts.h"
#include "host/simulate/simulation_file.h"

namespace glintmark::fuzz {
namespace {

// Larger maps are allowed and only take time.
constexpr std::int64_t kMostMapSize_px = 32;

void require(bool holds) {
  if (!holds) std::abort();
}

// Bounds every size_px below `node`.
void limitMapSizes(toml::node& node) {
  if (toml::array* array = node.as_array()) {
    for (toml::node& element : *array) limitMapSizes(element);
  } else if (toml::table* table = node.as_table()) {
    for (auto&& [key, value] : *table) {
      if (toml::value<std::int64_t>* number = value.as_integer(); number && key == "size_px")
        number->get() = std::min(number->get(), kMostMapSize_px);
      limitMapSizes(value);
    }
  }
}

// Up to and without the line's end, which is taken off `bytes` too.
std::string_view takeLine(std::string_view& bytes) {
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  const std::string_view line = bytes.substr(0, end);
  bytes.remove_prefix(std::min(end + 1, bytes.size()));
  return line;
}

// A file in memory where the system has such a folder; one for each process.
std::filesystem::path scratchFile(std::string_view extension) {
  const std::filesystem::path memory = "/dev/shm";
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::is_directory(memory, error)
                                           ? memory
                                           : std::filesystem::temp_directory_path();
  return folder / ("glintmark_fuzz_" + std::to_string(getpid()) + "." + std::string(extension));
}

void checkPage(const Results& results) {
  const std::string page = htmlReport(results, allTableSpecs(), {}, "results.json");
  std::size_t scripts = 0;
  for (std::size_t at = 0; (at = page.find("</script", at)) != std::string::npos; ++at) ++scripts;
  require(scripts == kPageScripts);
}

}  // namespace

void readScene(std::string_view bytes) {
  constexpr std::string_view kOverride = "--set ";
  SceneRequest request;
  while (bytes.starts_with(kOverride))
    request.overrides.emplace_back(takeLine(bytes).substr(kOverride.size()));
  try {
    toml::table content = parseSceneText(bytes, "scene.toml");
    for (const std::string& text : request.overrides)
      if (text.find("size_px") != std::string::npos) return;
    limitMapSizes(content);
    const PlannedScene planned = planScene(content, "scene.toml", request);
    require(!planned.scene.materials.empty() && !planned.scene.views.empty());
    require(planned.plan.build != nullptr);
    for (const MapPlan& map : planned.maps) checkNormalMap(map.build());
  } catch (const Error&) {
  }
}

void readMesh(std::string_view bytes) {
  const std::string_view extension = takeLine(bytes);
  if (extension != "obj" && extension != "ply" && extension != "stl" && extension != "gltf" &&
      extension != "glb")
    return;
  const std::filesystem::path file = scratchFile(extension);
  std::ofstream(file, std::ios::binary) << bytes;
  try {
    const PartMesh built = importMesh(file);
    for (const glm::uvec3& t : built.mesh.triangles)
      for (int k = 0; k < 3; ++k) require(t[k] < built.mesh.positions.size());
    for (const std::uint32_t part : built.mesh.triangle_materials)
      require(part < built.parts.size());
  } catch (const Error&) {
  }
  std::filesystem::remove(file);
}

void readResultsFile(std::string_view bytes) {
  try {
    const Results results = fromJson(std::string(bytes), "results.json");
    // What was read can be written and read again.
    require(fromJson(toJson(results), "copy").records.size() == results.records.size());
    toCsv(results.records);
    comparisonText(compareResults(results, results, allTableSpecs(), 0.05), true);
    checkPage(results);
  } catch (const Error&) {
  }
}

void readLog(std::string_view bytes) {
  const std::string text(bytes);
  try {
    const LogContent content = parseLog(text, "records.jsonl");
    require(content.whole_bytes <= text.size());
    const LogContent again = parseLog(text.substr(0, content.whole_bytes), "records.jsonl");
    require(again.whole_bytes == content.whole_bytes);
    require(again.records.size() == content.records.size());
  } catch (const Error&) {
  }
}

void readTables(std::string_view bytes) {
  if (bytes.empty()) return;
  const char kind = bytes.front();
  bytes.remove_prefix(1);
  try {
    if (kind == 'm') {
      const auto mixtures = mixturesFromBytes(bytes);
      if (mixtures) require(mixtureBytes(*mixtures) == bytes);
    } else if (kind == 'l') {
      require(serializeLtcTable(parseLtcTable(bytes, "table")) == bytes);
    } else if (kind == 'a') {
      require(serializeAnisotropicTable(parseAnisotropicTable(bytes, "table")) == bytes);
    } else if (kind == 'f') {
      require(serializeMixtures(parseMixtures(bytes, "mixtures")) == bytes);
    } else if (kind == 's') {
      unpackSimulation(std::string(bytes), SimulationSettings{}, "checkpoint");
    }
  } catch (const Error&) {
  }
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = {{"scene", readScene},
                                         {"mesh", readMesh},
                                         {"results", readResultsFile},
                                         {"log", readLog},
                                         {"tables", readTables}};
  return all;
}

}  // namespace glintmark::fuzz
