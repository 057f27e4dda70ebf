// Shades a small frame with every effect, for memory checkers: shade_small_frame LANES METHOD.
// Prints the sum of the image, so that runs can be compared.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "host/frame/frame_renderer.h"
#include "host/harness/small_scenes.h"

int main(int argc, char** argv) {
  using namespace glintmark;
  if (argc != 3) {
    std::fprintf(stderr, "usage: shade_small_frame LANES METHOD\n");
    return 2;
  }
  try {
    Scene scene = floorScene();
    addFloor(scene, 8, 16, 0);
    scene.materials[0].has_colour = true;
    scene.materials[0].params.glints.size_variation = 1;
    scene.materials[0].params.surface.albedo = {0.1f, 0.1f, 0.1f, 0};
    scene.lights[0].direction.w = 0.05f;

    ShadingOptions options;
    options.width_px = 21;  // no multiple of any lane count
    options.height_px = 5;
    options.lanes = std::atoi(argv[1]);
    options.method = parseMethod(argv[2]);
    options.count_cells = true;
    Device device;
    FrameRenderer renderer(device, scene, lookingDown(20), options, 1);
    renderer.prepare();
    renderer.shade();
    double sum = 0;
    for (const float value : renderer.readRadiance().pixels) sum += value;
    std::printf("%s: sum %.9g, mean cells %.9g\n", device.info().name.c_str(), sum,
                renderer.cellCounts().mean);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "shade_small_frame: %s\n", error.what());
    return 1;
  }
}
