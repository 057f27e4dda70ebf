#include "host/frame/ground_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "host/core/error.h"
#include "host/core/trace.h"
#include "host/frame/frame_readback.h"

namespace glintmark {
namespace {

constexpr int kMostSpp = 1 << 20;
// Samples of all pixels together in one launch: some tenths of a second on two cores.
constexpr double kBatchSamples = 8e6;

// Mean and spread of replicates' means, which weigh as much as the samples they have. West,
// "Updating Mean and Variance Estimates: an Improved Method", 1979.
class TruthSpread {
 public:
  TruthSpread(int width_px, int height_px)
      : images_{Image(width_px, height_px, 4), Image(width_px, height_px, 3)} {}

  void add(const Image& replicate, int samples) {
    weight_ += samples;
    ++count_;
    const float share = static_cast<float>(samples) / static_cast<float>(weight_);
    if (count_ == 1) images_.mean.channel_names = replicate.channel_names;
    for (std::size_t i = 0; i < replicate.pixels.size() / 4; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        float& mean = images_.mean.pixels[4 * i + c];
        const float before = replicate.pixels[4 * i + c] - mean;
        mean += share * before;
        images_.standard_error.pixels[3 * i + c] +=
            static_cast<float>(samples) * before * (replicate.pixels[4 * i + c] - mean);
      }
      images_.mean.pixels[4 * i + 3] = replicate.pixels[4 * i + 3];
    }
  }

  // Squares become errors; nothing can be added after it.
  TruthImages take() {
    const auto freedom = static_cast<float>(weight_) * static_cast<float>(std::max(1, count_ - 1));
    for (float& squares : images_.standard_error.pixels)
      squares = std::sqrt(std::max(0.0f, squares) / freedom);
    return std::move(images_);
  }

 private:
  TruthImages images_;
  int weight_ = 0, count_ = 0;
};

void addUnit(TruthRenderer& renderer, const TruthUnit& unit) {
  renderer.addSamples(static_cast<std::uint32_t>(unit.begin),
                      static_cast<std::uint32_t>(unit.count),
                      static_cast<std::uint32_t>(unit.replicate));
}

// Of radiance and coverage, which is none.
Image meanOf(Image sum, std::uint32_t count) {
  for (std::size_t i = 0; i < sum.pixels.size(); ++i)
    if (i % 4 != 3) sum.pixels[i] /= static_cast<float>(count);
  return sum;
}

std::string imageBytes(const Image& image) {
  return {reinterpret_cast<const char*>(image.pixels.data()),
          image.pixels.size() * sizeof image.pixels[0]};
}

// Adds the image of imageBytes() at `position` as the device adds a launch's sums, or begins with
// it; returns its size.
std::size_t addBytes(const std::string& bytes, std::size_t position, bool begins, Image& sum) {
  Image launch = sum;
  const std::size_t size = bytes.copy(reinterpret_cast<char*>(launch.pixels.data()),
                                      launch.pixels.size() * sizeof(float), position);
  for (std::size_t i = 0; i < sum.pixels.size(); ++i)
    sum.pixels[i] = begins || i % 4 == 3 ? launch.pixels[i] : sum.pixels[i] + launch.pixels[i];
  return size;
}

}  // namespace

TruthRenderer::TruthRenderer(Device& device, const Scene& scene, const View& view,
                             const ShadingOptions& options, int thread_count,
                             std::shared_ptr<NormalTextures> textures)
    : pass_(kTruthPass, device, scene, view, options, thread_count, std::move(textures)) {}

FrameTimes TruthRenderer::addSamples(std::uint32_t begin, std::uint32_t count,
                                     std::uint32_t replicate) {
  const TraceScope scope("frame", "truth samples");
  pass_.setNumber("replicate", replicate);
  pass_.setNumber("sample_begin", begin);
  pass_.setNumber("sample_count", count);
  return pass_.launch();
}

Image TruthRenderer::readSum() const {
  double readback_ns = 0;
  return readPlanes(pass_, readback_ns);
}

Image TruthRenderer::readMean(std::uint32_t count) const {
  return meanOf(readSum(), count);
}

