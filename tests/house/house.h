// Rules of the house: what may include what, and what a folder says of itself.
#pragma once
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace glintmark::house {

/// Text of each file by its path from the project's root.
using Files = std::map<std::string, std::string>;

/// host/order.txt.
struct Order {
  std::vector<std::vector<std::string>> floors;  // folders of host from the bottom up
  std::vector<std::pair<std::string, std::vector<std::string>>> only;  // start of an include, homes
  std::set<std::string> generated;

  /// Number of the floor of a folder of host; -1 if it has none.
  int floorOf(const std::string& folder) const;
};

/// Throws std::runtime_error naming a line that is not understood.
Order parseOrder(const std::string& text);

/// "path:line: what is wrong" of every include that the order does not allow, or of a file that is
/// not there. Sources are those of host, kernels, bench, tests and fuzz.
std::vector<std::string> includeFaults(const Files& files, const Order& order);

/// Circles of includes that leave a folder: of modules, which are a header with the source of its
/// name, and of folders but for a folder with what it holds. The shortest of each knot, as "a -> b
/// -> a".
std::vector<std::string> circles(const Files& files);

/// What is wrong with the README.md of host's folders and of those of kernels/: one that is
/// missing, longer than ten lines, has not the folder's name as its title, or names what is not
/// there. In host's, "May include" has to name every folder that is included, and none that may not
/// be, and "After a change" only programs of `programs`.
std::vector<std::string> readmeFaults(const Files& files, const Order& order,
                                      const std::set<std::string>& programs);

/// Names that glintmark_test() and glintmark_bench() define in the project's CMakeLists.txt files.
std::set<std::string> definedPrograms(const Files& files);

/// What stands in unnamed namespaces of two sources of one folder under one name: such sources
/// cannot be compiled together. Functions may differ in their parameters. Programs of one source,
/// as those of bench, are left out. Read line by line, as clang-format leaves them.
std::vector<std::string> sharedUnnamed(const Files& files);

// --- Shared by the rules ------------------------------------------------------------------------

struct Include {
  std::string name;    // as written
  int line = 0;        // from 1
  bool quoted = true;  // else in angle brackets
};
std::vector<Include> includesOf(const std::string& text);

bool isSource(const std::string& path);
/// Path of the project's file that is meant; empty if it is none.
std::string resolve(const std::string& from, const Include& include, const Files& files);
/// "host/report/record" of "host/report/record/record.h"
std::string folderOf(const std::string& path);
/// Component `index` of a path, empty if it has fewer.
std::string partOf(const std::string& path, int index);

}  // namespace glintmark::house
