#include "stats/comparison/unit_losses.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "stats/indices.h"

namespace errmap::stats {
namespace {

[[noreturn]] void Refuse(const std::string& why) {
  throw std::invalid_argument("UnitLosses: " + why);
}

std::string At(const std::string& first,
               Index i,
               const std::string& second,
               Index j) {
  return first + " " + std::to_string(i) + ", " + second + " " +
         std::to_string(j);
}

}  // namespace

void UnitLosses::Validate() const {
  if (rows.size() != num_units()) {
    Refuse(std::to_string(rows.size()) + " numbers of rows for " +
           std::to_string(num_units()) + " units");
  }
  if (means.size() > 0 &&
      (means.rows() != num_units() || means.cols() != num_models())) {
    Refuse("means of " + std::to_string(means.rows()) + " x " +
           std::to_string(means.cols()) + " for mean squares of " +
           std::to_string(num_units()) + " x " + std::to_string(num_models()));
  }
  for (Index unit = 0; unit < num_units(); ++unit) {
    constexpr double kMost = std::numeric_limits<double>::max();
    if (!(rows[unit] > 0.0 && rows[unit] <= kMost)) {
      Refuse("unit " + std::to_string(unit) + " has " +
             std::to_string(rows[unit]) + " rows, must be above 0");
    }
    for (Index model = 0; model < num_models(); ++model) {
      const double loss = mean_squares(unit, model);
      if (!(loss >= 0.0 && loss <= kMost)) {
        Refuse(At("unit", unit, "model", model) + ": mean square " +
               std::to_string(loss) + ", must be finite and at least 0");
      }
    }
  }
}

MatrixXd UnitLosses::Differences(const std::vector<Index>& first,
                                 const std::vector<Index>& second) const {
  if (num_units() == 0) return MatrixXd(0, std::ssize(first));
  const VectorXd share = rows / rows.mean();
  return share.asDiagonal() *
         (mean_squares(Eigen::all, first) - mean_squares(Eigen::all, second));
}

UnitLosses GatherByUnit(const MatrixXd& residuals,
                        const std::vector<Index>& unit_codes) {
  if (std::ssize(unit_codes) != residuals.rows()) {
    throw std::invalid_argument(
        "GatherByUnit: " + std::to_string(unit_codes.size()) +
        " unit codes for " + std::to_string(residuals.rows()) + " rows");
  }
  for (const Index code : unit_codes) {
    if (code < 0) {
      throw std::invalid_argument("GatherByUnit: negative unit code " +
                                  std::to_string(code));
    }
  }
  std::vector<Index> unit_of = unit_codes;
  const Index units = Renumber(&unit_of);
  UnitLosses losses;
  losses.rows = VectorXd::Zero(units);
  losses.mean_squares = MatrixXd::Zero(units, residuals.cols());
  losses.means = losses.mean_squares;
  for (Index row = 0; row < residuals.rows(); ++row) {
    if (!residuals.row(row).allFinite()) {
      throw std::invalid_argument("GatherByUnit: row " + std::to_string(row) +
                                  " has a residual that is not finite");
    }
    const Index unit = unit_of[static_cast<std::size_t>(row)];
    losses.rows[unit] += 1.0;
    losses.mean_squares.row(unit) += residuals.row(row).cwiseAbs2();
    losses.means.row(unit) += residuals.row(row);
  }
  losses.mean_squares.array().colwise() /= losses.rows.array();
  losses.means.array().colwise() /= losses.rows.array();
  return losses;
}

std::vector<Index> BlocksInOrder(Index num_rows) {
  constexpr Index kMostBlocks = 20;
  constexpr Index kRowsPerBlock = 5;
  const Index blocks =
      std::clamp<Index>(num_rows / kRowsPerBlock, 1, kMostBlocks);
  std::vector<Index> codes;
  for (Index block = 0; block < blocks; ++block) {
    const Index length =
        num_rows / blocks + (block < num_rows % blocks ? 1 : 0);
    codes.insert(codes.end(), static_cast<std::size_t>(length), block);
  }
  return codes;
}

VectorXd PooledRmse(const UnitLosses& losses) {
  return ((losses.mean_squares.transpose() * losses.rows) / losses.rows.sum())
      .cwiseSqrt();
}

MatrixXd InfluenceOnRmse(const UnitLosses& losses, const VectorXd& rmse) {
  MatrixXd influence = MatrixXd::Zero(losses.num_units(), losses.num_models());
  const VectorXd share = losses.rows / losses.rows.mean();
  for (Index model = 0; model < losses.num_models(); ++model) {
    const double r = rmse[model];
    if (r == 0.0) continue;  // every loss is 0
    influence.col(model) = share.array() *
                           (losses.mean_squares.col(model).array() - r * r) /
                           (2.0 * r);
  }
  return influence;
}

}  // namespace errmap::stats
