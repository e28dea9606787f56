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
  const Scalar* AlongDirection(Eigen::Index begin, Eigen::Index columns);
  // Everything that is kept, from the weights.
  void Renew();
  template <typename Work>
  void ForEachBlock(Work work) const;

  const NetProblem<Scalar>& problem_;
  const bool keeps_;
  Vector w_;
  Vector p_;
  Vector gradient_;
  PackedWeights<Scalar> weights_;    // w
  PackedWeights<Scalar> direction_;  // p
  PackedWeights<Scalar> trial_;      // w + a p
  GradientSum<Scalar> gradient_sum_;
  double w_squared_ = 0.0;  // |w|^2
  double w_along_ = 0.0;    // p'w, where it is found
  double p_squared_ = 0.0;  // |p|^2
  Scalar trial_a_ = 0;
  bool has_trial_ = false;
  bool has_t_ = false;
  bool has_along_ = false;
  int accepted_ = 0;
  // (height x P) where kept, else of one block.
  AlignedMatrix<Scalar> s_;
  AlignedMatrix<Scalar> t_;
  AlignedMatrix<Scalar> y_;
  AlignedMatrix<Scalar> trial_s_;
  AlignedMatrix<Scalar> trial_y_;
  AlignedMatrix<Scalar> z_;  // (J x P) or of one block
  AlignedMatrix<Scalar> trial_z_;
  Vector first_;  // (J * block)
  Vector second_;
};

}  // namespace errmap::models
