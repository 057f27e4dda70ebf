// The checks of each group; allChecks() puts them together.
#pragma once
#include <vector>

#include "host/verify/check.h"

namespace glintmark {

std::vector<Check> deviceChecks();       // shared structs, arithmetic
std::vector<Check> mathsChecks();        // elementary functions of wide_math.clh
std::vector<Check> seedChecks();         // hash.clh
std::vector<Check> binomialChecks();     // binomial.clh
std::vector<Check> glintChecks();        // cells and draws of whole pixels
std::vector<Check> energyChecks();       // glints on average
std::vector<Check> zoomChecks();         // glints near, far, and continuous
std::vector<Check> coneChecks();         // lights of any width
std::vector<Check> hardPixelChecks();    // footprints, materials and lights at their limits
std::vector<Check> polygonChecks();      // area lights over a cosine
std::vector<Check> areaLightChecks();    // area lights over transformed cosines
std::vector<Check> areaGlintChecks();    // glints under area lights
std::vector<Check> ggxChecks();          // GGX lobes and their glints
std::vector<Check> textureChecks();      // fetches along footprints
std::vector<Check> lobeChecks();         // Gaussians of normals
std::vector<Check> scatterChecks();      // multiple scattering
std::vector<Check> frameChecks();        // whole frames: mapped normals, one pixel, nothing at all
std::vector<Check> heightFieldChecks();  // the ray caster

}  // namespace glintmark
