#include "fitting/least_squares/penalized_regression.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/Dense>

#include "fitting/least_squares/orthogonal_basis.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Rows times sqrt(w / sum w), columns centred and scaled to unit length: then
// x_j' x_j is the weighted variance 1.
struct Standardised {
  explicit Standardised(const RegressionProblem& problem) {
    const Index rows = problem.response.size();
    VectorXd intercept = problem.intercept.size() != 0 ? problem.intercept
                                                       : VectorXd::Ones(rows);
    VectorXd roots = VectorXd::Ones(rows);
    if (problem.weights.size() != 0) roots = problem.weights.cwiseSqrt();
    intercept = intercept.cwiseProduct(roots);
    const double total = intercept.squaredNorm();
    roots /= std::sqrt(total);
    intercept /= std::sqrt(total);
    y = problem.response.cwiseProduct(roots);
    mean_y = intercept.dot(y);
    y -= mean_y * intercept;
    x = roots.asDiagonal() * problem.terms;
    means = x.transpose() * intercept;
    scales.setZero(x.cols());
    for (Index j = 0; j < x.cols(); ++j) {
      const double length = x.col(j).norm();
      x.col(j) -= means[j] * intercept;
      const double spread = x.col(j).norm();
      // What is left of a constant column is rounding.
      if (spread > static_cast<double>(rows) * kEpsilon * length) {
        scales[j] = 1.0 / spread;
      }
      x.col(j) *= scales[j];
    }
  }

  MatrixXd x;
  VectorXd y;
  VectorXd means;   // (k) of the columns as given
  VectorXd scales;  // (k) 1 / spread; 0 for constant columns
  double mean_y = 0.0;
};

class StandardisedPath : public PenalizedPath {
 public:
  double Intercept(const VectorXd& coefficients) const override {
    return mean_y_ - means_.dot(coefficients);
  }

 protected:
  explicit StandardisedPath(const Standardised& data)
      : means_(data.means), scales_(data.scales), mean_y_(data.mean_y) {}

  VectorXd means_;
  VectorXd scales_;
  double mean_y_;
};

class RidgePath final : public StandardisedPath {
 public:
  explicit RidgePath(const Standardised& data) : StandardisedPath(data) {
    constexpr unsigned kThin = Eigen::ComputeThinU | Eigen::ComputeThinV;
    // The singular values of the small triangle are those of the design.
    if (data.x.rows() > data.x.cols()) {
      const Index k = data.x.cols();
      const Eigen::HouseholderQR<MatrixXd> qr(data.x);
      const MatrixXd triangle =
          qr.matrixQR().topRows(k).triangularView<Eigen::Upper>();
      const VectorXd rotated = (qr.householderQ().transpose() * data.y).head(k);
      const Eigen::BDCSVD<MatrixXd> svd(triangle, kThin);
      Keep(svd.singularValues(),
           svd.matrixU().transpose() * rotated,
           svd.matrixV());
    } else {
      const Index n = data.x.rows();
      const Eigen::HouseholderQR<MatrixXd> qr(data.x.transpose());
      const MatrixXd triangle =
          qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
      // x = triangle' Q', so x's right vectors are Q times the triangle's left.
      const Eigen::BDCSVD<MatrixXd> svd(triangle, kThin);
      MatrixXd right = MatrixXd::Zero(data.x.cols(), n);
      right.topRows(n) = svd.matrixU();
      right = qr.householderQ() * right;
      Keep(svd.singularValues(),
           svd.matrixV().transpose() * data.y,
           std::move(right));
    }
  }

  VectorXd Coefficients(double strength) const override {
    const VectorXd shrunk = (along_.array() * singular_.array() /
                             (singular_.array().square() + strength))
                                .matrix();
    return scales_.asDiagonal() * (right_ * shrunk);
  }

  double largest_strength() const override {
    return std::max(singular_.size() > 0 ? singular_[0] * singular_[0] : 0.0,
                    std::numeric_limits<double>::min());
  }
  double smallest_strength() const override {
    constexpr double kShare = 1e-12;
    return kShare * largest_strength();
  }
  double DegreesOfFreedom(double strength) const override {
    return 1.0 + (singular_.array().square() /
                  (singular_.array().square() + strength))
                     .sum();
  }

