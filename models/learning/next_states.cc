#include "models/learning/next_states.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fitting/least_squares/decompositions.h"
#include "models/error_model.h"
#include "models/history/view.h"

namespace errmap::models {
namespace {

// Whitened inputs of measured rows and candidates, by the measured ones.
struct Whitened {
  MatrixXd measured;
  MatrixXd candidates;
};

Whitened Whiten(const MatrixXd& measured, const MatrixXd& candidates) {
  if (measured.cols() == 0) return {measured, candidates};
  constexpr double kLeastShare = 1e-3;
  constexpr Index kMostStateDirections = 6;
  const Eigen::RowVectorXd mean = measured.colwise().mean();
  const MatrixXd centred = measured.rowwise() - mean;
  const MatrixXd covariance =
      centred.transpose() * centred / static_cast<double>(measured.rows());
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(covariance);
  const VectorXd& values = eigen.eigenvalues();
  Index count = 0;
  while (count < std::min(kMostStateDirections, values.size()) &&
         values[values.size() - 1 - count] >
             kLeastShare * std::max(values.maxCoeff(), 1e-12)) {
    ++count;
  }
  const MatrixXd to_scores =
      eigen.eigenvectors().rightCols(count) *
      values.tail(count).cwiseSqrt().cwiseInverse().asDiagonal();
  return {centred * to_scores, (candidates.rowwise() - mean) * to_scores};
}

MatrixXd Features(const VectorXd& position, const MatrixXd& scores) {
  const Index q = scores.cols();
  MatrixXd features(scores.rows(), 3 + 2 * q);
  features.col(0).setOnes();
  features.col(1) = position;
  features.col(2) = position.cwiseAbs2();
  features.middleCols(3, q) = scores;
  features.rightCols(q) = scores.array().colwise() * position.array();
  return features;
}

double MeanVariance(const MatrixXd& information, const MatrixXd& products) {
  return information.ldlt().solve(products).trace();
}

}  // namespace

std::vector<NextState> ChooseNext(const data::Dataset& measured,
                                  const MatrixXd& candidates,
                                  Index most) {
  constexpr double kRowsPerCandidate = 10.0;
  if (candidates.cols() != measured.num_inputs()) {
    throw std::invalid_argument("ChooseNext: the candidates have other inputs");
  }
  std::vector<Index> others;
  const Index position = FindPosition(measured, "");
  for (Index i = 0; i < measured.num_inputs(); ++i) {
    if (!data::IsPosition(measured.inputs()[static_cast<std::size_t>(i)])) {
      others.push_back(i);
    }
  }
  const MatrixXd& inputs = measured.input_values();
  const Whitened scores =
      Whiten(inputs(Eigen::all, others), candidates(Eigen::all, others));
  VectorXd x = VectorXd::Zero(inputs.rows());
  VectorXd at = VectorXd::Zero(candidates.rows());
  if (position >= 0) {
    const double middle = inputs.col(position).mean();
    const double reach = std::max(
        (inputs.col(position).array() - middle).abs().maxCoeff(), 1e-12);
    x = (inputs.col(position).array() - middle) / reach;
    at = (candidates.col(position).array() - middle) / reach;
  }
  const MatrixXd rows = Features(x, scores.measured);
  const MatrixXd wanted = Features(at, scores.candidates);
  // Of all rows, where the map is to predict.
  const MatrixXd products =
      (rows.transpose() * rows + wanted.transpose() * wanted) /
      static_cast<double>(rows.rows() + wanted.rows());
  MatrixXd information = rows.transpose() * rows;
  information.diagonal().array() += 1e-6 * static_cast<double>(rows.rows());
  const double before = MeanVariance(information, products);
  const MatrixXd all_wanted = wanted.transpose();
  std::vector<NextState> chosen;
  std::vector<bool> is_chosen(static_cast<std::size_t>(wanted.rows()));
  while (std::ssize(chosen) < std::min(most, candidates.rows())) {
    // Adding r rows phi to M lowers trace(M^-1 P) by
    // r phi' M^-1 P M^-1 phi / (1 + r phi' M^-1 phi) (Sherman-Morrison).
    const MatrixXd solved = information.ldlt().solve(all_wanted);
    Index best = -1;
    double most_gained = -1.0;
    for (Index i = 0; i < wanted.rows(); ++i) {
      if (is_chosen[static_cast<std::size_t>(i)]) continue;
      const VectorXd u = solved.col(i);
      const double gained = kRowsPerCandidate * u.dot(products * u) /
                            (1.0 + kRowsPerCandidate * wanted.row(i).dot(u));
      if (!std::isfinite(gained)) {
        throw std::invalid_argument(
            "ChooseNext: a candidate lies too far from the measured rows");
      }
      if (gained > most_gained) {
        most_gained = gained;
        best = i;
      }
    }
    information +=
        kRowsPerCandidate * wanted.row(best).transpose() * wanted.row(best);
    is_chosen[static_cast<std::size_t>(best)] = true;
    const VectorXd distances =
        (scores.measured.rowwise() - scores.candidates.row(best))
            .rowwise()
            .norm();
    chosen.push_back(
        {.row = best,
         .variance_left = MeanVariance(information, products) / before,
         .distance = distances.minCoeff()});
  }
  return chosen;
}

}  // namespace errmap::models
