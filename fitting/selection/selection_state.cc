#include "fitting/selection/selection_state.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace errmap::fitting {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

}  // namespace

void ValidateSelection(const RegressionProblem& problem, const char* caller) {
  const auto& [terms, response, weights, intercept, observations] = problem;
  const Index rows = response.size();
  if (rows < 2 || terms.rows() != rows ||
      (weights.size() != 0 && weights.size() != rows) ||
      (intercept.size() != 0 && intercept.size() != rows)) {
    throw std::invalid_argument(std::string(caller) + ": candidates have " +
                                std::to_string(terms.rows()) +
                                " rows, response " + std::to_string(rows) +
                                ", weights " + std::to_string(weights.size()) +
                                "; at least 2 equal are needed");
  }
  if (!response.allFinite() || !weights.allFinite() ||
      (weights.size() != 0 && weights.minCoeff() < 0.0)) {
    throw std::invalid_argument(
        std::string(caller) +
        ": response and weights must be finite, weights not negative");
  }
}

SelectionState::SelectionState(const RegressionProblem& problem)
    : problem_(problem),
      response_(problem.Weighted(problem.response)),
      basis_(problem.response.size()),
      is_chosen_(At(problem.terms.cols()), false),
      is_fresh_(At(problem.terms.cols()), false),
      is_collinear_(At(problem.terms.cols()), false) {
  const Index rows = response_.size();
  const Index cols = problem.terms.cols();
  // A sum of n products errs by about sqrt(n) roundings; four times that.
  rounding_ = 4.0 * std::sqrt(static_cast<double>(rows)) * kEpsilon;
  const VectorXd intercept = problem.Weighted(problem.InterceptColumn());
  VectorXd ones_or_weights = VectorXd::Ones(rows);
  if (problem.weights.size() != 0) {
    roots_ = problem.weights.cwiseSqrt();
    ones_or_weights = problem.weights;
  }
  noise_ = kEpsilon * kEpsilon * problem.num_observations() *
           response_.squaredNorm();
  residual_ = response_;
  leverage_ = VectorXd::Zero(rows);
  rest_squared_ = problem.terms.cwiseAbs2().transpose() * ones_or_weights;
  length_ = rest_squared_.cwiseSqrt();
  rest_error_ = rounding_ * rest_squared_;
  product_ = Products(response_);
  product_error_ = rounding_ * response_.norm() * length_;
  SelectionMove entry;
  entry.direction = intercept;
  basis_.Append(intercept, VectorXd(0));
  entry.direction = basis_.Q().col(0);
  if (cols > 0 && !length_.allFinite()) {
    throw std::invalid_argument("selection: candidates must be finite");
  }
  entry.candidate = -1;
  Apply(entry);
}

VectorXd SelectionState::WeightedColumn(Index candidate) const {
  VectorXd column = problem_.terms.col(candidate);
  if (roots_.size() != 0) column = column.cwiseProduct(roots_);
  return column;
}

VectorXd SelectionState::Products(const VectorXd& direction) const {
  if (roots_.size() == 0) return problem_.terms.transpose() * direction;
  return problem_.terms.transpose() * direction.cwiseProduct(roots_);
}

bool SelectionState::IsCollinear(Index candidate) const {
  return is_collinear_[At(candidate)];
}

// Orthogonalises the candidate against the span again.
void SelectionState::Renew(Index candidate) {
  const VectorXd rest = basis_.Remainder(WeightedColumn(candidate));
  const double squared = rest.squaredNorm();
  rest_squared_[candidate] = squared;
  product_[candidate] = rest.dot(residual_);
  // The remainder itself is known to a few roundings of the column.
  const double error = 4.0 * kEpsilon * length_[candidate];
  rest_error_[candidate] = 2.0 * error * std::sqrt(squared) + error * error;
  product_error_[candidate] = error * residual_.norm();
  is_fresh_[At(candidate)] = true;
  const double least = kCollinear * length_[candidate];
  is_collinear_[At(candidate)] = !(squared > least * least);
}

