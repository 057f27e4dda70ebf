#include "host/experiment/repetitions.h"

#include <algorithm>
#include <cmath>

#include "host/core/statistics.h"

namespace glintmark {

Repetitions::Repetitions(int least, double noise, Clock::time_point until)
    : least_(noise > 0 ? std::max(least, kLeastNoiseRepetitions) : least),
      most_(noise > 0 ? std::max(least, kMostRepetitions) : least),
      noise_(noise),
      until_(until) {}

Repetitions Repetitions::atMost(int most) const {
  Repetitions fewer = *this;
  fewer.most_ = std::min(most_, most);
  fewer.least_ = std::min(least_, most);
  return fewer;
}

Repetitions Repetitions::scaled(double factor) const {
  Repetitions other = *this;
  other.least_ = std::max(1, static_cast<int>(std::ceil(least_ * factor)));
  other.most_ = std::max(noise_ > 0 ? most_ : 1, other.least_);
  return other;
}

bool Repetitions::wantsMore(std::initializer_list<const Samples*> series) const {
  const std::size_t rounds = (*series.begin())->size();
  if (rounds == 0) return true;
  if (!mayGoOn(rounds)) return false;
  return rounds < static_cast<std::size_t>(least_) ||
         std::ranges::any_of(series, [&](const Samples* samples) { return isNoisy(*samples); });
}

bool Repetitions::wantsMore(const std::vector<Samples>& series) const {
  const std::size_t rounds = series.empty() ? least_ : series.front().size();
  if (rounds == 0) return true;
  if (!mayGoOn(rounds)) return false;
  return rounds < static_cast<std::size_t>(least_) ||
         std::ranges::any_of(series, [&](const Samples& samples) { return isNoisy(samples); });
}

bool Repetitions::mayGoOn(std::size_t rounds) const {
  return rounds < static_cast<std::size_t>(most_) && Clock::now() < until_;
}

bool Repetitions::isNoisy(const Samples& samples) const {
  if (!(noise_ > 0)) return false;
  const Summary summary = summarize(samples);
  return medianStandardError(summary) > noise_ * std::abs(summary.median);
}

}  // namespace glintmark
