#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "fitting/minimisers/objective.h"
#include "models/error_model.h"
#include "models/net/aligned_matrix.h"
#include "models/net/net_kernels.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Arithmetic of sums and the logistic function.
enum class NetArithmetic {
  kFast,   // widest vectors; last digits depend on the machine
  kPlain,  // formulas as written; last digits of the 1995 program
};

/// Nodes of a one-hidden-layer net and the layout of its weight vector w: w1 (H
/// x (I+1)) by columns, then w2 (J x (H+1)) by columns. The last column of each
/// is the bias (NISTIR 5367, Eq. 14-17).
struct NetShape {
  Index inputs = 0;   // I
  Index hidden = 0;   // H
  Index outputs = 1;  // J
  OutputFunction output = OutputFunction::kSigmoid;
  double slope = 1.0;        // c of f(s) = 1 / (1 + e^(-c s)), Eq. 12; above 0
  bool free_biases = false;  // true: wfactor excludes biases

  Index num_weights1() const { return hidden * (inputs + 1); }
  Index num_weights() const { return num_weights1() + outputs * (hidden + 1); }
  /// First index and number of the biases of each layer.
  std::array<std::pair<Index, Index>, 2> biases() const {
    return {{{hidden * inputs, hidden}, {num_weights() - outputs, outputs}}};
  }
};

/// Returns the product of two weight vectors over the parameters with decay.
template <typename Scalar>
double DecayingProduct(const NetShape& shape,
                       const fitting::VectorOf<Scalar>& a,
                       const fitting::VectorOf<Scalar>& b,
                       Scalar of_all) {
  double product = static_cast<double>(of_all);
  if (!shape.free_biases) return product;
  for (const auto& [first, count] : shape.biases()) {
    product -= static_cast<double>(
        a.segment(first, count).dot(b.segment(first, count)));
  }
  return product;
}

/// Returns the output nodes' slope: that of `shape`, 1 for linear ones.
inline double OutputSlope(const NetShape& shape) {
  return shape.output == OutputFunction::kSigmoid ? shape.slope : 1.0;
}

/// Scaled patterns and their cost, shared by evaluations. The slope c is
/// multiplied into the patterns once, so hidden nodes have slope 1.
template <typename Scalar>
struct NetProblem {
  using Vector = fitting::VectorOf<Scalar>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  NetShape shape;
  Matrix patterns;   // ((I+1) x P) inputs and a last row of 1, times c
  Matrix targets;    // (J x P)
  Vector weights;    // (P) of mean 1, or (0)
  Scalar decay = 0;  // wfactor / N
  Index height = 0;  // H, padded
  Index block = 0;   // patterns summed at a time
  Index strip = 0;   // patterns of a block handled at a time
  const NetKernels<Scalar>* kernels = nullptr;

  Index num_patterns() const { return patterns.cols(); }
  BlockSize Size(Index columns) const {
    return {height, columns, shape.outputs};
  }
  /// Computes s = w1 X from pattern `begin` on, s (height x columns).
  void Activate(const AlignedMatrix<Scalar>& w1,
                Index begin,
                Index columns,
                Scalar* s) const;
  /// Calls work(begin, columns) for each strip of patterns from `begin` on.
  template <typename Work>
  void ForEachStrip(Index begin, Index columns, Work work) const {
    const Index end = begin + columns;
    for (; begin < end; begin += strip) {
      work(begin, std::min(strip, end - begin));
    }
  }
};

/// A weight vector in the layout of the kernels, with zeros in the padding.
template <typename Scalar>
struct PackedWeights {
  AlignedMatrix<Scalar> w1;        // (height x (I+1))
  AlignedMatrix<Scalar> w2;        // (height x J)
  fitting::VectorOf<Scalar> bias;  // (J)

  explicit PackedWeights(const NetProblem<Scalar>& problem);
  /// Copies from the vector w (N).
  void Pack(const NetShape& shape, const fitting::VectorOf<Scalar>& w);
  /// Sets sum = this as such a vector + a w (N).
  void UnpackAndAdd(const NetShape& shape,
                    Scalar a,
                    const fitting::VectorOf<Scalar>& w,
                    fitting::VectorOf<Scalar>* sum) const;
  /// Set this = base + a direction: only the weights into the outputs, or all.
  void MoveSecond(const PackedWeights& base,
                  Scalar a,
                  const PackedWeights& direction);
  void Move(const PackedWeights& base,
            Scalar a,
            const PackedWeights& direction);
};

/// Adds the bias to o (J x columns), the inputs of the output nodes from
/// pattern `begin` on, and replaces them by the outputs z (Eq. 17, 18). Returns
/// the sum of squared, weighted residuals.
template <typename Scalar>
double Outputs(const NetProblem<Scalar>& problem,
               Index begin,
               Index columns,
               const fitting::VectorOf<Scalar>& bias,
               Scalar* o);

/// Computes dE/do (J x columns) at the outputs z, without the decay.
template <typename Scalar>
void OutputSlopes(const NetProblem<Scalar>& problem,
                  Index begin,
                  Index columns,
                  const Scalar* z,
                  Scalar* d_output);

/// Returns half the second derivative along a line of the sum of squares
/// returned by Outputs, from z and the first and second derivatives of o (J x
/// columns). `bias_step` (J) is added to the first.
template <typename Scalar>
double OutputCurvature(const NetProblem<Scalar>& problem,
                       Index begin,
                       Index columns,
                       const Scalar* z,
                       const fitting::VectorOf<Scalar>& bias_step,
                       const Scalar* first,
                       const Scalar* second);

/// Accumulates dE/dw over blocks.
template <typename Scalar>
class GradientSum {
 public:
  explicit GradientSum(const NetProblem<Scalar>& problem);
  void Clear();
  /// Adds the patterns from `begin` on, given their y (height x columns) and
  /// outputs z (J x columns).
  void Add(Index begin,
           Index columns,
           const Scalar* y,
           const Scalar* z,
           const PackedWeights<Scalar>& weights);
  /// Returns dE/dw (N), including the decay of `w`.
  void Finish(const fitting::VectorOf<Scalar>& w,
              fitting::VectorOf<Scalar>* gradient) const;

 private:
  const NetProblem<Scalar>& problem_;
  PackedWeights<Scalar> sum_;
  bool is_empty_ = true;
  AlignedMatrix<Scalar> delta_;         // (height x strip)
  fitting::VectorOf<Scalar> d_output_;  // (J * block)
};

/// Returns E from the sum of weighted squares and |w|^2.
template <typename Scalar>
double Cost(const NetProblem<Scalar>& problem,
            double sum_of_squares,
            double weights_squared) {
  const auto count =
      static_cast<double>(problem.num_patterns() * problem.shape.outputs);
  return sum_of_squares / (2.0 * count) +
         0.5 * static_cast<double>(problem.decay) * weights_squared;
}

}  // namespace errmap::models
