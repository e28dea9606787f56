#include "fitting/stepwise_selection.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Candidates and response with all that the chosen terms explain taken out.
class Sweep {
 public:
  Sweep(const MatrixXd& candidates,
        const VectorXd& response,
        const VectorXd& weights,
        double collinearity)
      : candidates_(candidates),
        response_(response),
        open_(static_cast<std::size_t>(candidates.cols()), true) {
    VectorXd intercept = VectorXd::Ones(response.size());
    if (weights.size() != 0) {
      intercept = weights.cwiseSqrt();
      candidates_ = intercept.asDiagonal() * candidates_;
      response_ = response_.cwiseProduct(intercept);
    }
    least_ = collinearity * collinearity *
             candidates_.colwise().squaredNorm().transpose();
    TakeOut(intercept.normalized());
  }

  double residual_sum_of_squares() const { return response_.squaredNorm(); }

  // The open candidate that explains most of what is left, or -1.
  Index Best() const {
    Index best = -1;
    double most = 0.0;
    for (Index j = 0; j < candidates_.cols(); ++j) {
      if (!open_[static_cast<std::size_t>(j)]) continue;
      const double length = candidates_.col(j).squaredNorm();
      if (!(length > least_[j])) continue;
      const double projection = candidates_.col(j).dot(response_);
      const double explained = projection * projection / length;
      if (explained > most) {
        most = explained;
        best = j;
      }
    }
    return best;
  }

  void Enter(Index column) {
    open_[static_cast<std::size_t>(column)] = false;
    TakeOut(candidates_.col(column).normalized());
  }

 private:
  void TakeOut(const VectorXd& direction) {
    for (Index j = 0; j < candidates_.cols(); ++j) {
      if (!open_[static_cast<std::size_t>(j)]) continue;
      candidates_.col(j) -= direction.dot(candidates_.col(j)) * direction;
    }
    response_ -= direction.dot(response_) * direction;
  }

  MatrixXd candidates_;
  VectorXd response_;
  VectorXd least_;  // squared lengths below which a candidate is collinear
  std::vector<bool> open_;
};

}  // namespace

void ForwardSelectionOptions::Validate() const {
  if (!(collinearity > 0.0 && collinearity < 1.0)) {
    throw std::invalid_argument(
        "ForwardSelectionOptions: collinearity must be above 0 and below 1, "
        "found " +
        std::to_string(collinearity));
  }
}

SelectionResult SelectForward(const MatrixXd& candidates,
                              const VectorXd& response,
                              const VectorXd& weights,
                              const ForwardSelectionOptions& options) {
  options.Validate();
  const Index rows = response.size();
  if (rows < 2 || candidates.rows() != rows ||
      (weights.size() != 0 && weights.size() != rows)) {
    throw std::invalid_argument(
        "SelectForward: candidates have " + std::to_string(candidates.rows()) +
        " rows, response " + std::to_string(rows) + ", weights " +
        std::to_string(weights.size()) + "; at least 2 equal are needed");
  }
  const double n = static_cast<double>(rows);
  const auto bic = [n](double rss, std::size_t terms) {
    return n * std::log(rss / n) + static_cast<double>(terms + 1) * std::log(n);
  };
  Sweep sweep(candidates, response, weights, options.collinearity);
  // Below this the rest is rounding, and more terms would fit nothing else.
  constexpr double kRounding = std::numeric_limits<double>::epsilon();
  const double noise =
      kRounding * kRounding * n *
      (weights.size() == 0 ? response.squaredNorm()
                           : response.cwiseAbs2().dot(weights));
  SelectionResult result;
  double rss = sweep.residual_sum_of_squares();
  result.steps.push_back({-1, rss, bic(rss, 0)});
  const Index most_terms =
      options.max_terms < 0 ? rows - 2 : std::min(options.max_terms, rows - 2);
  while (static_cast<Index>(result.chosen.size()) < most_terms && rss > noise) {
    const Index best = sweep.Best();
    if (best < 0) break;
    sweep.Enter(best);
    rss = sweep.residual_sum_of_squares();
    const double next = bic(rss, result.chosen.size() + 1);
    if (!(next < result.steps.back().bic)) break;
    result.chosen.push_back(best);
    result.steps.push_back({best, rss, next});
  }
  return result;
}

}  // namespace errmap::fitting
