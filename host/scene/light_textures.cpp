// Pictures for textured lights.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "host/core/error.h"
#include "host/scene/area_light.h"
#include "host/scene/noise.h"

namespace glintmark {
namespace {

// Saturated hues of stained glass; [TAO21] Fig. 7 uses such a picture.
constexpr glm::vec3 kGlass[] = {{0.9f, 0.12f, 0.08f}, {0.95f, 0.55f, 0.08f}, {0.95f, 0.85f, 0.25f},
                                {0.15f, 0.6f, 0.2f},  {0.1f, 0.35f, 0.9f},   {0.45f, 0.15f, 0.7f},
                                {0.9f, 0.9f, 0.85f}};
constexpr float kLead = 0.01f;

glm::vec3 checker(double x, double y) {
  const bool bright = (static_cast<int>(x * 8) + static_cast<int>(y * 8)) % 2 == 0;
  return glm::vec3(bright ? 1.0f : 0.05f);
}

glm::vec3 stripes(double x, double y) {
  const int stripe = static_cast<int>((x + 0.25 * y) * 10);
  return stripe % 2 == 0 ? glm::vec3(1, 0.8f, 0.5f) : glm::vec3(0.05f, 0.1f, 0.3f);
}

// 6 x 6 panes between bars of lead, each of some hue.
glm::vec3 panes(double x, double y) {
  const double column = std::floor(6 * x), row = std::floor(6 * y);
  const double in_x = 6 * x - column, in_y = 6 * y - row;
  if (std::min(std::min(in_x, 1 - in_x), std::min(in_y, 1 - in_y)) < 0.06) return glm::vec3(kLead);
  const double choice = 0.5 + 0.5 * gradientNoise({0.37 + 1.71 * column, 0.61 + 2.13 * row}, 5);
  const auto hue = static_cast<std::size_t>(std::abs(choice) * 1000) % std::size(kGlass);
  return kGlass[hue];
}

}  // namespace

std::vector<std::string> lightTextureNames() {
  return {"checker", "panes", "stripes"};
}

Image paintLightTexture(const std::string& name, int size_px) {
  glm::vec3 (*const paint)(double, double) = name == "checker"   ? checker
                                             : name == "panes"   ? panes
                                             : name == "stripes" ? stripes
                                                                 : nullptr;
  if (paint == nullptr)
    throw Error(fmt::format("no light texture '{}', known are {}", name,
                            fmt::join(lightTextureNames(), ", ")));
  Image image(size_px, size_px, 3);
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x) {
      const glm::vec3 colour = paint((x + 0.5) / size_px, (y + 0.5) / size_px);
      for (int c = 0; c < 3; ++c) image.at(x, y)[static_cast<std::size_t>(c)] = colour[c];
    }
  return image;
}

}  // namespace glintmark
