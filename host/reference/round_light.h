// Discs, spheres and tubes as seen from a point, in double precision: as many facets, and by rays.
//
// Positions are relative to the point, in the tangent frame (z: normal). A tube is closed by a disc
// at either end. The point is outside of spheres and tubes.
#pragma once
#include <glm/glm.hpp>

#include <vector>

namespace glintmark::reference {

struct RoundLight {
  enum class Shape { kDisc, kSphere, kTube };
  Shape shape = Shape::kDisc;
  glm::dvec3 centre{0};      // of a disc or sphere; one end of a tube
  glm::dvec3 axis{0, 0, 1};  // unit normal of a disc; from a tube's end to its other end
  double radius = 1;
};

/// What is seen of it as flat polygons that hide nothing of each other: a disc, and the disc that a
/// sphere covers, as one of `sides` corners; a tube as a prism's sides and end.
std::vector<std::vector<glm::dvec3>> roundFacets(const RoundLight& light, int sides);

/// Integral of a linearly transformed cosine over what stands above the horizon, by
/// facets: with n sides it is good to 5 / n^2 of the light's size.
double ltcOverRoundLight(const glm::dmat3& inverse, const RoundLight& light, int sides);

/// The same by `side` x `side` rays, spread evenly over the cosine: to about side^-3/2.
double ltcByRays(const glm::dmat3& inverse, const RoundLight& light, int side);

/// Does a ray from the point meet it?
bool meetsRoundLight(const RoundLight& light, const glm::dvec3& direction);

/// A direction to a piece of the light, and its solid angle.
struct LightPiece {
  glm::dvec3 direction;  // unit
  double angle_sr;
};

/// `steps` x `steps` pieces of what is seen of a disc or sphere, three times as many of a tube.
std::vector<LightPiece> roundPieces(const RoundLight& light, int steps);

}  // namespace glintmark::reference
