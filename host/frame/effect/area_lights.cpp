#include "host/frame/effect/area_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "host/core/error.h"
#include "host/core/float4.h"
#include "host/fit/anisotropic_table.h"
#include "host/ocl/upload.h"

namespace glintmark {
namespace {

constexpr int kLargestTexture_px = 512;  // finer ones start below their first level

// The places and vectors of a disc, sphere or tube; see kernels/types.h.
void prepareRoundLight(const AreaLight& light, const glm::dvec3& eye, AreaLightParams& params) {
  const glm::dvec3 centre = light.centre - eye;
  const auto radii = lightRadii(light.axis, light.radius);
  params.vertices[0] = toFloat4(centre);
  params.vertices[1] = toFloat4(centre + light.axis);
  params.vertices[2] = toFloat4(radii[0]);
  params.vertices[3] = toFloat4(radii[1]);
  const glm::dvec3 normal = areaLightNormal(light);
  const bool tube = light.shape == LightShape::kTube;
  params.plane = toFloat4(normal, tube ? glm::length(light.axis) : glm::dot(normal, centre));
  params.radiance.w = static_cast<float>(light.radius);
  params.shape = tube ? LIGHT_TUBE : light.shape == LightShape::kSphere ? LIGHT_SPHERE : LIGHT_DISC;
}

void preparePolygon(const AreaLight& light, const glm::dvec3& eye, AreaLightParams& params) {
  const std::size_t count = light.vertices.size();
  for (std::size_t i = 0; i < GM_MAX_LIGHT_VERTICES; ++i)
    params.vertices[i] = toFloat4(light.vertices[std::min(i, count - 1)] - eye);
  const glm::dvec3 normal = areaLightNormal(light);
  params.plane = toFloat4(normal, glm::dot(normal, light.vertices[0] - eye));
  params.shape = static_cast<uint>(count);
}

AreaLightParams prepareAreaLight(const AreaLight& light, const glm::dvec3& eye) {
  AreaLightParams params{};
  params.radiance = toFloat4(light.radiance);
  if (light.shape == LightShape::kPolygon)
    preparePolygon(light, eye, params);
  else
    prepareRoundLight(light, eye, params);
  params.back = light.two_sided ? -1.0f : 0.0f;
  params.area = static_cast<float>(areaLightArea(light));
  params.texture = NO_LIGHT_TEXTURE;
  return params;
}

// Weights of a Gaussian of kLightBlur texels, from the middle outwards.
std::vector<double> blurWeights() {
  std::vector<double> weights;
  for (int i = 0; i <= std::ceil(3 * kLightBlur); ++i)
    weights.push_back(std::exp(-0.5 * i * i / (kLightBlur * kLightBlur)));
  return weights;
}

// Blurs along one axis; what lies outside the image has no weight.
Image blurAxis(const Image& image, int step_x, int step_y) {
  static const std::vector<double> weights = blurWeights();
  const int reach = static_cast<int>(weights.size()) - 1;
  Image result(image.width, image.height, image.channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      double total = 0;
      std::vector<double> sum(static_cast<std::size_t>(image.channels), 0.0);
      for (int k = -reach; k <= reach; ++k) {
        const int at_x = x + k * step_x, at_y = y + k * step_y;
        if (at_x < 0 || at_y < 0 || at_x >= image.width || at_y >= image.height) continue;
        const double weight = weights[static_cast<std::size_t>(std::abs(k))];
        total += weight;
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += weight * image.at(at_x, at_y)[c];
      }
      for (std::size_t c = 0; c < sum.size(); ++c)
        result.at(x, y)[c] = static_cast<float>(sum[c] / total);
    }
  return result;
}

// Rgb and 1, bottom row first.
Image turnOver(const Image& texture) {
  Image image(texture.width, texture.height, 4);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto from = texture.at(x, texture.height - 1 - y);
      const auto to = image.at(x, y);
      for (std::size_t c = 0; c < 3; ++c) to[c] = from[c];
      to[3] = 1;
    }
  return image;
}

// Throws Error for a value that half precision does not hold.
std::vector<std::uint16_t> toHalves(const std::vector<float>& values) {
  constexpr float kGreatestHalf = 65504;
  std::vector<std::uint16_t> halves;
  halves.reserve(values.size());
  for (const float value : values) {
    if (!(std::abs(value) <= kGreatestHalf))
      throw Error(fmt::format(
          "the table of linearly transformed cosines holds {}, too large for half precision",
          value));
    halves.push_back(glm::packHalf1x16(value));
  }
  return halves;
}

// Appends a picture to `texels` and returns where its levels stand.
MipTexture appendTexture(const MipChain& chain, std::vector<float4>& texels) {
  MipTexture layout{};
  layout.width = static_cast<uint>(chain.levels[0].width);
  layout.height = static_cast<uint>(chain.levels[0].height);
  for (const Image& level : chain.levels) {
    layout.first[layout.level_count++] = static_cast<uint>(texels.size());
    for (std::size_t i = 0; i < level.pixels.size(); i += 4)
      texels.push_back(
          {level.pixels[i], level.pixels[i + 1], level.pixels[i + 2], level.pixels[i + 3]});
  }
  return layout;
}

}  // namespace

