#include "host/mixture/mixture_em.h"

#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "host/mixture/mixture_em.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace glintmark::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F32 = hn::CappedTag<float, kBlockTexels>;
using VF = hn::Vec<F32>;

// Weight below which a lobe is left out of the E-step, and density of such a lobe, as logarithm.
constexpr float kNoWeight = 1e-30f;
constexpr float kNoDensity = -1e30f;
constexpr float kLogTwoPi = 1.8378770664f;

// 2^x for x <= 0, relative error 4e-6 (0 below -126): degree-5 fit of 2^f on [-1/2, 1/2].
HWY_INLINE VF exp2Negative(VF x) {
  const F32 d;
  const hn::RebindToSigned<F32> di;
  const VF clamped = hn::Max(x, hn::Set(d, -126.0f));
  const VF whole = hn::Round(clamped);
  const VF f = hn::Sub(clamped, whole);
  VF p = hn::Set(d, 1.3333558e-3f);
  p = hn::MulAdd(p, f, hn::Set(d, 9.6181291e-3f));
  p = hn::MulAdd(p, f, hn::Set(d, 5.5504109e-2f));
  p = hn::MulAdd(p, f, hn::Set(d, 2.4022651e-1f));
  p = hn::MulAdd(p, f, hn::Set(d, 6.9314718e-1f));
  p = hn::MulAdd(p, f, hn::Set(d, 1.0f));
  const auto exponent = hn::ShiftLeft<23>(hn::ConvertTo(di, whole));
  return hn::BitCast(d, hn::Add(hn::BitCast(di, p), exponent));
}

// The mixture of one vector of texels, ready for densities, and the sums of an E-step.
template <int kLobes>
struct Step {
  VF mean_x[kLobes], mean_y[kLobes];
  VF log_scale[kLobes];  // log2 of weight / variance
  VF slope[kLobes];      // -log2(e) / (2 variance)
  VF sum[kLobes], sum_x[kLobes], sum_y[kLobes], sum_squares[kLobes];
  VF log2_likelihood;

  template <class Load>
  HWY_INLINE Step(const MixtureBlock& block, const Load& load) {
    const F32 d;
    const VF zero = hn::Zero(d);
    log2_likelihood = zero;
    for (int i = 0; i < kLobes; ++i) {
      mean_x[i] = load(block.mean_x[i]), mean_y[i] = load(block.mean_y[i]);
      const VF weight = load(block.weight[i]), variance = load(block.variance[i]);
      const VF scale = hn::Div(hn::Max(weight, hn::Set(d, kNoWeight)), variance);
      log_scale[i] = hn::IfThenElse(hn::Gt(weight, hn::Set(d, kNoWeight)), hn::Log2(d, scale),
                                    hn::Set(d, kNoDensity));
      slope[i] = hn::Div(hn::Set(d, -0.72134752f), variance);
      sum[i] = sum_x[i] = sum_y[i] = sum_squares[i] = zero;
    }
  }

  // Shares one vector of normals among the lobes.
  template <bool kLikelihood>
  HWY_INLINE void add(VF x, VF y, VF normal_weight) {
    const F32 d;
    VF dx[kLobes], dy[kLobes], squares[kLobes], share[kLobes];
    VF highest = hn::Set(d, kNoDensity);
    for (int i = 0; i < kLobes; ++i) {
      dx[i] = hn::Sub(x, mean_x[i]), dy[i] = hn::Sub(y, mean_y[i]);
      squares[i] = hn::MulAdd(dx[i], dx[i], hn::Mul(dy[i], dy[i]));
      share[i] = hn::MulAdd(squares[i], slope[i], log_scale[i]);
      highest = hn::Max(highest, share[i]);
    }
    // Relative to the nearest lobe, so that far normals do not divide 0 by 0.
    VF total = hn::Zero(d);
    for (int i = 0; i < kLobes; ++i) {
      share[i] = exp2Negative(hn::Sub(share[i], highest));
      total = hn::Add(total, share[i]);
    }
    const VF scale = hn::Div(normal_weight, total);
    for (int i = 0; i < kLobes; ++i) {
      const VF r = hn::Mul(share[i], scale);
      sum[i] = hn::Add(sum[i], r);
      sum_x[i] = hn::MulAdd(r, dx[i], sum_x[i]);
      sum_y[i] = hn::MulAdd(r, dy[i], sum_y[i]);
      sum_squares[i] = hn::MulAdd(r, squares[i], sum_squares[i]);
    }
    if constexpr (kLikelihood) {
      log2_likelihood =
          hn::MulAdd(normal_weight, hn::Add(highest, hn::Log2(d, total)), log2_likelihood);
    }
  }
};

