// What parameters of tests are called in the list of tests, where their bytes would say nothing.
#pragma once
#include <ostream>

#include "host/ocl/switches.h"
#include "host/reference/microfacet.h"

namespace glintmark {

inline void PrintTo(GlintMethod method, std::ostream* out) {
  *out << choiceName(method);
}

inline void PrintTo(NormalMethod method, std::ostream* out) {
  *out << choiceName(method);
}

namespace reference {

inline void PrintTo(Ndf ndf, std::ostream* out) {
  *out << ndfName(ndf);
}

}  // namespace reference
}  // namespace glintmark
