// Measures one set of effects for table `effects`.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "host/experiment/bench_run.h"
#include "host/frame/effect_set.h"
#include "host/frame/frame_renderer.h"

namespace glintmark {

/// Metrics that every case of table `effects` has.
const std::vector<std::string>& effectsMetrics();

/// A scene stripped to a set of effects, and what shades it.
struct EffectFrame {
  Scene scene;
  std::unique_ptr<FrameRenderer> renderer;
};

/// Measures sets of effects of one scene. Frames of few effects serve many sets and are kept.
class EffectsMeasurer {
 public:
  EffectsMeasurer(BenchRun& run, Scene scene, std::string view_name);

  /// Records of one case, all of effectsMetrics() and, for several effects, what they cost alone.
  std::vector<Record> measure(const std::string& case_name, EffectSet set);

 private:
  struct Compared;
  struct Frames;
  class CaseMaker;
  Compared makeCompared(EffectSet set);
  Frames measureFrames(const Compared& compared, EffectSet set);
  ShadingOptions optionsFor(EffectSet kept, EffectSet measured_in) const;
  std::unique_ptr<EffectFrame> makeFrame(EffectSet kept, EffectSet measured_in, Programs programs);
  EffectFrame& keptFrame(EffectSet kept, EffectSet measured_in);
  double buildMs(const FrameRenderer& renderer, std::size_t& from_cache);

  BenchRun& run_;
  Scene scene_;
  std::string view_name_;
  std::map<std::string, std::unique_ptr<EffectFrame>> kept_;
  std::map<std::string, double> cold_build_ms_;  // by the options of a program
};

}  // namespace glintmark