 private:
  // Directions without length to rounding take no part.
  void Keep(const VectorXd& singular, const VectorXd& along, MatrixXd right) {
    const double tiny =
        singular.size() > 0
            ? kEpsilon * static_cast<double>(right.rows()) * singular[0]
            : 0.0;
    const Index kept = (singular.array() > tiny).count();
    singular_ = singular.head(kept);
    along_ = along.head(kept);
    right_ = right.leftCols(kept);
  }

  VectorXd singular_;
  VectorXd along_;  // U'y
  MatrixXd right_;
};

// The lasso's coefficients are piecewise linear in the strength. Between knots
// the active columns keep the same correlation with the residual, which falls.
class LassoPath final : public StandardisedPath {
 public:
  explicit LassoPath(const Standardised& data)
      : StandardisedPath(data), basis_(data.x.rows()) {
    Follow(data);
  }

  VectorXd Coefficients(double strength) const override {
    if (strength >= knots_.front().strength) {
      return VectorXd::Zero(scales_.size());
    }
    std::size_t after = 1;
    while (after < knots_.size() && knots_[after].strength > strength) ++after;
    if (after == knots_.size()) {
      return scales_.asDiagonal() * knots_.back().coefficients;
    }
    const Knot& from = knots_[after - 1];
    const Knot& to = knots_[after];
    const double share =
        (from.strength - strength) / (from.strength - to.strength);
    return scales_.asDiagonal() *
           ((1.0 - share) * from.coefficients + share * to.coefficients);
  }

  double largest_strength() const override { return knots_.front().strength; }
  double smallest_strength() const override {
    return std::max(knots_.back().strength,
                    kSmallestShare * knots_.front().strength);
  }
  double DegreesOfFreedom(double strength) const override {
    const VectorXd coefficients = Coefficients(strength);
    return 1.0 + static_cast<double>((coefficients.array() != 0.0).count());
  }

 private:
  struct Knot {
    double strength;
    VectorXd coefficients;  // (k) of the standardised columns
  };

  static constexpr double kSmallestShare = 1e-7;

  void Follow(const Standardised& data) {
    const Index m = data.x.cols();
    const Index most = std::min(m, data.x.rows() - 1);
    VectorXd coefficients = VectorXd::Zero(m);
    VectorXd correlation = data.x.transpose() * data.y;
    Index joining = -1;
    double strength = m > 0 ? correlation.cwiseAbs().maxCoeff(&joining) : 0.0;
    knots_.push_back({strength, coefficients});
    const double least = kSmallestShare * strength;
    is_out_.assign(static_cast<std::size_t>(m), true);
    Index dropped = -1;
    // A path may drop and take columns again; it has no known short bound.
    const Index most_knots = 20 * most + 20;
    for (Index knot = 0; knot < most_knots && strength > least; ++knot) {
      if (joining >= 0) Join(data, joining, correlation[joining]);
      if (active_.empty()) break;
      // w = (X_A'X_A)^-1 s, and u = X_A w has x_j'u = s_j for active j.
      const VectorXd step_in_q =
          basis_.R().transpose().triangularView<Eigen::Lower>().solve(Signs());
      const VectorXd step =
          basis_.R().triangularView<Eigen::Upper>().solve(step_in_q);
      const VectorXd direction = basis_.Q() * step_in_q;
      const VectorXd slope = data.x.transpose() * direction;
      double length = strength;
      joining = -1;
      Index leaving = -1;
      if (static_cast<Index>(active_.size()) < most) {
        for (Index j = 0; j < m; ++j) {
          if (!is_out_[static_cast<std::size_t>(j)] || j == dropped) continue;
          for (const double sign : {1.0, -1.0}) {
            const double closing = 1.0 - sign * slope[j];
            if (!(closing > kTiny)) continue;
            const double at =
                std::max(0.0, (strength - sign * correlation[j]) / closing);
            if (at < length) {
              length = at;
              joining = j;
            }
          }
        }
      }
      for (std::size_t i = 0; i < active_.size(); ++i) {
        const double at =
            -coefficients[active_[i]] / step[static_cast<Index>(i)];
        if (at > 0.0 && at < length) {
          length = at;
          leaving = static_cast<Index>(i);
          joining = -1;
        }
      }
      for (std::size_t i = 0; i < active_.size(); ++i) {
        coefficients[active_[i]] += length * step[static_cast<Index>(i)];
      }
      strength -= length;
      dropped = -1;
      if (leaving >= 0) {
        dropped = active_[static_cast<std::size_t>(leaving)];
        coefficients[dropped] = 0.0;
        Leave(leaving);
      }
      VectorXd residual = data.y;
      for (const Index j : active_) residual -= coefficients[j] * data.x.col(j);
      correlation = data.x.transpose() * residual;
      knots_.push_back({strength, coefficients});
      if (joining < 0 && leaving < 0) break;  // reached no penalty at all
    }
  }