template <int kLobes, bool kLikelihood>
void expectBlockLobes(MixtureBlock& block, const BlockNormals& normals) {
  const F32 d;
  const VF ln2 = hn::Set(d, 0.69314718f), log_two_pi = hn::Set(d, kLogTwoPi);
  for (int lane = 0; lane < kBlockTexels; lane += static_cast<int>(hn::Lanes(d))) {
    Step<kLobes> step(block,
                      [&](const float* values) HWY_ATTR { return hn::Load(d, values + lane); });
    for (std::size_t j = 0; j < normals.count; ++j) {
      const std::size_t at = j * kBlockTexels + lane;
      step.template add<kLikelihood>(hn::LoadU(d, normals.x + at), hn::LoadU(d, normals.y + at),
                                     hn::LoadU(d, normals.weight + at));
    }
    for (int i = 0; i < kLobes; ++i) {
      hn::Store(step.sum[i], d, block.sum[i] + lane);
      hn::Store(step.sum_x[i], d, block.sum_x[i] + lane);
      hn::Store(step.sum_y[i], d, block.sum_y[i] + lane);
      hn::Store(step.sum_squares[i], d, block.sum_squares[i] + lane);
    }
    hn::Store(hn::Sub(hn::Mul(step.log2_likelihood, ln2),
                      hn::Mul(hn::Load(d, block.normals + lane), log_two_pi)),
              d, block.log_likelihood + lane);
  }
}

template <int kLobes, bool kLikelihood>
void expectRowsLobes(const MixtureBlock& block, const NormalRow* rows, std::size_t row_count,
                     double (*totals)[4]) {
  const F32 d;
  Step<kLobes> step(block, [&](const float* values) HWY_ATTR { return hn::Set(d, values[0]); });
  VF normals = hn::Zero(d);
  for (std::size_t r = 0; r < row_count; ++r) {
    const NormalRow& row = rows[r];
    const VF row_weight = hn::Set(d, row.row_weight);
    for (std::size_t j = 0; j < row.count; j += hn::Lanes(d)) {
      const VF weight = hn::Mul(hn::LoadU(d, row.weight + j), row_weight);
      normals = hn::Add(normals, weight);
      step.template add<kLikelihood>(hn::LoadU(d, row.x + j), hn::LoadU(d, row.y + j), weight);
    }
  }
  const auto total = [&](VF v) HWY_ATTR {
    return static_cast<double>(hn::GetLane(hn::SumOfLanes(d, v)));
  };
  for (int i = 0; i < kLobes; ++i) {
    totals[i][0] += total(step.sum[i]);
    totals[i][1] += total(step.sum_x[i]);
    totals[i][2] += total(step.sum_y[i]);
    totals[i][3] += total(step.sum_squares[i]);
  }
  totals[kLobes][0] +=
      total(step.log2_likelihood) * 0.6931471805599453 - total(normals) * kLogTwoPi;
}

