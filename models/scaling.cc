#include "models/scaling.h"

#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "stats/summary.h"

namespace errmap::models {
namespace {

// A spread of 0 maps to scale 1: the offset already maps the column to 0.
double InverseOf(double spread) { return spread > 0.0 ? 1.0 / spread : 1.0; }

template <typename Spread>
ColumnScaling ScaleColumns(const MatrixXd& values, Spread&& spread) {
  ColumnScaling scaling{VectorXd(values.cols()), VectorXd(values.cols())};
  for (Index j = 0; j < values.cols(); ++j) {
    const auto [offset, width] = spread(stats::Summarize(values.col(j)));
    scaling.offset[j] = offset;
    scaling.scale[j] = InverseOf(width);
  }
  return scaling;
}

}  // namespace

MatrixXd ColumnScaling::Apply(const MatrixXd& values) const {
  return (values.rowwise() - offset.transpose()) * scale.asDiagonal();
}

ColumnScaling IdentityScaling(Index num_columns) {
  return {VectorXd::Zero(num_columns), VectorXd::Ones(num_columns)};
}

ColumnScaling UnitRangeScaling(const MatrixXd& values) {
  return ScaleColumns(values, [](const stats::SampleSummary& column) {
    return std::pair(column.min, column.range);
  });
}

ColumnScaling StandardScaling(const MatrixXd& values) {
  return ScaleColumns(values, [](const stats::SampleSummary& column) {
    return std::pair(column.mean, column.n > 1 ? column.sd : 0.0);
  });
}

ColumnScaling RootMeanSquareScaling(const MatrixXd& values) {
  ColumnScaling scaling = IdentityScaling(values.cols());
  for (Index j = 0; j < values.cols(); ++j) {
    scaling.scale[j] = InverseOf(values.col(j).norm() /
                                 std::sqrt(static_cast<double>(values.rows())));
  }
  return scaling;
}

VectorXd SpreadsOfUnits(const MatrixXd& values,
                        const std::vector<std::string>& units) {
  const VectorXd variance = (values.rowwise() - values.colwise().mean().eval())
                                .colwise()
                                .squaredNorm()
                                .transpose() /
                            static_cast<double>(values.rows());
  std::map<std::string, std::pair<double, double>> of_unit;  // sum, count
  for (Index i = 0; i < variance.size(); ++i) {
    auto& [sum, count] = of_unit[units[static_cast<std::size_t>(i)]];
    sum += variance[i];
    count += 1.0;
  }
  VectorXd spreads(variance.size());
  for (Index i = 0; i < spreads.size(); ++i) {
    const auto& [sum, count] = of_unit[units[static_cast<std::size_t>(i)]];
    spreads[i] = sum > 0.0 ? std::sqrt(sum / count) : 1.0;
  }
  return spreads;
}

TargetScaling SigmoidTargetScaling(const Eigen::Ref<const MatrixXd>& targets) {
  constexpr double kLowest = 0.01;
  constexpr double kHighest = 0.99;
  const double highest = targets.maxCoeff();
  const double range = highest - targets.minCoeff();
  if (!(range > 0.0)) {
    throw std::invalid_argument(
        "the target does not vary in the training rows, so it cannot be "
        "scaled to a sigmoid's range");
  }
  const double slope = (kHighest - kLowest) / range;
  return {slope, kHighest - slope * highest};
}

}  // namespace errmap::models
