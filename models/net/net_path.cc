#include "models/net/net_path.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "fitting/minimisers/vector_passes.h"

namespace errmap::models {

namespace {

// A hidden quantity of all patterns may take this much: all that is kept then
// fits a third-level cache.
constexpr Index kMostKeptBytes = (Index{32} << 20) / 5;

template <typename Scalar>
bool FitsTheCaches(const NetProblem<Scalar>& problem) {
  return problem.height * problem.num_patterns() *
             static_cast<Index>(sizeof(Scalar)) <=
         kMostKeptBytes;
}

}  // namespace

template <typename Scalar>
NetPath<Scalar>::NetPath(const NetProblem<Scalar>& problem, const Vector& w)
    : problem_(problem),
      keeps_(FitsTheCaches(problem)),
      w_(w),
      p_(Vector::Zero(w.size())),
      gradient_(w.size()),
      weights_(problem),
      direction_(problem),
      trial_(problem),
      gradient_sum_(problem),
      first_(problem.shape.outputs * problem.block),
      second_(problem.shape.outputs * problem.block) {
  const Index columns = keeps_ ? problem.num_patterns() : problem.block;
  const Index outputs = problem.shape.outputs;
  s_ = AlignedMatrix<Scalar>(problem.height, columns);
  t_ = AlignedMatrix<Scalar>(problem.height, columns);
  y_ = AlignedMatrix<Scalar>(problem.height, columns);
  z_ = AlignedMatrix<Scalar>(outputs, columns);
  Renew();
}

template <typename Scalar>
template <typename Work>
void NetPath<Scalar>::ForEachBlock(Work work) const {
  const Index num_patterns = problem_.num_patterns();
  for (Index begin = 0; begin < num_patterns; begin += problem_.block) {
    work(begin, std::min(problem_.block, num_patterns - begin));
  }
}

template <typename Scalar>
void NetPath<Scalar>::Renew() {
  w_squared_ = DecayingProduct(problem_.shape, w_, w_, w_.squaredNorm());
  weights_.Pack(problem_.shape, w_);
  if (!keeps_) return;
  ForEachBlock([&](Index begin, Index columns) {
    problem_.Activate(weights_.w1, begin, columns, s_.column(begin));
    Forward(begin, columns);
  });
  is_taken_ = true;
  is_at_point_ = true;
}

template <typename Scalar>
void NetPath<Scalar>::ReturnToPoint() {
  if (!keeps_ || is_at_point_) return;
  assert(is_taken_);  // by the trial
  ForEachBlock([&](Index begin, Index columns) { Forward(begin, columns); });
  is_at_point_ = true;
}

template <typename Scalar>
void NetPath<Scalar>::Forward(Index begin, Index columns) {
  problem_.kernels->forward(problem_.Size(columns),
                            s_.column(begin),
                            weights_.w2.data(),
                            y_.column(begin),
                            z_.column(begin));
  Outputs(problem_, begin, columns, weights_.bias, z_.column(begin));
}

template <typename Scalar>
typename NetPath<Scalar>::Block NetPath<Scalar>::At(Index begin,
                                                    Index columns) {
  if (keeps_) return {y_.column(begin), z_.column(begin)};
  problem_.Activate(weights_.w1, begin, columns, s_.data());
  problem_.kernels->forward(problem_.Size(columns),
                            s_.data(),
                            weights_.w2.data(),
                            y_.data(),
                            z_.data());
  Outputs(problem_, begin, columns, weights_.bias, z_.data());
  return {y_.data(), z_.data()};
}

template <typename Scalar>
void NetPath<Scalar>::Prepare(Index begin, Index columns) {
  Scalar* t = t_.column(begin);
  if (!is_taken_) {
    problem_.kernels->advance(
        problem_.Size(columns), t, untaken_, s_.column(begin));
  }
  if (!has_t_) problem_.Activate(direction_.w1, begin, columns, t);
}

template <typename Scalar>
void NetPath<Scalar>::EndPreparation() {
  is_taken_ = true;
  has_t_ = true;
}

template <typename Scalar>
void NetPath<Scalar>::SetDirection(const Vector& p) {
  std::copy_n(p.data(), p.size(), p_.data());
  const fitting::VectorSums<Scalar> sums = fitting::SquaresAndProduct(p_, w_);
  p_squared_ = DecayingProduct(problem_.shape, p_, p_, sums.squares);
  w_along_ = DecayingProduct(problem_.shape, p_, w_, sums.product);
  has_along_ = true;
  direction_.Pack(problem_.shape, p_);
  has_trial_ = false;
  has_t_ = false;
}

template <typename Scalar>
Scalar NetPath<Scalar>::Curvature() {
  ReturnToPoint();
  double sum = 0.0;
  ForEachBlock([&](Index begin, Index columns) {
    const Block block = At(begin, columns);
    problem_.ForEachStrip(begin, columns, [&](Index from, Index count) {
      const Index offset = from - begin;
      Scalar* t = keeps_ ? t_.column(from) : t_.data();
      if (keeps_) {
        Prepare(from, count);
      } else {
        problem_.Activate(direction_.w1, from, count, t);
      }
      problem_.kernels->bend_along(
          problem_.Size(count),
          block.y + offset * problem_.height,
          t,
          weights_.w2.data(),
          direction_.w2.data(),
          first_.data() + offset * problem_.shape.outputs,
          second_.data() + offset * problem_.shape.outputs);
    });
    sum += OutputCurvature(problem_,
                           begin,
                           columns,
                           block.z,
                           direction_.bias,
                           first_.data(),
                           second_.data());
  });
  if (keeps_) EndPreparation();
  // Cost halves the sum of squares, whose second derivative is twice `sum`.
  return static_cast<Scalar>(Cost(problem_, 2.0 * sum, 2.0 * p_squared_));
}

template <typename Scalar>
Scalar NetPath<Scalar>::Value(Scalar a) {
  trial_a_ = a;
  has_trial_ = true;
  if (keeps_) {
    trial_.MoveSecond(weights_, a, direction_);
  } else {
    trial_.Move(weights_, a, direction_);
  }
  if (!has_along_) {
    w_along_ = DecayingProduct(problem_.shape, p_, w_, p_.dot(w_));
    has_along_ = true;
  }
  double sum = 0.0;
  ForEachBlock([&](Index begin, Index columns) {
    Scalar* z = keeps_ ? z_.column(begin) : z_.data();
    if (keeps_) {
      if (!is_taken_ || !has_t_) Prepare(begin, columns);
      problem_.kernels->forward_along(problem_.Size(columns),
                                      s_.column(begin),
                                      t_.column(begin),
                                      a,
                                      trial_.w2.data(),
                                      y_.column(begin),
                                      z);
    } else {
      problem_.Activate(trial_.w1, begin, columns, s_.data());
      problem_.kernels->forward(
          problem_.Size(columns), s_.data(), trial_.w2.data(), y_.data(), z);
    }
    sum += Outputs(problem_, begin, columns, trial_.bias, z);
  });
  if (keeps_) EndPreparation();
  is_at_point_ = false;
  const auto step = static_cast<double>(a);
  return static_cast<Scalar>(Cost(
      problem_, sum, w_squared_ + step * (2.0 * w_along_ + step * p_squared_)));
}

template <typename Scalar>
void NetPath<Scalar>::Accept(Scalar a) {
  constexpr int kRenewal = 64;
  const bool is_at_trial = has_trial_ && a == trial_a_ && !is_at_point_;
  if (!is_at_trial) Value(a);
  has_trial_ = false;
  w_ += a * p_;
  const Scalar squares = fitting::SquaresAndProduct(w_, w_).squares;
  w_squared_ = DecayingProduct(problem_.shape, w_, w_, squares);
  if (++accepted_ % kRenewal == 0) {
    Renew();
  } else {
    std::swap(weights_, trial_);
    untaken_ = a;
    is_taken_ = false;
    is_at_point_ = true;
  }
  has_along_ = false;
}

template <typename Scalar>
const typename NetPath<Scalar>::Vector& NetPath<Scalar>::Gradient() {
  ReturnToPoint();
  gradient_sum_.Clear();
  ForEachBlock([&](Index begin, Index columns) {
    const Block block = At(begin, columns);
    gradient_sum_.Add(begin, columns, block.y, block.z, weights_);
  });
  gradient_sum_.Finish(w_, &gradient_);
  return gradient_;
}

template class NetPath<double>;
template class NetPath<float>;

}  // namespace errmap::models