void maximizeBlockTarget(MixtureBlock& block, int lobes) {
  const F32 d;
  const VF one = hn::Set(d, 1.0f), zero = hn::Zero(d);
  for (int lane = 0; lane < kBlockTexels; lane += static_cast<int>(hn::Lanes(d))) {
    const VF inverse_normals = hn::Div(one, hn::Load(d, block.normals + lane));
    // A lobe with less than this of the normals keeps its variance.
    const VF least = hn::Mul(hn::Load(d, block.normals + lane), hn::Set(d, 1e-6f));
    VF moved = zero;
    for (int i = 0; i < lobes; ++i) {
      const VF sum = hn::Load(d, block.sum[i] + lane);
      const VF sum_x = hn::Load(d, block.sum_x[i] + lane);
      const VF sum_y = hn::Load(d, block.sum_y[i] + lane);
      const VF mean_x = hn::Load(d, block.mean_x[i] + lane);
      const VF mean_y = hn::Load(d, block.mean_y[i] + lane);
      // mean = (sum r n + sum C a_k mean_k) / (sum r + sum C a_k), as the step from the old mean.
      const VF prior = hn::Load(d, block.prior_weight[i] + lane);
      const VF pull_x = hn::NegMulAdd(prior, mean_x, hn::Load(d, block.prior_x[i] + lane));
      const VF pull_y = hn::NegMulAdd(prior, mean_y, hn::Load(d, block.prior_y[i] + lane));
      const VF divisor = hn::Div(one, hn::Max(hn::Add(sum, prior), hn::Set(d, 1e-20f)));
      const VF step_x = hn::Mul(hn::Add(sum_x, pull_x), divisor);
      const VF step_y = hn::Mul(hn::Add(sum_y, pull_y), divisor);
      // variance = sum r |n - mean|^2 / (d sum r) about the new mean, d = 2.
      const VF step_squares = hn::MulAdd(step_x, step_x, hn::Mul(step_y, step_y));
      const VF cross = hn::MulAdd(step_x, sum_x, hn::Mul(step_y, sum_y));
      const VF squares =
          hn::Add(hn::NegMulAdd(hn::Set(d, 2.0f), cross, hn::Load(d, block.sum_squares[i] + lane)),
                  hn::Mul(sum, step_squares));
      const VF old_variance = hn::Load(d, block.variance[i] + lane);
      const VF variance = hn::IfThenElse(
          hn::Gt(sum, least), hn::Div(hn::Mul(hn::Set(d, 0.5f), squares), hn::Max(sum, least)),
          old_variance);
      const VF weight = hn::Mul(sum, inverse_normals);
      const VF weight_step = hn::Abs(hn::Sub(weight, hn::Load(d, block.weight[i] + lane)));
      // A lobe that hardly counts may wander.
      const VF mean_step = hn::Mul(hn::Max(hn::Abs(step_x), hn::Abs(step_y)),
                                   hn::Min(one, hn::Mul(weight, hn::Set(d, 10.0f))));
      moved = hn::Max(moved, hn::Max(weight_step, mean_step));
      hn::Store(weight, d, block.weight[i] + lane);
      hn::Store(hn::Add(mean_x, step_x), d, block.mean_x[i] + lane);
      hn::Store(hn::Add(mean_y, step_y), d, block.mean_y[i] + lane);
      hn::Store(hn::Max(variance, hn::Set(d, MF_MIN_VARIANCE)), d, block.variance[i] + lane);
    }
    hn::Store(moved, d, block.moved + lane);
  }
}

// Calls `run` with the lobe count and whether the likelihood is wanted as constants.
template <int kLobes = 1, class Run>
void withConstants(int lobes, bool likelihood, const Run& run) {
  if constexpr (kLobes < kMaxLobes) {
    if (lobes > kLobes) return withConstants<kLobes + 1>(lobes, likelihood, run);
  }
  const std::integral_constant<int, kLobes> count;
  likelihood ? run(count, std::true_type{}) : run(count, std::false_type{});
}

void expectBlockTarget(MixtureBlock& block, int lobes, const BlockNormals& normals,
                       bool likelihood) {
  withConstants(lobes, likelihood, [&](auto count, auto wanted) {
    expectBlockLobes<count(), wanted()>(block, normals);
  });
}

void expectRowsTarget(const MixtureBlock& block, int lobes, const NormalRow* rows,
                      std::size_t row_count, bool likelihood, double (*totals)[4]) {
  withConstants(lobes, likelihood, [&](auto count, auto wanted) {
    expectRowsLobes<count(), wanted()>(block, rows, row_count, totals);
  });
}

}  // namespace glintmark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glintmark {

HWY_EXPORT(expectBlockTarget);
HWY_EXPORT(expectRowsTarget);
HWY_EXPORT(maximizeBlockTarget);

void expectBlock(MixtureBlock& block, int lobes, const BlockNormals& normals, bool likelihood) {
  HWY_DYNAMIC_DISPATCH(expectBlockTarget)(block, lobes, normals, likelihood);
}

void expectRows(const MixtureBlock& block, int lobes, const NormalRow* rows, std::size_t row_count,
                bool likelihood, double (*totals)[4]) {
  HWY_DYNAMIC_DISPATCH(expectRowsTarget)(block, lobes, rows, row_count, likelihood, totals);
}

void maximizeBlock(MixtureBlock& block, int lobes) {
  HWY_DYNAMIC_DISPATCH(maximizeBlockTarget)(block, lobes);
}

}  // namespace glintmark
#endif  // HWY_ONCE
