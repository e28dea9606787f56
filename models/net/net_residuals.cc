#include "models/net/net_residuals.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fitting/matrix_product.h"

namespace errmap::models {
namespace {

// sqrt(row weight / (P J)) of a pattern.
double RootShare(const NetProblem<double>& problem, Index pattern) {
  const double share =
      1.0 / static_cast<double>(problem.num_patterns() * problem.shape.outputs);
  return std::sqrt(
      problem.weights.size() != 0 ? share * problem.weights[pattern] : share);
}

// Hidden outputs y (height x columns) and outputs z (J x columns) of patterns.
void ForwardBlock(const NetProblem<double>& problem,
                  const PackedWeights<double>& weights,
                  Index begin,
                  Index columns,
                  double* y,
                  double* z) {
  problem.Activate(weights.w1, begin, columns, y);
  problem.kernels->forward(problem.Size(columns), y, weights.w2.data(), y, z);
  Outputs(problem, begin, columns, weights.bias, z);
}

void FillResiduals(const NetProblem<double>& problem,
                   Index begin,
                   Index columns,
                   const double* z,
                   VectorXd* residuals) {
  const Index outputs = problem.shape.outputs;
  for (Index p = 0; p < columns; ++p) {
    const double root = RootShare(problem, begin + p);
    for (Index j = 0; j < outputs; ++j) {
      (*residuals)[j * problem.num_patterns() + begin + p] =
          root * (problem.targets(j, begin + p) - z[p * outputs + j]);
    }
  }
}

// The factors of J at a weight vector; names as in the header.
class NetFactors {
 public:
  explicit NetFactors(const NetProblem<double>& problem)
      : problem_(problem),
        inputs_(problem.patterns.transpose()),
        weights_(problem),
        hidden_(problem.height, problem.num_patterns()),
        outputs_(problem.shape.outputs, problem.num_patterns()),
        ones_and_hidden_(problem.num_patterns(), problem.shape.hidden + 1),
        first_(static_cast<std::size_t>(problem.shape.outputs)),
        second_(first_.size()) {
    ones_and_hidden_.col(problem.shape.hidden).setOnes();
  }

  void MoveTo(const VectorXd& w, VectorXd* residuals) {
    const NetShape& shape = problem_.shape;
    const Index patterns = problem_.num_patterns();
    weights_.Pack(shape, w);
    for (Index begin = 0; begin < patterns; begin += problem_.block) {
      const Index columns = std::min(problem_.block, patterns - begin);
      ForwardBlock(problem_,
                   weights_,
                   begin,
                   columns,
                   hidden_.column(begin),
                   outputs_.column(begin));
    }
    residuals->resize(patterns * shape.outputs);
    FillResiduals(problem_, 0, patterns, outputs_.data(), residuals);

    auto y = ones_and_hidden_.leftCols(shape.hidden);
    y = hidden_.all().topRows(shape.hidden).transpose();
    const bool sigmoid = shape.output == OutputFunction::kSigmoid;
    const double slope = OutputSlope(shape);
    VectorXd k(patterns);
    for (Index j = 0; j < shape.outputs; ++j) {
      for (Index p = 0; p < patterns; ++p) {
        const double z = *(outputs_.column(p) + j);
        k[p] = -RootShare(problem_, p) * (sigmoid ? slope * (z - z * z) : 1.0);
      }
      MatrixXd& second = second_[static_cast<std::size_t>(j)];
      MatrixXd& first = first_[static_cast<std::size_t>(j)];
      second = k.asDiagonal() * ones_and_hidden_;
      first.resize(patterns, shape.hidden);
      for (Index h = 0; h < shape.hidden; ++h) {
        first.col(h).array() = *(weights_.w2.column(j) + h) *
                               second.col(h).array() * (1.0 - y.col(h).array());
      }
    }
  }

  const MatrixXd& inputs() const { return inputs_; }
  const MatrixXd& first(Index j) const {
    return first_[static_cast<std::size_t>(j)];
  }
  const MatrixXd& second(Index j) const {
    return second_[static_cast<std::size_t>(j)];
  }

 private:
  const NetProblem<double>& problem_;
  const MatrixXd inputs_;  // X' (P x (I+1))
  PackedWeights<double> weights_;
  AlignedMatrix<double> hidden_;
  AlignedMatrix<double> outputs_;
  MatrixXd ones_and_hidden_;      // [y' 1]
  std::vector<MatrixXd> first_;   // A_j
  std::vector<MatrixXd> second_;  // B_j
};

class NetLinearization final : public fitting::Linearization {
 public:
  NetLinearization(const NetProblem<double>& problem,
                   std::shared_ptr<const MatrixXd> inner_products)
      : problem_(problem),
        inner_products_(std::move(inner_products)),
        factors_(problem) {}

