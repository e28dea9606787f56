#include "fitting/selection/best_subset.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "fitting/interruption.h"
#include "fitting/least_squares/decompositions.h"
#include "fitting/least_squares/orthogonal_basis.h"
#include "stats/indices.h"

namespace errmap::fitting {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Reordering pays if a branch still has many leaves.
constexpr Index kFreeColumnsWorthSorting = 6;

// A triangle (k+1) x (k+1) of k columns and the response, of which the first
// `fixed` columns stay in every subset of the branch.
struct Node {
  std::vector<Index> columns;
  MatrixXd triangle;
  Index fixed = 0;
};

// Takes column `place` out of the triangle.
MatrixXd WithoutColumn(const MatrixXd& triangle, Index place) {
  const Index size = triangle.cols();
  MatrixXd less(size, size - 1);
  less.leftCols(place) = triangle.leftCols(place);
  less.rightCols(size - 1 - place) = triangle.rightCols(size - 1 - place);
  for (Index j = place; j + 1 < size; ++j) {
    Eigen::JacobiRotation<double> rotation;
    double length = 0.0;
    rotation.makeGivens(less(j, j), less(j + 1, j), &length);
    less.rightCols(size - 1 - j)
        .middleRows(j, 2)
        .applyOnTheLeft(0, 1, rotation.adjoint());
    less(j, j) = length;
    less(j + 1, j) = 0.0;
  }
  return less.topRows(size - 1);
}

// The triangle of the same columns in another order.
MatrixXd Reordered(const MatrixXd& triangle, const std::vector<Index>& order) {
  const MatrixXd moved = triangle(Eigen::all, order);
  return Eigen::HouseholderQR<MatrixXd>(moved)
      .matrixQR()
      .triangularView<Eigen::Upper>();
}

class Search {
 public:
  Search(double n, double total, const BestSubsetOptions& options)
      : n_(n), total_(total), options_(options) {
    most_terms_ = static_cast<Index>(n_) - 2;
    if (options.max_terms >= 0) {
      most_terms_ = std::min(most_terms_, options.max_terms);
    }
  }

  // Lower is better.
  double Value(double rss, Index terms) const {
    const double k = static_cast<double>(terms) + 1.0;
    switch (options_.criterion) {
      case Criterion::kAic:
        return Aic(rss, n_, k);
      case Criterion::kAicc:
        return Aicc(rss, n_, k);
      case Criterion::kAdjustedR2:
        return -AdjustedR2(rss, total_, n_, k);
      case Criterion::kCp:
        return MallowsCp(rss, options_.sigma2, n_, k);
      default:
        return Bic(rss, n_, k);
    }
  }

  void Visit(Node node) {
    if (IsInterrupted()) {
      complete_ = false;
      return;
    }
    ++nodes_;
    const Index size = std::ssize(node.columns);
    if (size - node.fixed >= kFreeColumnsWorthSorting) SortFree(&node);
    // Leading subsets: the response's part in the rows below is their rss.
    const VectorXd response = node.triangle.col(size);
    double rss = 0.0;
    for (Index leading = size; leading >= node.fixed; --leading) {
      rss += response[leading] * response[leading];
      if (leading > most_terms_) continue;
      const double value = Value(rss, leading);
      if (value < best_value_) {
        best_value_ = value;
        best_ = {node.columns.begin(), node.columns.begin() + leading};
      }
    }
    // Drop a column: those before it are then fixed. Deep branches first, as
    // they are the small ones.
    for (Index place = size - 1; place >= node.fixed; --place) {
      if (place == size - 1) continue;  // a leading subset, seen above
      const double all = RssWithout(node, place);
      if (Bound(all, place + 1, size - 1) >= best_value_) continue;
      Node child;
      child.columns = node.columns;
      child.columns.erase(child.columns.begin() + place);
      child.triangle = WithoutColumn(node.triangle, place);
      child.fixed = place;
      Visit(std::move(child));
    }
  }

  BestSubsetResult Result() const {
    BestSubsetResult result;
    result.chosen = best_;
    std::sort(result.chosen.begin(), result.chosen.end());
    result.criterion = options_.criterion == Criterion::kAdjustedR2
                           ? -best_value_
                           : best_value_;
    result.nodes = nodes_;
    result.complete = complete_;
    return result;
  }

 private:
  // No subset of fewest .. most columns with at least this rss can be better.
  double Bound(double rss, Index fewest, Index most) const {
    double bound = kInfinity;
    const Index last = std::min(most, most_terms_);
    // AICc and adjusted R2 need not grow with the number of terms: look at all.
    for (Index terms = fewest; terms <= last; ++terms) {
      bound = std::min(bound, Value(rss, terms));
    }
    return bound;
  }