  void Join(const Standardised& data, Index column, double correlation) {
    is_out_[static_cast<std::size_t>(column)] = false;
    VectorXd along;
    const VectorXd rest = basis_.Remainder(data.x.col(column), &along);
    constexpr double kCollinear = 1e-7;
    // A copy of the active columns adds nothing: it stays at 0.
    if (!(rest.norm() > kCollinear)) return;
    basis_.Append(rest, along);
    active_.push_back(column);
    signs_.push_back(correlation >= 0.0 ? 1.0 : -1.0);
  }

  void Leave(Index place) {
    const Index column = active_[static_cast<std::size_t>(place)];
    basis_.Remove(place);
    active_.erase(active_.begin() + place);
    signs_.erase(signs_.begin() + place);
    // Copies of what has left may come in again.
    for (std::size_t j = 0; j < is_out_.size(); ++j) is_out_[j] = true;
    for (const Index j : active_) is_out_[static_cast<std::size_t>(j)] = false;
    is_out_[static_cast<std::size_t>(column)] = true;
  }

  VectorXd Signs() const {
    return Eigen::Map<const VectorXd>(signs_.data(),
                                      static_cast<Index>(signs_.size()));
  }

  static constexpr double kTiny = 1e-12;

  OrthogonalBasis basis_;
  std::vector<Index> active_;
  std::vector<double> signs_;
  std::vector<bool> is_out_;  // may join
  std::vector<Knot> knots_;
};

std::vector<double> Grid(double largest, double smallest) {
  constexpr int kPerDecade = 8;
  std::vector<double> grid;
  if (!(largest > 0.0)) return {0.0};
  const double decades = std::log10(largest / smallest);
  const int count = 1 + static_cast<int>(std::ceil(decades * kPerDecade));
  for (int i = 0; i < count; ++i) {
    grid.push_back(largest *
                   std::pow(10.0, -static_cast<double>(i) / kPerDecade));
  }
  return grid;
}

