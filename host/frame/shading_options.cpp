#include "host/frame/shading_options.h"

#include <fmt/format.h>

#include "host/core/error.h"

namespace glintmark {

GlintMethod parseMethod(const std::string& name) {
  if (name == "zk16") return GlintMethod::kZk16;
  if (name == "exact") return GlintMethod::kExact;
  throw Error(fmt::format("unknown method '{}'; methods are zk16 and exact", name));
}

std::string methodName(GlintMethod method) {
  return method == GlintMethod::kZk16 ? "zk16" : "exact";
}

}  // namespace glintmark
