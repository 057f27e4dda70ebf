// Frames that are ready to be timed, and their times by kernel events.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/experiment/bench_run.h"
#include "host/frame/frame_renderer.h"

namespace glintmark {

inline constexpr double kMsPerNs = 1e-6;

/// A renderer of the run's device, prepared and shaded --warmup times, so that its programs are
/// there. Scene and view must live as long as it; `textures` may be shared.
std::unique_ptr<FrameRenderer> preparedFrame(BenchRun& run, const Scene& scene, const View& view,
                                             const ShadingOptions& options,
                                             std::shared_ptr<NormalTextures> textures = nullptr);

/// Build options of all kernels of a frame, as records keep them.
std::string kernelOptions(const FrameRenderer& renderer);

/// Marks all records of a frame as not valid if its radiance has a fault, and says which.
void invalidateIfFaulty(std::vector<Record>& records, const Image& radiance);

/// Shades once; kernel event time [ms]. Throws Interrupted after Ctrl-C.
double shadeMs(FrameRenderer& renderer);
/// The same again and again.
Samples shadeTimesMs(FrameRenderer& renderer, const Repetitions& reps);

/// Times of frames that were shaded in turn, by repetition [ms].
struct TurnTimes {
  Samples first_ms, second_ms;
  Samples ratios() const;       // first / second
  Samples differences() const;  // first - second [ms]
};
TurnTimes shadeInTurn(FrameRenderer& first, FrameRenderer& second, const Repetitions& reps);
/// Enough against a frame of one lane, which takes some ten times as long.
inline constexpr int kOneLaneReps = 5;
/// Of any number of frames, by frame.
std::vector<Samples> shadeInTurn(std::span<const std::unique_ptr<FrameRenderer>> renderers,
                                 const Repetitions& reps);

/// How often two frames are to be shaded in turn: at least `reps` times, and more where they are
/// short, so that no passing disturbance lasts through half of them. Shades each once.
int lastingReps(FrameRenderer& first, FrameRenderer& second, int reps);

/// Frames are timed again until they have taken this long; sampled ones at most --reps times.
inline constexpr double kLeastTime_ms = 600;

}  // namespace glintmark