  void MoveTo(const VectorXd& w, VectorXd* residuals, MatrixXd* gram) override {
    factors_.MoveTo(w, residuals);
    const Index patterns = problem_.num_patterns();
    const Index outputs = problem_.shape.outputs;
    gram->resize(patterns * outputs, patterns * outputs);
    for (Index l = 0; l < outputs; ++l) {
      auto diagonal =
          gram->block(l * patterns, l * patterns, patterns, patterns);
      fitting::MultiplyByOwnTranspose(factors_.first(l), diagonal);
      for (Index q = 0; q < patterns; ++q) {
        diagonal.col(q).tail(patterns - q).array() *=
            inner_products_->col(q).tail(patterns - q).array();
      }
      fitting::MultiplyByOwnTranspose(factors_.second(l), diagonal, true);
      for (Index j = l + 1; j < outputs; ++j) {
        auto block =
            gram->block(j * patterns, l * patterns, patterns, patterns);
        fitting::MultiplyTransposed(
            factors_.first(j), factors_.first(l), block);
        block.array() *= inner_products_->array();
      }
    }
  }

  VectorXd Apply(const VectorXd& v) const override {
    const NetShape& shape = problem_.shape;
    const Index patterns = problem_.num_patterns();
    const Eigen::Map<const MatrixXd> v1(
        v.data(), shape.hidden, shape.inputs + 1);
    const Eigen::Map<const MatrixXd> v2(
        v.data() + shape.num_weights1(), shape.outputs, shape.hidden + 1);
    MatrixXd along(patterns, shape.hidden);
    fitting::MultiplyTransposed(factors_.inputs(), v1, along);
    VectorXd product(patterns * shape.outputs);
    for (Index j = 0; j < shape.outputs; ++j) {
      product.segment(j * patterns, patterns) =
          factors_.first(j).cwiseProduct(along).rowwise().sum() +
          factors_.second(j) * v2.row(j).transpose();
    }
    return product;
  }

  VectorXd ApplyTransposed(const VectorXd& u) const override {
    const NetShape& shape = problem_.shape;
    const Index patterns = problem_.num_patterns();
    VectorXd product(shape.num_weights());
    Eigen::Map<MatrixXd> to1(product.data(), shape.hidden, shape.inputs + 1);
    Eigen::Map<MatrixXd> to2(
        product.data() + shape.num_weights1(), shape.outputs, shape.hidden + 1);
    MatrixXd delta = MatrixXd::Zero(shape.hidden, patterns);
    for (Index j = 0; j < shape.outputs; ++j) {
      const auto part = u.segment(j * patterns, patterns);
      delta += factors_.first(j).transpose() * part.asDiagonal();
      to2.row(j) = part.transpose() * factors_.second(j);
    }
    fitting::Multiply(delta, factors_.inputs(), to1);
    return product;
  }

 private:
  const NetProblem<double>& problem_;
  std::shared_ptr<const MatrixXd> inner_products_;
  NetFactors factors_;
};

}  // namespace

NetResiduals::NetResiduals(const NetProblem<double>& problem)
    : problem_(problem),
      weights_(problem),
      hidden_(problem.height, problem.block),
      outputs_(problem.shape.outputs, problem.block) {}

void NetResiduals::Evaluate(const VectorXd& w,
                            VectorXd* residuals,
                            MatrixXd* jacobian) const {
  const NetShape& shape = problem_.shape;
  const Index patterns = problem_.num_patterns();
  if (jacobian == nullptr) {
    weights_.Pack(shape, w);
    residuals->resize(num_residuals());
    for (Index begin = 0; begin < patterns; begin += problem_.block) {
      const Index columns = std::min(problem_.block, patterns - begin);
      ForwardBlock(
          problem_, weights_, begin, columns, hidden_.data(), outputs_.data());
      FillResiduals(problem_, begin, columns, outputs_.data(), residuals);
    }
    return;
  }
  NetFactors factors(problem_);
  factors.MoveTo(w, residuals);
  jacobian->setZero(num_residuals(), shape.num_weights());
  for (Index j = 0; j < shape.outputs; ++j) {
    auto rows = jacobian->middleRows(j * patterns, patterns);
    for (Index i = 0; i <= shape.inputs; ++i) {
      rows.middleCols(i * shape.hidden, shape.hidden) =
          factors.inputs().col(i).asDiagonal() * factors.first(j);
    }
    for (Index h = 0; h <= shape.hidden; ++h) {
      rows.col(shape.num_weights1() + h * shape.outputs + j) =
          factors.second(j).col(h);
    }
  }
}

std::unique_ptr<fitting::Linearization> NetResiduals::NewLinearization() const {
  if (inner_products_ == nullptr) {
    const MatrixXd inputs = problem_.patterns.transpose();
    MatrixXd products(inputs.rows(), inputs.rows());
    // Whole: pairs of different outputs need both triangles.
    fitting::MultiplyTransposed(inputs, inputs, products);
    inner_products_ = std::make_shared<const MatrixXd>(std::move(products));
  }
  return std::make_unique<NetLinearization>(problem_, inner_products_);
}

}  // namespace errmap::models
