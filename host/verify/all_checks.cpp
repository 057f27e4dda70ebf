#include <iterator>

#include "host/verify/check_groups.h"

namespace glintmark {

std::vector<Check> allChecks() {
  std::vector<Check> all;
  for (const auto group :
       {deviceChecks,       mathsChecks,       trigChecks,        seedChecks,
        binomialChecks,     pixelChecks,       glintChecks,       cellChecks,
        colourChecks,       shadingChecks,     couplingChecks,    curvatureChecks,
        energyChecks,       zoomChecks,        rivalChecks,       coneChecks,
        drawnLightChecks,   mappedConeChecks,  hardPixelChecks,   polygonChecks,
        areaLightChecks,    anisotropicChecks, areaShapeChecks,   shapeTruthChecks,
        areaMixtureChecks,  areaGlintChecks,   ggxChecks,         areaColourChecks,
        pictureChecks,      textureChecks,     lobeChecks,        convolutionChecks,
        normalMethodChecks, leadrChecks,       mixtureChecks,     scatterChecks,
        frameChecks,        truthChecks,       microdetailChecks, heightFieldChecks,
        smithWalkChecks,    facetChecks}) {
    std::vector<Check> checks = group();
    std::move(checks.begin(), checks.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace glintmark
