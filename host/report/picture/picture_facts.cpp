#include "host/report/picture/picture_facts.h"

#include <fmt/format.h>

namespace glintmark {

PictureFacts factsOf(const RunInfo& run) {
  return {{"glintmark:version", run.git},
          {"glintmark:command", run.command},
          {"glintmark:device", fmt::format("{} ({}, {} lanes)", run.device, run.driver, run.width)},
          {"glintmark:inputs", run.inputs}};
}

}  // namespace glintmark
