// The numbers of a PLY file after its header, one by one.
#pragma once
#include <string>
#include <string_view>

#include "host/scene/import/ply_header.h"

namespace glintmark {

class PlyNumbers {
 public:
  /// `text` is what follows the header and must live as long.
  PlyNumbers(std::string_view text, PlyFormat format, const std::string& source)
      : rest_(text), format_(format), source_(&source) {}

  /// The next number, of that type. Throws Error at the end of the file and for a word that is no
  /// number.
  double next(PlyType type);
  /// The next number of elements of a list. Throws Error also if the file is too short for them.
  std::size_t nextCount(const PlyProperty& list);
  /// Leaves what an element's line holds beyond its numbers, in texts.
  void endElement();

 private:
  double nextWord();
  double nextBinary(PlyType type);

  std::string_view rest_;
  PlyFormat format_;
  const std::string* source_;
};

}  // namespace glintmark
