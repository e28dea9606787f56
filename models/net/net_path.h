#pragma once

#include "fitting/minimisers/objective.h"
#include "models/net/net_problem.h"

namespace errmap::models {

/// A net's weights moving along directions. The inputs S = W1 X of the hidden
/// nodes are linear in the first-layer weights. Along w + a p they are S + a T
/// with T = P1 X. One product per direction serves the curvature and every
/// trial step; one more gives the gradient at the accepted step.
///
/// S, T and the hidden outputs are stored while they fit the caches. For more
/// patterns they are recomputed block by block, which is no slower then and
/// needs no further memory. Stored values are recomputed from the weights from
/// time to time, before rounding errors accumulate.
///
/// To save cache, the point and its trial points share one buffer of hidden
/// outputs. After a trial, those of the point are recomputed if needed. S is
/// updated only when T is available anyway.
template <typename Scalar>
class NetPath final : public fitting::Path<Scalar> {
 public:
  using Vector = fitting::VectorOf<Scalar>;

  /// Starts at w (N). `problem` must outlive this path.
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
  Block At(Index begin, Index columns);
  // From S: hidden outputs and outputs at the point itself, if stored.
  void ReturnToPoint();
  void Forward(Index begin, Index columns);
  // S at the point and T of a strip, if stored; done once all strips are.
  void Prepare(Index begin, Index columns);
  void EndPreparation();
  // Renews everything stored from the weights.
  void Renew();
  template <typename Work>
  void ForEachBlock(Work work) const;

  const NetProblem<Scalar>& problem_;
  const bool keeps_;
  Vector w_;
  Vector p_;
  Vector gradient_;
  PackedWeights<Scalar> weights_;  // w; its w1 is not needed for stored values
  PackedWeights<Scalar> direction_;  // p
  PackedWeights<Scalar> trial_;      // w + a p
  GradientSum<Scalar> gradient_sum_;
  // For the parameters with decay:
  double w_squared_ = 0.0;  // |w|^2
  double w_along_ = 0.0;    // p'w, if computed
  double p_squared_ = 0.0;  // |p|^2
  Scalar trial_a_ = 0;
  Scalar untaken_ = 0;  // S + this T is S at the point
  bool is_taken_ = true;
  bool is_at_point_ = false;  // y and z are of the point, not a trial
  bool has_trial_ = false;
  bool has_t_ = false;
  bool has_along_ = false;
  int accepted_ = 0;
  // (height x P) if stored, else of one block.
  AlignedMatrix<Scalar> s_;
  AlignedMatrix<Scalar> t_;
  AlignedMatrix<Scalar> y_;
  AlignedMatrix<Scalar> z_;  // (J x P) or of one block
  Vector first_;             // (J * block)
  Vector second_;
};

}  // namespace errmap::models
