// Polygons as seen from a point: what a diffuse, a linearly transformed and a microfacet surface
// reflect of them, in double precision.
//
// Vertices are positions relative to the point, in the tangent frame (z: normal); only their
// directions matter. Polygons are simple and planar; integrals are positive where the vertices turn
// right-handed about the direction towards them, negative where they turn the other way, and cover
// the part above the horizon.
// [Oosterom1983] Van Oosterom, Strackee, "The Solid Angle of a Plane Triangle". [Lambert1760] as in
// Baum, Rushmeier, Winget, "Improving Radiosity Solutions Through the Use of Analytically
// Determined Form-Factors", SIGGRAPH 1989, Eq. 11.
#pragma once
#include <glm/glm.hpp>

#include <span>
#include <vector>

#include "host/reference/microfacet.h"

namespace glintmark::reference {

/// The part of a polygon on the side of the plane through the origin to which `normal` points.
std::vector<glm::dvec3> clipPolygon(std::span<const glm::dvec3> vertices, const glm::dvec3& normal);

/// Solid angle of the polygon, whether above the horizon or not; for fewer than a hemisphere.
double polygonSolidAngle(std::span<const glm::dvec3> vertices);

/// Integral of cosine / pi: what a white diffuse surface reflects of unit radiance, in [-1, 1].
double polygonFormFactor(std::span<const glm::dvec3> vertices);

/// Integral of a linearly transformed cosine, in [-1, 1]. [HDHN16] Sect. 3
double ltcOverPolygon(const glm::dmat3& inverse, std::span<const glm::dvec3> vertices);

/// What the microfacet surface reflects towards `view` of unit radiance: the integral of BRDF times
/// cosine, times Schlick's Fresnel term of reflectance f0 (1: none). By cubature over triangles
/// that are small in the space of the cosine lobe; `inverse` is any matrix that makes the BRDF's
/// lobe roughly a cosine, such as a fitted one. Good to about 1e-5, at grazing views of lobes
/// narrower than 0.03 to 1e-4.
double microfacetOverPolygon(Ndf ndf, const glm::dvec3& view, double alpha, double f0,
                             const glm::dmat3& inverse, std::span<const glm::dvec3> vertices);

}  // namespace glintmark::reference
