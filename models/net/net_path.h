#pragma once

#include "fitting/minimisers/objective.h"
#include "models/net/net_problem.h"

namespace errmap::models {

/// A net's weights moving along directions. The inputs S = W1 X of the hidden
/// nodes are linear in the first-layer weights, so along w + a p they are
/// S + a T with T = P1 X: one product for a direction serves the curvature and
/// every trial step, and one more gives the gradient at the step accepted.
///
/// S, T and the hidden outputs are kept while they fit the caches; for more
/// patterns they are made again block by block, which is then no slower and
/// needs no memory beyond the patterns. What is kept is renewed from the
/// weights now and then, before the roundings of the steps add up.
///
/// The caches are what this is short of: hidden outputs have one place, for
/// trials too, and are made again where the point itself is asked for after
/// one; S takes a step only when T is at hand anyway.
template <typename Scalar>
class NetPath final : public fitting::Path<Scalar> {
 public:
  using Vector = fitting::VectorOf<Scalar>;

  /// Starts at w (N). `problem` must outlive this.
  NetPath(const NetProblem<Scalar>& problem, const Vector& w);

  void SetDirection(const Vector& p) override;
  Scalar Curvature() override;
  Scalar Value(Scalar a) override;
  void Accept(Scalar a) override;
  const Vector& Gradient() override;

 private:
  // Hidden outputs and outputs of a block of patterns.
  struct Block {
    const Scalar* y;
    const Scalar* z;
  };
  Block At(Eigen::Index begin, Eigen::Index columns);
  // From S: hidden outputs and outputs at the point itself, where kept.
  void ReturnToPoint();
  void Forward(Eigen::Index begin, Eigen::Index columns);
  // S at the point and T of a strip, where kept; then for all, it is done.
  void Prepare(Eigen::Index begin, Eigen::Index columns);
  void EndPreparation();
  // Everything that is kept, from the weights.
  void Renew();
  template <typename Work>
  void ForEachBlock(Work work) const;

  const NetProblem<Scalar>& problem_;
  const bool keeps_;
  Vector w_;
  Vector p_;
  Vector gradient_;
  PackedWeights<Scalar> weights_;    // w; what is kept has no need of its w1
  PackedWeights<Scalar> direction_;  // p
  PackedWeights<Scalar> trial_;      // w + a p
  GradientSum<Scalar> gradient_sum_;
  // Of what bears decay:
  double w_squared_ = 0.0;  // |w|^2
  double w_along_ = 0.0;    // p'w, where it is found
  double p_squared_ = 0.0;  // |p|^2
  Scalar trial_a_ = 0;
  Scalar untaken_ = 0;  // S + this T is S at the point
  bool is_taken_ = true;
  bool is_at_point_ = false;  // y and z are, not at a trial
  bool has_trial_ = false;
  bool has_t_ = false;
  bool has_along_ = false;
  int accepted_ = 0;
  // (height x P) where kept, else of one block.
  AlignedMatrix<Scalar> s_;
  AlignedMatrix<Scalar> t_;
  AlignedMatrix<Scalar> y_;
  AlignedMatrix<Scalar> z_;  // (J x P) or of one block
  Vector first_;             // (J * block)
  Vector second_;
};

}  // namespace errmap::models
