// What the fuzzers call, and the test that replays the corpus. Each entry reads `bytes` as a file
// of its kind would be read. An Error is a good answer; anything else that is thrown, a crash, or a
// broken promise (abort) is a finding.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace glintmark::fuzz {

/// A scene file, with its normal maps kept small; the mesh is planned, not built. Lines that start
/// with "--set " at the top are overrides.
void readScene(std::string_view bytes);
/// A mesh file. The first line is its extension: obj, ply, gltf or glb.
void readMesh(std::string_view bytes);
/// results.json, then the page of it and its comparison with itself.
void readResultsFile(std::string_view bytes);
/// records.jsonl, whole and cut off.
void readLog(std::string_view bytes);
/// The binary files: mixtures, tables of cosines, checkpoints of simulations. The first byte says
/// which.
void readTables(std::string_view bytes);

struct Entry {
  std::string name;  // also the folder of its corpus
  void (*run)(std::string_view bytes);
};
const std::vector<Entry>& entries();

}  // namespace glintmark::fuzz
