#include "models/net/net_problem.h"

#include "fitting/multiversion.h"

namespace errmap::models {

namespace {

// A matrix whose columns begin `stride` apart, or with the next number.
struct Layout {
  Index rows;
  Index columns;
  Index stride;

  Layout AsOneColumn() const {
    return stride == rows ? Layout{rows * columns, 1, rows * columns} : *this;
  }
};

// To the layout, from columns without gaps.
template <typename Scalar>
void CopyFromDense(Layout layout, const Scalar* from, Scalar* to) {
  const Layout runs = layout.AsOneColumn();
  for (Index j = 0; j < runs.columns; ++j) {
    std::copy_n(from + j * runs.rows, runs.rows, to + j * runs.stride);
  }
}

// to = from + a x, `from` alone in the layout.
template <typename Scalar>
__attribute__((always_inline)) inline void AddToDense(
    Layout layout, const Scalar* from, Scalar a, const Scalar* x, Scalar* to) {
  const Layout runs = layout.AsOneColumn();
  for (Index j = 0; j < runs.columns; ++j) {
    const Index begin = j * runs.rows;
    for (Index i = 0; i < runs.rows; ++i) {
      to[begin + i] = from[j * runs.stride + i] + a * x[begin + i];
    }
  }
}

ERRMAP_MULTIVERSION
void AddFromLayout(
    Layout layout, const double* from, double a, const double* x, double* to) {
  AddToDense(layout, from, a, x, to);
}

ERRMAP_MULTIVERSION
void AddFromLayout(
    Layout layout, const float* from, float a, const float* x, float* to) {
  AddToDense(layout, from, a, x, to);
}

}  // namespace

template <typename Scalar>
void NetProblem<Scalar>::Activate(const AlignedMatrix<Scalar>& w1,
                                  Index begin,
                                  Index columns,
                                  Scalar* s) const {
  kernels->activate(
      Size(columns), patterns.rows(), w1.data(), patterns.col(begin).data(), s);
}

template <typename Scalar>
PackedWeights<Scalar>::PackedWeights(const NetProblem<Scalar>& problem)
    : w1(problem.height, problem.shape.inputs + 1),
      w2(problem.height, problem.shape.outputs),
      bias(fitting::VectorOf<Scalar>::Zero(problem.shape.outputs)) {}

template <typename Scalar>
void PackedWeights<Scalar>::Pack(const NetShape& shape,
                                 const fitting::VectorOf<Scalar>& w) {
  using ConstMap = Eigen::Map<const typename AlignedMatrix<Scalar>::Matrix>;
  const Index hidden = shape.hidden;
  CopyFromDense({hidden, w1.cols(), w1.rows()}, w.data(), w1.data());
  const ConstMap from2(
      w.data() + shape.num_weights1(), shape.outputs, hidden + 1);
  w2.all().topRows(hidden) = from2.leftCols(hidden).transpose();
  bias = from2.col(hidden);
}

template <typename Scalar>
void PackedWeights<Scalar>::UnpackAndAdd(const NetShape& shape,
                                         Scalar a,
                                         const fitting::VectorOf<Scalar>& w,
                                         fitting::VectorOf<Scalar>* sum) const {
  using Matrix = typename AlignedMatrix<Scalar>::Matrix;
  const Index hidden = shape.hidden;
  const Index first = shape.num_weights1();
  AddFromLayout(
      {hidden, w1.cols(), w1.rows()}, w1.data(), a, w.data(), sum->data());
  const Eigen::Map<const Matrix> added(
      w.data() + first, shape.outputs, hidden + 1);
  Eigen::Map<Matrix> to2(sum->data() + first, shape.outputs, hidden + 1);
  to2.leftCols(hidden) =
      w2.all().topRows(hidden).transpose() + a * added.leftCols(hidden);
  to2.col(hidden) = bias + a * added.col(hidden);
}

template <typename Scalar>
void PackedWeights<Scalar>::MoveSecond(const PackedWeights& base,
                                       Scalar a,
                                       const PackedWeights& direction) {
  w2.all() = base.w2.all() + a * direction.w2.all();
  bias = base.bias + a * direction.bias;
}

template <typename Scalar>
void PackedWeights<Scalar>::Move(const PackedWeights& base,
                                 Scalar a,
                                 const PackedWeights& direction) {
  w1.all() = base.w1.all() + a * direction.w1.all();
  MoveSecond(base, a, direction);
}

namespace {

// One output and no weights, as most problems are: a number a pattern, in loops
// without choices.
template <typename Scalar>
bool IsPlain(const NetProblem<Scalar>& problem) {
  return problem.shape.outputs == 1 && problem.weights.size() == 0;
}

}  // namespace

template <typename Scalar>
double Outputs(const NetProblem<Scalar>& problem,
               Index begin,
               Index columns,
               const fitting::VectorOf<Scalar>& bias,
               Scalar* o) {
  const Index outputs = problem.shape.outputs;
  const Scalar slope = static_cast<Scalar>(OutputSlope(problem.shape));
  for (Index j = 0; j < outputs; ++j) {
    const Scalar from = bias[j];
    for (Index i = j; i < outputs * columns; i += outputs) {
      o[i] = slope * (o[i] + from);
    }
  }
  if (problem.shape.output == OutputFunction::kSigmoid) {
    problem.kernels->logistic(outputs * columns, o, o);
  }
  const Scalar* targets = problem.targets.data() + begin * outputs;
  const bool weighted = problem.weights.size() != 0;
  double sum = 0.0;
  if (IsPlain(problem)) {
    for (Index p = 0; p < columns; ++p) {
      const auto error = static_cast<double>(o[p] - targets[p]);
      sum += error * error;
    }
    return sum;
  }
  for (Index p = 0; p < columns; ++p) {
    double squares = 0.0;
    for (Index j = 0; j < outputs; ++j) {
      const double error =
          static_cast<double>(o[p * outputs + j] - targets[p * outputs + j]);
      squares += error * error;
    }
    sum += weighted ? squares * static_cast<double>(problem.weights[begin + p])
                    : squares;
  }
  return sum;
}

template <typename Scalar>
void OutputSlopes(const NetProblem<Scalar>& problem,
                  Index begin,
                  Index columns,
                  const Scalar* z,
                  Scalar* d_output) {
  const Index outputs = problem.shape.outputs;
  const bool sigmoid = problem.shape.output == OutputFunction::kSigmoid;
  const Scalar slope = static_cast<Scalar>(OutputSlope(problem.shape));
  const bool weighted = problem.weights.size() != 0;
  const Scalar share =
      Scalar(1) / static_cast<Scalar>(problem.num_patterns() * outputs);
  const Scalar* targets = problem.targets.data() + begin * outputs;
  if (sigmoid && IsPlain(problem)) {
    for (Index p = 0; p < columns; ++p) {
      d_output[p] =
          share * (z[p] - targets[p]) * (slope * (z[p] - z[p] * z[p]));
    }
    return;
  }
  for (Index p = 0; p < columns; ++p) {
    const Scalar factor = weighted ? share * problem.weights[begin + p] : share;
    for (Index j = 0; j < outputs; ++j) {
      const Index i = p * outputs + j;
      const Scalar derivative =
          sigmoid ? slope * (z[i] - z[i] * z[i]) : Scalar(1);
      d_output[i] = factor * (z[i] - targets[i]) * derivative;
    }
  }
}

template <typename Scalar>
double OutputCurvature(const NetProblem<Scalar>& problem,
                       Index begin,
                       Index columns,
                       const Scalar* z,
                       const fitting::VectorOf<Scalar>& bias_step,
                       const Scalar* first,
                       const Scalar* second) {
  const Index outputs = problem.shape.outputs;
  const bool sigmoid = problem.shape.output == OutputFunction::kSigmoid;
  const Scalar slope = static_cast<Scalar>(OutputSlope(problem.shape));
  const bool weighted = problem.weights.size() != 0;
  const Scalar* targets = problem.targets.data() + begin * outputs;
  const auto bend_of = [&](Index i, Scalar step, bool bends) {
    Scalar first_z = first[i] + step;
    Scalar second_z = second[i];
    if (bends) {  // z' = c z (1-z) o', z'' = c z (1-z) (o'' + c (1-2z) o'^2)
      const Scalar derivative = slope * (z[i] - z[i] * z[i]);
      second_z =
          derivative * (second_z + slope * (Scalar(1) - Scalar(2) * z[i]) *
                                       first_z * first_z);
      first_z *= derivative;
    }
    return static_cast<double>(first_z) * static_cast<double>(first_z) +
           static_cast<double>(z[i] - targets[i]) *
               static_cast<double>(second_z);
  };
  double sum = 0.0;
  if (sigmoid && IsPlain(problem)) {
    const Scalar step = bias_step[0];
    for (Index p = 0; p < columns; ++p) sum += bend_of(p, step, true);
    return sum;
  }
  for (Index p = 0; p < columns; ++p) {
    double bend = 0.0;
    for (Index j = 0; j < outputs; ++j) {
      bend += bend_of(p * outputs + j, bias_step[j], sigmoid);
    }
    sum += weighted ? bend * static_cast<double>(problem.weights[begin + p])
                    : bend;
  }
  return sum;
}

template <typename Scalar>
GradientSum<Scalar>::GradientSum(const NetProblem<Scalar>& problem)
    : problem_(problem),
      sum_(problem),
      delta_(problem.height, problem.strip),
      d_output_(problem.shape.outputs * problem.block) {}

template <typename Scalar>
void GradientSum<Scalar>::Clear() {
  sum_.w2.all().setZero();
  sum_.bias.setZero();
  is_empty_ = true;
}

template <typename Scalar>
void GradientSum<Scalar>::Add(Index begin,
                              Index columns,
                              const Scalar* y,
                              const Scalar* z,
                              const PackedWeights<Scalar>& weights) {
  OutputSlopes(problem_, begin, columns, z, d_output_.data());
  const Index outputs = problem_.shape.outputs;
  for (Index j = 0; j < outputs; ++j) {
    Scalar sum = sum_.bias[j];
    for (Index i = j; i < outputs * columns; i += outputs) sum += d_output_[i];
    sum_.bias[j] = sum;
  }
  problem_.ForEachStrip(begin, columns, [&](Index from, Index count) {
    problem_.kernels->backward(problem_.Size(count),
                               y + (from - begin) * problem_.height,
                               weights.w2.data(),
                               d_output_.data() + (from - begin) * outputs,
                               delta_.data(),
                               sum_.w2.data());
    problem_.kernels->add_products(problem_.Size(count),
                                   problem_.patterns.rows(),
                                   delta_.data(),
                                   problem_.patterns.col(from).data(),
                                   is_empty_,
                                   sum_.w1.data());
    is_empty_ = false;
  });
}

template <typename Scalar>
void GradientSum<Scalar>::Finish(const fitting::VectorOf<Scalar>& w,
                                 fitting::VectorOf<Scalar>* gradient) const {
  gradient->resize(w.size());
  sum_.UnpackAndAdd(problem_.shape, problem_.decay, w, gradient);
  if (!problem_.shape.free_biases) return;
  for (const auto& [first, count] : problem_.shape.biases()) {
    gradient->segment(first, count) -= problem_.decay * w.segment(first, count);
  }
}

template struct NetProblem<double>;
template struct NetProblem<float>;
template struct PackedWeights<double>;
template struct PackedWeights<float>;
template class GradientSum<double>;
template class GradientSum<float>;
template double Outputs(const NetProblem<double>&,
                        Index,
                        Index,
                        const fitting::VectorOf<double>&,
                        double*);
template double Outputs(const NetProblem<float>&,
                        Index,
                        Index,
                        const fitting::VectorOf<float>&,
                        float*);
template double OutputCurvature(const NetProblem<double>&,
                                Index,
                                Index,
                                const double*,
                                const fitting::VectorOf<double>&,
                                const double*,
                                const double*);
template double OutputCurvature(const NetProblem<float>&,
                                Index,
                                Index,
                                const float*,
                                const fitting::VectorOf<float>&,
                                const float*,
                                const float*);

}  // namespace errmap::models
