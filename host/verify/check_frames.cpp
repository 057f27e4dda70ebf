#include "host/verify/check_frames.h"

#include <cmath>
#include <utility>

#include "host/harness/tolerances.h"

namespace glintmark {

Image checkFrame(const CheckContext& context, const Scene& scene, const View& view,
                 const ShadingOptions& options, std::shared_ptr<NormalTextures> textures) {
  FrameRenderer renderer(context.bench.device, scene, view, options, 1, std::move(textures));
  renderer.prepare();
  renderer.shade();
  return renderer.readRadiance();
}

Finding frameEnergy(const CheckContext& context, const Scene& scene, const View& view,
                    double least_difference) {
  ShadingOptions options{.width_px = 512, .height_px = 512, .lanes = context.lanes};
  const Image glints = checkFrame(context, scene, view, options);
  options.glints = false;
  const Image smooth = checkFrame(context, scene, view, options);
  double sum = 0, wanted = 0, squares = 0, different = 0;
  for (std::size_t i = 0; i < smooth.pixels.size(); i += 4) {
    const double d = glints.pixels[i] - smooth.pixels[i];
    sum += d;
    squares += d * d;
    wanted += smooth.pixels[i];
    different += std::abs(d);
  }
  Finding finding(kEnergyTolerance);
  finding.add(std::abs(sum) / wanted);
  finding.require(std::sqrt(squares) / wanted < kEnergyTolerance / 4,
                  "too few pixels to tell the mean");
  finding.require(different > least_difference * wanted,
                  "glints do not differ from the smooth lobe");
  return finding;
}

}  // namespace glintmark