  static double RssWithout(const Node& node, Index place) {
    const Index size = std::ssize(node.columns);
    double rss = node.triangle(size, size) * node.triangle(size, size);
    // Rotating column `place` away moves this much of the response down.
    VectorXd unit = VectorXd::Zero(size);
    unit[place] = 1.0;
    const VectorXd row = node.triangle.topLeftCorner(size, size)
                             .transpose()
                             .triangularView<Eigen::Lower>()
                             .solve(unit);
    const double along =
        row.dot(node.triangle.col(size).head(size)) / row.norm();
    return rss + along * along;
  }

  // Free columns in falling order of what their loss would cost, so that the
  // branches without the strong ones are cut at once.
  static void SortFree(Node* node) {
    const Index size = std::ssize(node->columns);
    VectorXd cost(size);
    for (Index place = 0; place < size; ++place) {
      cost[place] = RssWithout(*node, place);
    }
    std::vector<Index> order = stats::AllIndices(size);
    std::stable_sort(order.begin() + node->fixed,
                     order.end(),
                     [&](Index a, Index b) { return cost[a] > cost[b]; });
    if (std::is_sorted(order.begin(), order.end())) return;
    std::vector<Index> columns;
    for (const Index place : order) {
      columns.push_back(node->columns[static_cast<std::size_t>(place)]);
    }
    order.push_back(size);  // the response stays last
    node->triangle = Reordered(node->triangle, order);
    node->columns = std::move(columns);
  }

  double n_;
  double total_;
  const BestSubsetOptions& options_;
  Index most_terms_ = 0;
  double best_value_ = kInfinity;
  std::vector<Index> best_;
  std::int64_t nodes_ = 0;
  bool complete_ = true;
};

}  // namespace

void BestSubsetOptions::Validate() const {
  if (criterion == Criterion::kPress || criterion == Criterion::kCv ||
      criterion == Criterion::kPValue || criterion == Criterion::kNone) {
    throw std::invalid_argument(
        "BestSubsetOptions: criterion must be aic, aicc, bic, adjr2 or cp, "
        "found " +
        std::string(ToString(criterion)));
  }
}

BestSubsetResult SelectBestSubset(const RegressionProblem& problem,
                                  const std::vector<Index>& include,
                                  const std::vector<bool>& excluded,
                                  const BestSubsetOptions& options) {
  options.Validate();
  ValidateSelection(problem, "SelectBestSubset");
  const Index rows = problem.response.size();
  const double n = problem.num_observations();
  OrthogonalBasis basis(rows);
  basis.Append(problem.Weighted(problem.InterceptColumn()), VectorXd(0));
  Node root;
  BestSubsetResult aliased;
  const auto take = [&](Index candidate, bool included) {
    const VectorXd column = problem.Weighted(problem.terms.col(candidate));
    VectorXd along;
    const VectorXd rest = basis.Remainder(column, &along);
    if (!(rest.norm() > kCollinear * column.norm()) || basis.size() >= rows) {
      aliased.aliased.push_back(candidate);
      return;
    }
    basis.Append(rest, along);
    root.columns.push_back(candidate);
    if (included) ++root.fixed;
  };
  for (const Index candidate : include) take(candidate, true);
  for (Index j = 0; j < problem.terms.cols(); ++j) {
    const bool out = !excluded.empty() && excluded[static_cast<std::size_t>(j)];
    if (out || std::find(include.begin(), include.end(), j) != include.end()) {
      continue;
    }
    take(j, false);
  }
  VectorXd along;
  const VectorXd residual =
      basis.Remainder(problem.Weighted(problem.response), &along);
  const Index size = std::ssize(root.columns);
  if (static_cast<double>(root.fixed) + 1.0 > n) {
    throw std::invalid_argument(
        "SelectBestSubset: more included terms than rows");
  }
  // The intercept's row and column are left out: it is always in.
  root.triangle.setZero(size + 1, size + 1);
  root.triangle.topLeftCorner(size, size) =
      basis.R().bottomRightCorner(size, size);
  root.triangle.col(size).head(size) = along.tail(size);
  root.triangle(size, size) = residual.norm();
  const double total = root.triangle.col(size).squaredNorm();
  BestSubsetOptions effective = options;
  if (options.criterion == Criterion::kCp && std::isnan(options.sigma2)) {
    const double freedom = n - static_cast<double>(size) - 1.0;
    if (!(freedom > 0.0)) {
      throw std::invalid_argument(
          "SelectBestSubset: Cp needs sigma2= or more rows than terms");
    }
    effective.sigma2 = residual.squaredNorm() / freedom;
  }
  Search search(n, total, effective);
  search.Visit(std::move(root));
  BestSubsetResult result = search.Result();
  result.aliased = std::move(aliased.aliased);
  return result;
}

}  // namespace errmap::fitting