std::vector<AreaLightParams> prepareAreaLights(std::span<const AreaLight> lights,
                                               const glm::dvec3& eye) {
  std::vector<AreaLightParams> prepared;
  uint textures = 0;
  for (const AreaLight& light : lights) {
    prepared.push_back(prepareAreaLight(light, eye));
    if (!light.texture.pixels.empty()) prepared.back().texture = textures++;
  }
  return prepared;
}

MipChain prefilterLightTexture(const Image& texture) {
  MipChain chain = makeMipChain(turnOver(texture));
  std::size_t skipped = 0;
  while (std::max(chain.levels[skipped].width, chain.levels[skipped].height) > kLargestTexture_px)
    ++skipped;
  chain.levels.erase(chain.levels.begin(),
                     chain.levels.begin() + static_cast<std::ptrdiff_t>(skipped));
  // The finest level stays as it is: a mirror shows the picture.
  for (std::size_t l = 1; l < chain.levels.size(); ++l)
    chain.levels[l] = blurAxis(blurAxis(chain.levels[l], 1, 0), 0, 1);
  return chain;
}

AreaLightBuffers::AreaLightBuffers(Device& device, const Scene& scene, const glm::dvec3& eye,
                                   std::shared_ptr<const LtcTable> own_table)
    : device_(device),
      light_count_(static_cast<uint>(scene.area_lights.size())),
      own_table_(std::move(own_table)) {
  if (scene.area_lights.empty()) return;
  lights_ = upload(device, prepareAreaLights(scene.area_lights, eye), BufferPurpose::kAreaLights);
  std::vector<MipTexture> layouts;
  std::vector<float4> texels;
  for (const AreaLight& light : scene.area_lights) {
    if (light.texture.pixels.empty()) continue;
    layouts.push_back(appendTexture(prefilterLightTexture(light.texture), texels));
  }
  if (layouts.empty()) return;
  layouts_ = upload(device, layouts, BufferPurpose::kLightPictureLayouts);
  texels_ = upload(device, texels, BufferPurpose::kLightPictures);
}

const AreaLightBuffers::Table& AreaLightBuffers::table(const KernelConfig& config) {
  const bool mixture = config.ltc_method == LtcMethod::kMixture;
  const bool anisotropic = config.ltc_anisotropic && !mixture;
  const auto key = std::tuple(config.ggx, config.ltc_half, mixture, anisotropic);
  const auto found = tables_.find(key);
  if (found != tables_.end()) return found->second;
  const reference::Ndf ndf = config.ggx ? reference::Ndf::kGgx : reference::Ndf::kBeckmann;
  const bool own = own_table_ && own_table_->ndf == ndf;
  LtcTable loaded = own ? *own_table_ : shippedLtcTable(ndf);
  if (mixture) {
    // That of the normals stands behind it, at the same size.
    LtcTable normals = shippedLtcTable(reference::Ndf::kNormals);
    if (normals.size != loaded.size) normals = resizedLtcTable(normals, loaded.size);
    loaded.values.insert(loaded.values.end(), normals.values.begin(), normals.values.end());
  }
  if (anisotropic) {
    const std::vector<float> stretched = shippedAnisotropicTable(ndf).paddedValues();
    loaded.values.insert(loaded.values.end(), stretched.begin(), stretched.end());
  }
  constexpr BufferPurpose kPurpose = BufferPurpose::kCosineTable;
  Table made{config.ltc_half ? upload(device_, toHalves(loaded.values), kPurpose)
                             : upload(device_, loaded.values, kPurpose),
             static_cast<uint>(loaded.size)};
  return tables_.emplace(key, std::move(made)).first->second;
}

void AreaLightBuffers::addArguments(const KernelConfig& config, ShadeArguments& arguments) {
  if (!config.ltc) return;
  if (light_count_ == 0) {
    // A program for all materials holds the effect; nobody reads what is handed to it.
    const Buffer nothing = upload(device_, std::vector<float4>{}, BufferPurpose::kAreaLights);
    arguments.add("area_lights", nothing);
    arguments.add("ltc_table", nothing);
    return;
  }
  arguments.add("area_lights", lights_);
  arguments.add("ltc_table", table(config).values);
  if (!config.light_texture) return;
  arguments.add("pictures", layouts_);
  arguments.add("picture_texels", texels_);
}

void AreaLightBuffers::describe(const KernelConfig& config, FrameParams& params) {
  if (!config.ltc || light_count_ == 0) return;
  params.area_light_count = light_count_;
  params.ltc_size = table(config).size;
}

std::size_t AreaLightBuffers::bytes() const {
  std::size_t total = 0;
  for (const Buffer* buffer : {&lights_, &layouts_, &texels_})
    if (!buffer->empty()) total += buffer->bytes();
  for (const auto& [key, made] : tables_) total += made.values.bytes();
  return total;
}

}  // namespace glintmark