std::vector<TruthUnit> truthUnits(int spp, double pixels) {
  if (spp < 1 || spp > kMostSpp)
    throw Error(fmt::format("{} samples a pixel are not from 1 to {}", spp, kMostSpp));
  const int batch = std::max(1, static_cast<int>(kBatchSamples / pixels));
  const int count = std::min(spp, kTruthReplicates);
  std::vector<TruthUnit> units;
  for (int replicate = 0; replicate < count; ++replicate) {
    const int samples = spp / count + (replicate < spp % count ? 1 : 0);
    for (int begin = 0; begin < samples; begin += batch)
      units.push_back({replicate, begin, std::min(batch, samples - begin), samples});
  }
  return units;
}

TruthImages renderTruth(Device& device, const Scene& scene, const View& view,
                        const ShadingOptions& options, int spp,
                        const std::function<void(int done)>& progress, int thread_count,
                        std::shared_ptr<NormalTextures> textures, std::vector<Image>* replicates) {
  TruthRenderer renderer(device, scene, view, options, thread_count, std::move(textures));
  const Camera& camera = renderer.camera();
  const double pixels = static_cast<double>(camera.width_px) * camera.height_px;
  const std::vector<TruthUnit> units = truthUnits(spp, pixels);
  renderer.prepare();
  TruthSpread spread(camera.width_px, camera.height_px);
  int done = 0;
  for (const TruthUnit& unit : units) {
    if (unit.begin == 0) renderer.clear();
    addUnit(renderer, unit);
    done += unit.count;
    if (progress) progress(done);
    if (!unit.isLast()) continue;
    Image mean = renderer.readMean(static_cast<std::uint32_t>(unit.of_replicate));
    spread.add(mean, unit.of_replicate);
    if (replicates != nullptr) replicates->push_back(std::move(mean));
  }
  return spread.take();
}

void SharedTruth::make(TruthRenderer& renderer, RankDeal& deal,
                       const std::function<void()>& progress) {
  const Camera& camera = renderer.camera();
  units_ = truthUnits(spp_, static_cast<double>(camera.width_px) * camera.height_px);
  frame_ = Image(camera.width_px, camera.height_px, 4);
  frame_.channel_names = {"R", "G", "B", "A"};  // as of readPlanes()
  bool prepared = false;
  for (const TruthUnit& unit : units_) {
    makers_.push_back(deal.next(static_cast<double>(unit.count) * camera.width_px));
    if (makers_.back() != ranks_.rank()) continue;
    if (!prepared) renderer.prepare();
    prepared = true;
    renderer.clear();
    addUnit(renderer, unit);
    mine_.push_back(renderer.readSum());
    progress();
  }
}

ReplicatedTruth SharedTruth::join() {
  ReplicatedTruth truth;
  TruthSpread spread(frame_.width, frame_.height);
  Image sum = frame_;
  std::size_t taken = 0;
  // About as many batches at a time as there are ranks.
  const std::size_t some = static_cast<std::size_t>(ranks_.size());
  for (std::size_t first = 0; first < units_.size(); first += some) {
    const std::size_t end = std::min(units_.size(), first + some);
    std::string mine;
    for (std::size_t i = first; i < end; ++i)
      if (makers_[i] == ranks_.rank()) mine += imageBytes(mine_[taken++]);
    const std::vector<std::string> all = ranks_.gather(mine);
    std::vector<std::size_t> read(all.size(), 0);
    for (std::size_t i = first; i < end; ++i) {
      const TruthUnit& unit = units_[i];
      const auto maker = static_cast<std::size_t>(makers_[i]);
      read[maker] += addBytes(all[maker], read[maker], unit.begin == 0, sum);
      if (!unit.isLast()) continue;
      truth.replicates.push_back(meanOf(sum, static_cast<std::uint32_t>(unit.of_replicate)));
      spread.add(truth.replicates.back(), unit.of_replicate);
    }
  }
  mine_.clear();
  truth.images = spread.take();
  return truth;
}

}  // namespace glintmark