void CrossValidate(const RegressionProblem& problem,
                   const FoldCodes& folds,
                   const PenalizedOptions& options,
                   PenalizedFit* fit) {
  const Index first = folds.first_judged();
  const Index num_folds = folds.count() - first;
  const std::size_t count = fit->strengths.size();
  MatrixXd errors(num_folds, static_cast<Index>(count));  // mean squares
  VectorXd shares(num_folds);                             // of the weights
  for (Index fold = 0; fold < num_folds; ++fold) {
    const auto [train, test] = folds.Split(first + fold);
    const auto pick = [](const VectorXd& values, const std::vector<Index>& at) {
      return values.size() == 0 ? VectorXd() : VectorXd(values(at));
    };
    const MatrixXd train_terms = problem.terms(train, Eigen::all);
    const MatrixXd test_terms = problem.terms(test, Eigen::all);
    const VectorXd train_response = pick(problem.response, train);
    const VectorXd train_weights = pick(problem.weights, train);
    const RegressionProblem part{train_terms,
                                 train_response,
                                 train_weights,
                                 pick(problem.intercept, train)};
    const auto path = MakePath(options.penalty, part);
    VectorXd weights = pick(problem.weights, test);
    if (weights.size() == 0) {
      weights = VectorXd::Ones(static_cast<Index>(test.size()));
    }
    VectorXd ones = pick(problem.intercept, test);
    if (ones.size() == 0) ones = VectorXd::Ones(weights.size());
    shares[fold] = weights.dot(ones.cwiseAbs2());
    for (std::size_t s = 0; s < count; ++s) {
      const VectorXd coefficients = path->Coefficients(fit->strengths[s]);
      const VectorXd residual = pick(problem.response, test) -
                                path->Intercept(coefficients) * ones -
                                test_terms * coefficients;
      errors(fold, static_cast<Index>(s)) =
          residual.cwiseAbs2().dot(weights) / shares[fold];
    }
  }
  shares /= shares.sum();
  for (std::size_t s = 0; s < count; ++s) {
    const auto column = errors.col(static_cast<Index>(s));
    const double mean = shares.dot(column);
    const double variance =
        shares.dot(VectorXd((column.array() - mean).square()));
    fit->mean_squared_errors.push_back(mean);
    fit->standard_errors.push_back(
        num_folds > 1 ? std::sqrt(variance / static_cast<double>(num_folds - 1))
                      : std::numeric_limits<double>::quiet_NaN());
  }
}

}  // namespace

std::unique_ptr<PenalizedPath> MakePath(Penalty penalty,
                                        const RegressionProblem& problem) {
  const Standardised data(problem);
  if (penalty == Penalty::kRidge) return std::make_unique<RidgePath>(data);
  return std::make_unique<LassoPath>(data);
}

void PenalizedOptions::Validate() const {
  if (!std::isnan(strength) && !(strength >= 0.0 && std::isfinite(strength))) {
    throw std::invalid_argument(
        "PenalizedOptions: strength must be at least 0, found " +
        std::to_string(strength));
  }
}

PenalizedFit FitPenalized(const RegressionProblem& problem,
                          const FoldCodes& folds,
                          const PenalizedOptions& options) {
  options.Validate();
  const Index rows = problem.response.size();
  if (rows < 2 || problem.terms.rows() != rows ||
      (problem.weights.size() != 0 && problem.weights.size() != rows)) {
    throw std::invalid_argument(
        "FitPenalized: terms have " + std::to_string(problem.terms.rows()) +
        " rows, response " + std::to_string(rows) + ", weights " +
        std::to_string(problem.weights.size()) + "; at least 2 are needed");
  }
  const auto path = MakePath(options.penalty, problem);
  PenalizedFit fit;
  fit.strength = options.strength;
  if (std::isnan(options.strength)) {
    if (static_cast<Index>(folds.codes.size()) != rows || folds.count() < 2) {
      throw std::invalid_argument(
          "FitPenalized: the penalty is chosen by cross-validation, which "
          "needs a fold for each row and at least 2 folds");
    }
    fit.strengths = Grid(path->largest_strength(), path->smallest_strength());
    CrossValidate(problem, folds, options, &fit);
    const auto least = std::min_element(fit.mean_squared_errors.begin(),
                                        fit.mean_squared_errors.end());
    std::size_t at =
        static_cast<std::size_t>(least - fit.mean_squared_errors.begin());
    if (options.one_standard_error && !std::isnan(fit.standard_errors[at])) {
      const double enough = *least + fit.standard_errors[at];
      at = 0;
      while (fit.mean_squared_errors[at] > enough) ++at;
    }
    fit.strength = fit.strengths[at];
  }
  fit.coefficients = path->Coefficients(fit.strength);
  fit.intercept = path->Intercept(fit.coefficients);
  fit.degrees_of_freedom = path->DegreesOfFreedom(fit.strength);
  VectorXd intercept =
      problem.intercept.size() != 0 ? problem.intercept : VectorXd::Ones(rows);
  const VectorXd residual = problem.response - fit.intercept * intercept -
                            problem.terms * fit.coefficients;
  fit.residual_sum_of_squares = problem.weights.size() != 0
                                    ? residual.cwiseAbs2().dot(problem.weights)
                                    : residual.squaredNorm();
  return fit;
}

}  // namespace errmap::fitting
