// Microfacet BRDFs in double precision: GGX and Beckmann with height-correlated Smith masking and
// shadowing, G2 = 1 / (1 + Lambda(i) + Lambda(o)). [Heitz14] Eq. 99
//
// Directions are unit vectors in the tangent frame (z: normal). A roughness is a number, or one
// each along x and y of that frame. The fit of linearly transformed cosines and the Monte Carlo
// ground truth use this same BRDF. [Walter07] "Microfacet Models for Refraction through Rough
// Surfaces", EGSR 2007. [Heitz14] "Understanding the Masking-Shadowing Function in Microfacet-Based
// BRDFs", JCGT 3(2).
#pragma once
#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace glintmark::reference {

/// kNormals is no microsurface but a normal map in the limit of mirrors: Beckmann's slopes, of
/// which none hides another and each counts alike whichever way it faces. It reflects D(m) m.z / (4
/// o.m) in all directions, below its horizon too, and its albedo is the share that faces the view.
enum class Ndf { kGgx, kBeckmann, kNormals };

/// "ggx", "beckmann" or "normals".
std::string ndfName(Ndf ndf);

/// D(m), normalised such that the integral of D(m) m.z over directions is 1; 0 below the horizon.
/// alpha > 0. [Walter07] Eq. 25 and 33
double microfacetDensity(Ndf ndf, const glm::dvec3& m, const glm::dvec2& alpha);
double microfacetDensity(Ndf ndf, const glm::dvec3& m, double alpha);

/// How Smith's Lambda of a Beckmann surface is had: exactly, or by the rational fit that the
/// kernels use, good to 0.35 % of G1. [Walter07] Sect. 5.2
enum class SmithForm { kExact, kRational };

/// Lambda(w) w.z for w.z >= 0, which stays finite at the horizon.
double lambdaTimesCosine(Ndf ndf, const glm::dvec3& w, const glm::dvec2& alpha,
                         SmithForm form = SmithForm::kExact);
double lambdaTimesCosine(Ndf ndf, const glm::dvec3& w, double alpha,
                         SmithForm form = SmithForm::kExact);

/// Smith's Lambda of a direction w with w.z > 0. [Heitz14] Eq. 72 (GGX) and 61 (Beckmann)
double microfacetLambda(Ndf ndf, const glm::dvec3& w, double alpha);

/// BRDF times i.z at a Fresnel term of 1: D(m) G2(i, o) / (4 o.z); 0 where i or o is not above the
/// surface (of kNormals, o only). Its limit for a grazing view, o.z = 0, is finite and is what this
/// returns there.
double microfacetTimesCosine(Ndf ndf, const glm::dvec3& i, const glm::dvec3& o,
                             const glm::dvec2& alpha, SmithForm form = SmithForm::kExact);
double microfacetTimesCosine(Ndf ndf, const glm::dvec3& i, const glm::dvec3& o, double alpha,
                             SmithForm form = SmithForm::kExact);

/// Directional albedo at a Fresnel term of 1: integral of that over i for one o with o.z = mu, 0 to
/// 1, by a fixed rule over the normals' slopes, good to 3e-4 for alpha in [0.01, 1].
double microfacetAlbedo(Ndf ndf, double mu, double alpha, SmithForm form = SmithForm::kExact);

/// That integral, and the same with Schlick's (1 - o.m)^5 within.
struct AlbedoParts {
  double mirror = 0, schlick = 0;
};
AlbedoParts microfacetAlbedoParts(Ndf ndf, double mu, double alpha,
                                  SmithForm form = SmithForm::kExact);

/// A diffuse layer under an isotropic lobe: what the lobe leaves of the light, per channel. What is
/// reflected towards o.z = mu and what reaches the layer are taken to be the same share.
class CoatedDiffuse {
 public:
  /// f0 in [0, 1], `intensity` of the lobe >= 0.
  CoatedDiffuse(Ndf ndf, double alpha, const glm::dvec3& f0, double intensity);
  /// 1 - albedo of the lobe, at least 0; interpolated between 128 cosines.
  glm::dvec3 share(double mu) const;

 private:
  std::vector<glm::dvec3> shares_;  // at mu = i / (size - 1)
};

}  // namespace glintmark::reference
