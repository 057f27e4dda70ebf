#include <iterator>

#include "host/verify/check_groups.h"

namespace glintmark {

std::vector<Check> allChecks() {
  std::vector<Check> all;
  for (const auto group :
       {deviceChecks, mathsChecks, seedChecks, binomialChecks, glintChecks, energyChecks,
        zoomChecks, coneChecks, hardPixelChecks, polygonChecks, areaLightChecks, areaGlintChecks,
        ggxChecks, textureChecks, lobeChecks, scatterChecks, frameChecks, heightFieldChecks}) {
    std::vector<Check> checks = group();
    std::move(checks.begin(), checks.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace glintmark
