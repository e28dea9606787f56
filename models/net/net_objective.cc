#include "models/net/net_objective.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "models/net/net_path.h"
#include "models/net/net_residuals.h"

namespace errmap::models {
namespace {

// Data of a block stay in the second-level cache, those of a strip in the
// first-level one: its patterns and a hidden quantity.
constexpr Index kBlockBytes = Index{128} << 10;
constexpr Index kStripBytes = Index{48} << 10;

// Sums of the 1995 program's arithmetic go over more patterns at a time.
constexpr Index kPlainBlockBytes = Index{256} << 10;

// Patterns of height + inner numbers that `bytes` hold: a multiple of every
// product's tile.
template <typename Scalar>
Index PatternsWithin(Index bytes, Index height, Index inner) {
  constexpr Index kTile = 12;
  const Index tiles =
      bytes / ((height + inner) * static_cast<Index>(sizeof(Scalar))) / kTile;
  return std::max(tiles, Index{1}) * kTile;
}

template <typename Scalar>
void SetBlockAndStrip(NetArithmetic arithmetic, NetProblem<Scalar>* problem) {
  constexpr Index kFewest = 16;
  constexpr auto kBytes = static_cast<Index>(sizeof(Scalar));
  // In whole vectors: sums over blocks have the order that they had when
  // heights were padded to these.
  constexpr Index kLanes = kVectorBytes / kBytes;
  const Index height = (problem->shape.hidden + kLanes - 1) / kLanes * kLanes;
  const Index inner = problem->patterns.rows();
  const Index patterns = problem->num_patterns();
  if (arithmetic == NetArithmetic::kPlain) {
    problem->block = std::max(kFewest, kPlainBlockBytes / (height * kBytes));
    problem->strip = problem->block;
  } else {
    problem->block = PatternsWithin<Scalar>(kBlockBytes, height, inner);
    // The sums that a strip adds to are read and written anew for each.
    constexpr Index kFewestInStrip = 60;
    problem->strip =
        std::max(kFewestInStrip,
                 PatternsWithin<Scalar>(kStripBytes, problem->height, inner));
  }
  problem->block = std::min(problem->block, patterns);
  problem->strip = std::min(problem->strip, problem->block);
}

template <typename Scalar>
NetProblem<Scalar> MakeProblem(const NetShape& shape,
                               const MatrixXd& inputs,
                               const MatrixXd& targets,
                               double wfactor,
                               const VectorXd& weights,
                               NetArithmetic arithmetic) {
  const auto refuse = [](const std::string& why) {
    throw std::invalid_argument("NetObjective: " + why);
  };
  const Index num_patterns = inputs.rows();
  if (shape.inputs < 1 || shape.hidden < 1 || shape.outputs < 1) {
    refuse("a net needs at least one node in every layer");
  }
  if (!(shape.slope > 0.0)) {
    refuse("the slope must be above 0, found " + std::to_string(shape.slope));
  }
  if (num_patterns < 1 || inputs.cols() != shape.inputs ||
      targets.rows() != num_patterns || targets.cols() != shape.outputs ||
      (weights.size() != 0 && weights.size() != num_patterns)) {
    refuse("inputs, targets, weights and nodes do not agree in size");
  }
  if (!inputs.allFinite() || !targets.allFinite() || !weights.allFinite()) {
    refuse("inputs, targets and weights must be finite");
  }
  if (!(wfactor >= 0.0)) {
    refuse("wfactor must be at least 0, found " + std::to_string(wfactor));
  }
  NetProblem<Scalar> problem;
  problem.shape = shape;
  problem.patterns.resize(shape.inputs + 1, num_patterns);
  problem.patterns.topRows(shape.inputs) =
      (shape.slope * inputs.transpose()).template cast<Scalar>();
  problem.patterns.row(shape.inputs)
      .setConstant(static_cast<Scalar>(shape.slope));
  problem.targets = targets.transpose().template cast<Scalar>();
  if (weights.size() != 0) {
    problem.weights = (weights / weights.mean()).template cast<Scalar>();
  }
  problem.decay =
      static_cast<Scalar>(wfactor / static_cast<double>(shape.num_weights()));
  problem.height = PaddedHeight<Scalar>(shape.hidden);
  SetBlockAndStrip(arithmetic, &problem);
  problem.kernels = arithmetic == NetArithmetic::kPlain
                        ? &PlainNetKernels<Scalar>()
                        : &FastestNetKernels<Scalar>();
  return problem;
}

}  // namespace

template <typename Scalar>
struct BasicNetObjective<Scalar>::Scratch {
  explicit Scratch(const NetProblem<Scalar>& problem)
      : weights(problem),
        hidden(problem.height, problem.block),
        outputs(problem.shape.outputs, problem.block),
        gradient(problem) {}

  PackedWeights<Scalar> weights;
  AlignedMatrix<Scalar> hidden;   // y_h, Eq. 16
  AlignedMatrix<Scalar> outputs;  // z_j, Eq. 17
  GradientSum<Scalar> gradient;
};

template <typename Scalar>
void BasicNetObjective<Scalar>::FreeScratch::operator()(
    Scratch* scratch) const {
  delete scratch;
}

template <typename Scalar>
BasicNetObjective<Scalar>::BasicNetObjective(const NetShape& shape,
                                             const MatrixXd& inputs,
                                             const MatrixXd& targets,
                                             double wfactor,
                                             const VectorXd& weights,
                                             NetArithmetic arithmetic)
    : problem_(MakeProblem<Scalar>(
          shape, inputs, targets, wfactor, weights, arithmetic)),
      scratch_(new Scratch(problem_)) {}

template <typename Scalar>
Scalar BasicNetObjective<Scalar>::Evaluate(const Vector& w,
                                           Vector* gradient) const {
  Scratch& scratch = *scratch_;
  scratch.weights.Pack(problem_.shape, w);
  scratch.gradient.Clear();
  double sum = 0.0;
  const Index num_patterns = problem_.num_patterns();
  for (Index begin = 0; begin < num_patterns; begin += problem_.block) {
    const Index columns = std::min(problem_.block, num_patterns - begin);
    problem_.Activate(
        scratch.weights.w1, begin, columns, scratch.hidden.data());
    problem_.kernels->forward(problem_.Size(columns),
                              scratch.hidden.data(),
                              scratch.weights.w2.data(),
                              scratch.hidden.data(),
                              scratch.outputs.data());
    sum += Outputs(
        problem_, begin, columns, scratch.weights.bias, scratch.outputs.data());
    if (gradient != nullptr) {
      scratch.gradient.Add(begin,
                           columns,
                           scratch.hidden.data(),
                           scratch.outputs.data(),
                           scratch.weights);
    }
  }
  if (gradient != nullptr) scratch.gradient.Finish(w, gradient);
  return static_cast<Scalar>(Cost(
      problem_, sum, DecayingProduct(problem_.shape, w, w, w.squaredNorm())));
}

template <typename Scalar>
std::unique_ptr<fitting::Path<Scalar>> BasicNetObjective<Scalar>::NewPath(
    const Vector& w) const {
  return std::make_unique<NetPath<Scalar>>(problem_, w);
}

template <typename Scalar>
const fitting::ResidualFunction* BasicNetObjective<Scalar>::residuals() const {
  if constexpr (std::is_same_v<Scalar, double>) {
    if (residuals_ == nullptr && !problem_.shape.free_biases) {
      residuals_ = std::make_unique<NetResiduals>(problem_);
    }
  }
  return residuals_.get();
}

template class BasicNetObjective<double>;
template class BasicNetObjective<float>;

}  // namespace errmap::models
