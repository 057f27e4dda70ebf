// The checks of each group; allChecks() puts them together.
#pragma once
#include <vector>

#include "host/verify/check.h"

namespace glintmark {

std::vector<Check> deviceChecks();        // shared structs, arithmetic
std::vector<Check> mathsChecks();         // elementary functions of wide_math.clh
std::vector<Check> trigChecks();          // sine, cosine and angle
std::vector<Check> seedChecks();          // hash.clh
std::vector<Check> binomialChecks();      // binomial.clh
std::vector<Check> pixelChecks();         // frames and views of pixels
std::vector<Check> glintChecks();         // draws of whole pixels
std::vector<Check> cellChecks();          // their cells
std::vector<Check> colourChecks();        // colours of draws
std::vector<Check> couplingChecks();      // a diffuse layer under a specular lobe
std::vector<Check> shadingChecks();       // smooth pixels of coloured materials
std::vector<Check> curvatureChecks();     // lobes of curved meshes
std::vector<Check> energyChecks();        // glints on average
std::vector<Check> zoomChecks();          // glints near, far, and continuous
std::vector<Check> rivalChecks();         // other authors' glints
std::vector<Check> coneChecks();          // lights of any width
std::vector<Check> drawnLightChecks();    // glints under many of them
std::vector<Check> mappedConeChecks();    // spread normals under them
std::vector<Check> hardPixelChecks();     // footprints, materials and lights at their limits
std::vector<Check> polygonChecks();       // area lights over a cosine
std::vector<Check> areaLightChecks();     // area lights over transformed cosines
std::vector<Check> anisotropicChecks();   // area lights over anisotropic surfaces
std::vector<Check> areaShapeChecks();     // discs, spheres and tubes
std::vector<Check> shapeTruthChecks();    // their ground truths
std::vector<Check> areaMixtureChecks();   // area lights over mixtures of normals
std::vector<Check> areaGlintChecks();     // glints under area lights
std::vector<Check> ggxChecks();           // GGX lobes and their glints
std::vector<Check> areaColourChecks();    // their Fresnel terms, channels, mean normals
std::vector<Check> pictureChecks();       // pictures on them
std::vector<Check> textureChecks();       // fetches along footprints
std::vector<Check> lobeChecks();          // Gaussians of normals
std::vector<Check> convolutionChecks();   // against means over normals and pixels
std::vector<Check> normalMethodChecks();  // every method of mapped normals
std::vector<Check> leadrChecks();         // facets of a displaced surface
std::vector<Check> mixtureChecks();       // their fit
std::vector<Check> scatterChecks();       // multiple scattering
std::vector<Check> frameChecks();         // whole frames: mapped normals, one pixel, nothing at all
std::vector<Check> truthChecks();         // ground truths
std::vector<Check> microdetailChecks();   // that of glints
std::vector<Check> heightFieldChecks();   // the ray caster
std::vector<Check> smithWalkChecks();     // rays among facets of Smith's theory
std::vector<Check> facetChecks();         // what single facets do to its rays

}  // namespace glintmark
