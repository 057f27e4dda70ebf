// Metals of Beckmann roughness and Schlick's Fresnel term, and what others give back to their lobe
// of the light that further bounces bring, in double precision from their texts.
//
// [Turquin 2019] "Practical multiple scattering compensation for microfacet models". [Kulla and
// Conty 2017] "Revisiting Physically Based Shading at Imageworks", SIGGRAPH courses. [Fdez-Aguera
// 2019] "A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting", JCGT 8(1).
#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "host/reference/microfacet.h"

namespace glintmark::reference {

/// kMean is ours: Turquin's scaling with the mean reflectance in place of f0.
enum class MetalWay { kSingle, kTurquin, kMean, kKullaConty, kFdezAguera };

class RoughMetal {
 public:
  /// `alpha` in (0, 1]. `energy`: what kTurquin takes for the energy of one bounce at reflectance
  /// 1, of the view's cosine; the lobe's own if empty.
  explicit RoughMetal(double alpha, std::function<double(double)> energy = {});

  /// BRDF times the light's cosine, of one channel, for unit directions above the surface.
  double brdfTimesCosine(MetalWay way, double f0, const glm::dvec3& light,
                         const glm::dvec3& view) const;
  /// Its integral over all lights: radiance under a white sky towards the cosine `mu`.
  double albedo(MetalWay way, double f0, double mu) const;

  /// Of the lobe at reflectance 1: its albedo, that of Schlick's (1 - o.m)^5, and the mean of the
  /// first over a white furnace.
  double mirror(double mu) const;
  double schlick(double mu) const;
  double meanMirror() const { return mean_; }

 private:
  // Of the lobe, and of what stands beside it: over 1 - E of the view, and of the light.
  double gain(MetalWay way, double f0, double mu) const;
  double beside(MetalWay way, double f0, double mu) const;

  double alpha_;
  std::function<double(double)> energy_;
  std::vector<AlbedoParts> parts_;  // over a warped cosine
  double mean_ = 1;
};

}  // namespace glintmark::reference