SelectionMove SelectionState::BestEntry(const std::vector<bool>& open) {
  const Index cols = problem_.terms.cols();
  for (;;) {
    // The highest gain that rounding allows; what is fresh counts as exact.
    Index best = -1;
    double most = 0.0;
    for (Index j = 0; j < cols; ++j) {
      if (!open[At(j)] || is_chosen_[At(j)] || IsCollinear(j)) continue;
      double gain = 0.0;
      if (is_fresh_[At(j)]) {
        gain = product_[j] * product_[j] / rest_squared_[j];
      } else {
        const double product = std::abs(product_[j]) + product_error_[j];
        const double squared = rest_squared_[j] - rest_error_[j];
        const double least = kCollinear * length_[j];
        if (rest_squared_[j] + rest_error_[j] <= least * least) {
          is_collinear_[At(j)] = true;
          continue;
        }
        gain = squared > 0.0 ? product * product / squared
                             : std::numeric_limits<double>::infinity();
      }
      if (gain > most) {
        most = gain;
        best = j;
      }
    }
    if (best < 0) return {};
    if (is_fresh_[At(best)]) return EntryOf(best);
    Renew(best);
  }
}

SelectionMove SelectionState::EntryOf(Index candidate) {
  SelectionMove move;
  if (is_chosen_[At(candidate)]) return move;
  if (!is_fresh_[At(candidate)]) Renew(candidate);
  if (IsCollinear(candidate)) return move;
  move.candidate = candidate;
  move.enters = true;
  move.direction = basis_.Remainder(WeightedColumn(candidate)).normalized();
  const double along = move.direction.dot(residual_);
  move.gain = along * along;
  return move;
}

std::vector<SelectionMove> SelectionState::Exits(bool with_directions) const {
  // With W = R^-1 the coefficient b_j = W_j. (Q'y), and dropping the term
  // costs b_j^2 / |W_j.|^2 along the unit vector Q W_j.' / |W_j.|.
  const MatrixXd inverse = basis_.InverseTriangle();
  const VectorXd along = basis_.Q().transpose() * response_;
  std::vector<SelectionMove> exits(chosen_.size());
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    const auto row = inverse.row(static_cast<Index>(i) + 1);
    const double length = row.norm();
    const double coefficient = row.dot(along) / length;
    exits[i].candidate = chosen_[i];
    exits[i].enters = false;
    exits[i].gain = coefficient * coefficient;
    if (with_directions) {
      exits[i].direction = basis_.Q() * (row.transpose() / length);
    }
  }
  return exits;
}

SelectionMove SelectionState::ExitOf(Index candidate) const {
  const auto place = std::find(chosen_.begin(), chosen_.end(), candidate);
  assert(place != chosen_.end());
  const MatrixXd inverse = basis_.InverseTriangle();
  const auto row = inverse.row(place - chosen_.begin() + 1);
  SelectionMove move;
  move.candidate = candidate;
  move.enters = false;
  move.direction = basis_.Q() * (row.transpose() / row.norm());
  const double along = move.direction.dot(response_);
  move.gain = along * along;
  return move;
}

void SelectionState::Apply(const SelectionMove& move) {
  VectorXd direction = move.direction;
  const double sign = move.enters ? 1.0 : -1.0;
  if (move.candidate >= 0 && move.enters) {
    VectorXd along;
    const VectorXd rest =
        basis_.Remainder(WeightedColumn(move.candidate), &along);
    basis_.Append(rest, along);
    chosen_.push_back(move.candidate);
    is_chosen_[At(move.candidate)] = true;
  } else if (!move.enters) {
    const auto place =
        std::find(chosen_.begin(), chosen_.end(), move.candidate);
    assert(place != chosen_.end());
    direction = basis_.Remove(place - chosen_.begin() + 1);
    chosen_.erase(place);
    is_chosen_[At(move.candidate)] = false;
    // Columns that depended on the term may be independent of the rest.
    std::fill(is_collinear_.begin(), is_collinear_.end(), false);
  }
  const double along =
      move.enters ? direction.dot(residual_) : direction.dot(response_);
  residual_ -= sign * along * direction;
  leverage_ += sign * direction.cwiseAbs2();
  std::fill(is_fresh_.begin(), is_fresh_.end(), false);
  const Index cols = problem_.terms.cols();
  if (cols == 0) return;
  const VectorXd products = Products(direction);
  const double size = std::abs(along);
  for (Index j = 0; j < cols; ++j) {
    const double p = products[j];
    const double p_error = rounding_ * length_[j];
    rest_squared_[j] -= sign * p * p;
    rest_error_[j] += (2.0 * std::abs(p) + p_error) * p_error +
                      kEpsilon * std::abs(rest_squared_[j]);
    product_[j] -= sign * p * along;
    product_error_[j] +=
        p_error * size +
        (std::abs(p) * size + std::abs(product_[j])) * kEpsilon;
  }
  if (move.candidate >= 0 && !move.enters) Renew(move.candidate);
}

}  // namespace errmap::fitting
