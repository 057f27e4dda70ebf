// A scene in memory: one merged world-space mesh, materials, lights and named views.
//
// World space is right-handed with y up; lengths are in scene units.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/core/planes.h"
#include "host/core/shared_types.h"
#include "host/filter/normal_map.h"
#include "host/scene/area_light.h"
#include "host/scene/environment.h"
#include "host/scene/lobe_models.h"

namespace glintmark {

/// Triangles with everything per vertex. All per-vertex arrays have the same length.
struct TriangleMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;   // unit
  std::vector<glm::vec4> tangents;  // xyz: unit dP/du direction; w: +1, or -1 on mirrored uv charts
  std::vector<glm::dvec2> uvs;      // |uv| up to 1e6 and beyond keeps its fraction
  std::vector<glm::uvec3> triangles;              // counter-clockwise from the front
  std::vector<std::uint32_t> triangle_materials;  // one per triangle: index into Scene::materials

  std::size_t triangleCount() const { return triangles.size(); }
};

/// An eye on a sphere around a point of a surface.
struct Orbit {
  glm::dvec3 target{0, 0, 0};
  glm::dvec3 normal{0, 1, 0};  // of the surface at the target, any length but 0
  double angle_deg = 90;       // between the view axis and the surface, (0, 90]
  double azimuth_deg = 0;      // around the normal: 0 puts the eye towards +z, 90 towards +x
  double distance = 1;         // from target to eye, scene units, > 0
};

/// A pinhole view.
struct View {
  std::string name;
  glm::dvec3 eye{0, 0, 1};
  glm::dvec3 target{0, 0, 0};
  glm::dvec3 up{0, 1, 0};
  double fov_y_deg = 45;         // vertical, (0, 180)
  double near_plane = 1e-3;      // world units along the view axis, > 0; there is no far plane
  std::optional<Orbit> orbit{};  // what eye, target and up were made from, if so
};

/// `base` with its eye, target and up from `orbit`. Up turns with the angle, so that a sweep from
/// 90 degrees down to the surface is smooth. For a normal within 25 degrees of the z axis, azimuth
/// 0 is towards -y instead, so that +y is up in the image. Throws Error for a value out of the
/// ranges above.
View orbitView(const View& base, const Orbit& orbit);

/// A material's normals in finer detail than its mesh.
struct NormalMapSource {
  std::shared_ptr<const NormalMap> map;  // in a planned scene without normals yet
  int lobes = 4;  // Gaussians per texel where mixtures stand for the map, 1 to 8; docs/accuracy.md
};

/// [ZK16] Sect. 4.5, ready for the device, with what selects the effects.
struct Material {
  std::string name;
  MaterialParams params{};
  bool has_glints = true;    // false: a smooth Beckmann lobe of roughness alpha_g
  bool has_grooves = false;  // 1-D NDF, [ZK16] Eq. 6: alpha_l.x is not used
  bool has_colour = false;   // coloured microdetails
  bool ggx = false;          // NDF under area lights: GGX, not Beckmann
  DiffuseModel diffuse_model = DiffuseModel::kLambert;
  double diffuse_roughness = 0.5;  // Beckmann roughness of the diffuse microfacets, [0, 1]
  double diffuse_masking = 0;      // importance m of masking and shadowing of the lobes, [0, 1]
  Compensation compensation = Compensation::kOff;
  std::optional<NormalMapSource> normal_map{};  // of smooth materials only
};

/// An environment map already cut into cones is appended to `lights`; this remembers where from.
struct EnvironmentInfo {
  bool present = false;
  std::string file;  // empty: procedural sky
  int cone_count = 0;
  std::string note{};                  // what was changed in the map; empty: nothing
  std::shared_ptr<const Image> map{};  // radiance, rgb, for what is seen behind the meshes
  EnvironmentCut cut{};
};

struct PostEffects {
  bool star = false;    // star-shaped glare around bright pixels
  double exposure = 1;  // linear scale before tone mapping
};

struct Scene {
  std::string name;
  std::string description;
  TriangleMesh mesh;
  std::vector<Material> materials;
  std::vector<ConeLight> lights;  // sun lights first, then the environment's cones
  std::vector<AreaLight> area_lights;
  EnvironmentInfo environment;
  std::vector<View> views;
  PostEffects post;
  bool cull_back_faces = false;    // false: two-sided, normals turn towards the eye
  std::vector<std::string> notes;  // what loading changed or repaired, one sentence each

  /// The view of that name; throws Error listing the known ones.
  const View& view(const std::string& view_name) const;
};

}  // namespace glintmark
