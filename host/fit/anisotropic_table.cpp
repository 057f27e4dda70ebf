#include "host/fit/anisotropic_table.h"

#include <algorithm>
#include <cmath>

#include "host/core/angles.h"
#include "host/fit/anisotropic_lobe.h"

namespace glintmark {
namespace {

// First nodes of roughness and ratio are measured at this node number, see ltcFitAlpha().
constexpr double kFirstNode = 0.2;

// Where the view is grazing its columns x and y of M fall together; what cells are turned to agree
// with has them apart.
constexpr double kLeastAlignCosine = 0.3;

// The mirrored view's frame, as columns.
glm::dmat3 mirroredFrame(const AnisotropicView& view) {
  const glm::dvec3 o = view.view();
  return {{o.z, 0, o.x}, {0, 1, 0}, {-o.x, 0, o.z}};
}

// What narrow lobes have, in that frame.
glm::dmat3 narrowMatrix(const AnisotropicView& view, double cosine) {
  const double c = std::cos(view.phi_rad), s = std::sin(view.phi_rad);
  return {2 * view.alpha.x * glm::dvec3(c, -cosine * s, 0),
          2 * view.alpha.y * glm::dvec3(s, cosine * c, 0),
          {0, 0, 1}};
}

// The inverse of ANISO_VIEW.
double cosineOf(double view) {
  return (ANISO_VIEW_SCALE - view * ANISO_VIEW_WARP) / (ANISO_VIEW_SCALE + view);
}

struct AxisPlace {
  int node = 0;
  double share = 0;  // of the node above
};

AxisPlace placeAt(double x, bool square) {
  constexpr int kLast = ANISO_NODES - 1;
  const double at = std::clamp(x, 0.0, 1.0) * kLast;
  const int node = std::min(static_cast<int>(at), kLast - 1);
  const double f = at - node;
  return {node, square ? ANISO_SQUARE_SHARE(node, f) / ANISO_SQUARE_WIDTH(node) : f};
}

}  // namespace

AnisotropicCell AnisotropicTable::cell(int index) const {
  const float* f = values.data() + static_cast<std::size_t>(index) * ANISO_FLOATS;
  AnisotropicCell cell{.albedo = f[ANISO_ALBEDO], .schlick_albedo = f[ANISO_SCHLICK_ALBEDO]};
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) cell.rest[column][row] = f[ANISO_AX + 3 * column + row];
  return cell;
}

void AnisotropicTable::setCell(int index, const AnisotropicCell& cell) {
  float* f = values.data() + static_cast<std::size_t>(index) * ANISO_FLOATS;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      f[ANISO_AX + 3 * column + row] = static_cast<float>(cell.rest[column][row]);
  f[ANISO_ALBEDO] = static_cast<float>(cell.albedo);
  f[ANISO_SCHLICK_ALBEDO] = static_cast<float>(cell.schlick_albedo);
}

std::vector<float> AnisotropicTable::paddedValues() const {
  std::vector<float> padded(std::size_t{ANISO_CELLS} * ANISO_STRIDE);
  for (std::size_t i = 0; i < ANISO_CELLS; ++i)
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * ANISO_FLOATS), ANISO_FLOATS,
                padded.begin() + static_cast<std::ptrdiff_t>(i * ANISO_STRIDE));
  return padded;
}

int anisotropicIndex(const AnisotropicNode& node) {
  return node[0] * ANISO_STEP_ROUGHNESS + node[1] * ANISO_STEP_RATIO + node[2] * ANISO_STEP_VIEW +
         node[3] * ANISO_STEP_AZIMUTH;
}

AnisotropicView anisotropicViewAt(reference::Ndf ndf, const std::array<double, 4>& place) {
  const auto square = [](double at) {
    const double root = at / (ANISO_NODES - 1);
    return root * root;
  };
  const double alpha = square(std::max(place[0], kFirstNode));
  const double turned = place[3] / (ANISO_NODES - 1);
  return {.ndf = ndf,
          .alpha = {alpha, alpha * square(std::max(place[1], kFirstNode))},
          .cos_theta = cosineOf(square(place[2])),
          .phi_rad = std::atan2(turned, 1 - turned)};
}

AnisotropicView anisotropicView(reference::Ndf ndf, const AnisotropicNode& node) {
  std::array<double, 4> place{};
  std::ranges::copy(node, place.begin());
  return anisotropicViewAt(ndf, place);
}

glm::dmat3 anisotropicMatrix(const AnisotropicCell& cell, const AnisotropicView& view) {
  return mirroredFrame(view) * (narrowMatrix(view, view.cos_theta) + view.alpha.x * cell.rest);
}

void storeAnisotropic(const glm::dmat3& matrix, const AnisotropicView& view,
                      AnisotropicCell& cell) {
  glm::dmat3 m = glm::transpose(mirroredFrame(view)) * (matrix / glm::length(matrix[2]));
  const glm::dmat3 like = narrowMatrix(view, std::max(view.cos_theta, kLeastAlignCosine));
  // Turned about z such that columns x and y lie as near to those of `like` as they can.
  const double angle = std::atan2(glm::dot(m[1], like[0]) - glm::dot(m[0], like[1]),
                                  glm::dot(m[0], like[0]) + glm::dot(m[1], like[1]));
  const double c = std::cos(angle), s = std::sin(angle);
  m = {c * m[0] + s * m[1], c * m[1] - s * m[0], m[2]};
  cell.rest = (m - narrowMatrix(view, view.cos_theta)) / view.alpha.x;
}

AnisotropicCell lookUpAnisotropic(const AnisotropicTable& table, const AnisotropicView& view) {
  const double across = std::abs(std::sin(view.phi_rad)), along = std::abs(std::cos(view.phi_rad));
  const std::array<AxisPlace, 4> places = {
      placeAt(std::sqrt(view.alpha.x), true), placeAt(std::sqrt(view.alpha.y / view.alpha.x), true),
      placeAt(std::sqrt(std::max(ANISO_VIEW(view.cos_theta), 0.0)), false),
      placeAt(across / (along + across), false)};
  AnisotropicNode node{};
  std::array<int, 4> axes = {0, 1, 2, 3};
  for (std::size_t k = 0; k < 4; ++k) node[k] = places[k].node;
  std::ranges::stable_sort(axes, std::greater(),
                           [&](int axis) { return places[static_cast<std::size_t>(axis)].share; });
  // From the node below all to the one above all, one axis after another, the largest share first.
  AnisotropicCell sum{.albedo = 0};
  double left = 1;
  for (std::size_t k = 0; k <= 4; ++k) {
    const double next = k < 4 ? places[static_cast<std::size_t>(axes[k])].share : 0;
    const AnisotropicCell corner = table.cell(anisotropicIndex(node));
    sum.rest += (left - next) * corner.rest;
    sum.albedo += (left - next) * corner.albedo;
    sum.schlick_albedo += (left - next) * corner.schlick_albedo;
    left = next;
    if (k < 4) ++node[static_cast<std::size_t>(axes[k])];
  }
  return sum;
}

}  // namespace glintmark
