#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "fitting/interruption.h"
#include "fitting/matrix_product.h"
#include "models/polynomial/penalized_fit.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/polynomial/polynomial_model.h"
#include "stats/indices.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

using data::Dataset;
using fitting::CrossProducts;
using fitting::Penalty;

constexpr Index kBlockRows = 4096;

void ClipColumns(const VectorXd& min,
                 const VectorXd& max,
                 double margin,
                 MatrixXd* values) {
  for (Index j = 0; j < values->cols(); ++j) {
    const Bounds bounds = Widened(min[j], max[j], margin);
    values->col(j) = values->col(j).cwiseMax(bounds.low).cwiseMin(bounds.high);
  }
}

// Returns true if a term bends an input that only grows: nothing supports a
// bend beyond its values so far.
bool BendsWhatGrows(const TermPowers& powers, const ViewedRows& viewed) {
  if (std::accumulate(powers.begin(), powers.end(), 0) < 2) return false;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    if (viewed.only_grows[i] && powers[i] > 0) return true;
  }
  return false;
}

std::vector<bool> ExcludedTerms(const PenalizedBasis& basis,
                                const ViewedRows& viewed,
                                const PolynomialDesign& design) {
  std::vector<bool> excluded(static_cast<std::size_t>(design.num_terms()),
                             false);
  const std::vector<std::string> names = design.dataset().InputNames();
  for (const TermPowers& powers :
       ResolveTerms(basis.exclude, names, "exclude")) {
    const auto at = std::ranges::find(design.terms(), powers);
    if (at == design.terms().end()) {
      throw std::invalid_argument(
          fmt::format("exclude: {} is not among the {} terms up to degree {}",
                      TermName(powers, names),
                      ToString(basis.terms),
                      basis.degree));
    }
    excluded[static_cast<std::size_t>(at - design.terms().begin())] = true;
  }
  for (std::size_t i = 0; basis.guarded && i < excluded.size(); ++i) {
    excluded[i] = excluded[i] || BendsWhatGrows(design.terms()[i], viewed);
  }
  return excluded;
}

PolynomialDesign MakeDesign(const ViewedRows& viewed,
                            const PenalizedBasis& basis) {
  constexpr Index kMostBasisTerms =
      4000;  // 128 MB of products for each inner fold
  const auto count = CountTerms(basis.terms, viewed.is_position, basis.degree);
  if (!count || *count > kMostBasisTerms) {
    throw std::invalid_argument(fmt::format(
        "degree {} in {} inputs makes {} terms, at most {} can be held; use a "
        "lower degree, fewer inputs or terms=squares",
        basis.degree,
        viewed.is_position.size(),
        count ? std::to_string(*count) : "countless",
        kMostBasisTerms));
  }
  const Dataset& rows = *viewed.rows;
  std::vector<TermPowers> terms =
      MakeTerms(basis.terms, viewed.is_position, basis.degree);
  std::vector<Index> inputs = AllColumns(rows);
  ColumnScaling scaling;
  if (basis.centring != Centring::kStandardised) {
    scaling = PolynomialScaling(rows, inputs, terms, basis.centring);
  } else if (viewed.intercept) {
    scaling = StandardScaling(rows.input_values());
  } else {
    scaling = RootMeanSquareScaling(rows.input_values());
  }
  return {rows, std::move(inputs), std::move(scaling), std::move(terms)};
}

}  // namespace

RowRanges::RowRanges(Index inputs)
    : input_min(VectorXd::Constant(inputs, stats::kNaN)),
      input_max(VectorXd::Constant(inputs, stats::kNaN)),
      error_min(stats::kNaN),
      error_max(stats::kNaN) {}

void RowRanges::Include(const MatrixXd& inputs, const VectorXd& targets) {
  RowRanges rows(inputs.cols());
  rows.input_min = inputs.colwise().minCoeff();
  rows.input_max = inputs.colwise().maxCoeff();
  rows.error_min = targets.minCoeff();
  rows.error_max = targets.maxCoeff();
  Include(rows);
}

// std::fmin and std::fmax of a number and NaN return the number.
void RowRanges::Include(const RowRanges& other) {
  for (Index j = 0; j < input_min.size(); ++j) {
    input_min[j] = std::fmin(input_min[j], other.input_min[j]);
    input_max[j] = std::fmax(input_max[j], other.input_max[j]);
  }
  error_min = std::fmin(error_min, other.error_min);
  error_max = std::fmax(error_max, other.error_max);
}

SummedBasis::SummedBasis(std::shared_ptr<const ViewedRows> viewed,
                         const PenalizedBasis& basis,
                         const InnerFolds* folds)
    : viewed_(std::move(viewed)),
      design_(MakeDesign(*viewed_, basis)),
      excluded_(ExcludedTerms(basis, *viewed_, design_)),
      guarded_(basis.guarded) {
  if (folds != nullptr) folds_ = *folds;
  const Index n = design_.rows();
  if (folds_ &&
      (std::ssize(folds_->folds.codes) != n || folds_->folds.count() < 2)) {
    throw std::invalid_argument(
        "the penalty is chosen by cross-validation, which needs a fold for "
        "each row and at least 2 folds");
  }
  members_ = stats::IndicesByCode(
      folds_ ? folds_->folds.codes
             : std::vector<Index>(static_cast<std::size_t>(n), 0));
  if (basis.between < 1.0) {
    offsets_ = SessionOffsets(
        design_.dataset().session_codes(), design_.num_terms(), basis.between);
    for (const Rows& rows : members_) {
      ForBlocks(rows, [&](const Rows& block) {
        offsets_.Include(block, RowsAsMeasured(block), Weights(block));
      });
    }
  }
  for (const Rows& rows : members_) {
    sums_.push_back(fitting::NoRows(design_.num_terms()));
    ranges_.emplace_back(std::ssize(design_.inputs()));
    ForBlocks(rows, [&](const Rows& block) {
      ranges_.back().Include(Inputs(block), Targets(block));
      const TermRows fitted = RowsAsFitted(block);
      sums_.back() +=
          fitting::SumProducts(fitted.terms, fitted.targets, Weights(block));
    });
  }
  all_ = sums_.front();
  for (std::size_t fold = 1; fold < sums_.size(); ++fold) all_ += sums_[fold];
}

fitting::PenalizedPath SummedBasis::PathOf(Penalty penalty,
                                           std::optional<Index> fold) const {
  const CrossProducts sums = fold ? TrainingOf(*fold) : all_;
  const bool intercept = viewed_->intercept;
  Rows rows;
  for (Index f = 0; f < std::ssize(members_); ++f) {
    if (fold && !Predicts(f, *fold)) continue;
    const Rows& more = members_[static_cast<std::size_t>(f)];
    rows.insert(rows.end(), more.begin(), more.end());
  }
  // The space of the rows is the smaller one of many filtered sensors.
  if (penalty != Penalty::kRidge || rows.empty() ||
      std::ssize(rows) >= design_.num_terms()) {
    return {penalty, sums, intercept};
  }
  const TermRows fitted = RowsAsFitted(rows);
  return {sums, intercept, fitted.terms, fitted.targets, Weights(rows)};
}

fitting::PenalizedPath::Solutions SummedBasis::Solve(
    const fitting::PenalizedPath& path,
    const std::vector<double>& strengths) const {
  auto solutions = path.Solve(strengths);
  solutions.intercepts /= offsets_.kept();
  return solutions;
}

fitting::PenalizedPath::Solutions SummedBasis::SolveRefined(
    const fitting::PenalizedPath& path, double strength) const {
  auto solution = path.Solve({strength});
  double residuals = 0.0;
  VectorXd with_columns = VectorXd::Zero(design_.num_terms());
  for (const Rows& rows : members_) {
    ForBlocks(rows, [&](const Rows& block) {
      const TermRows fitted = RowsAsFitted(block);
      VectorXd left =
          fitted.targets - fitted.terms * solution.coefficients.col(0);
      left.array() -= solution.intercepts[0];
      const VectorXd weights = Weights(block);
      if (weights.size() > 0) left.array() *= weights.array();
      residuals += left.sum();
      with_columns += fitted.terms.transpose() * left;
    });
  }
  path.Refine(strength, residuals, with_columns, &solution);
  solution.intercepts /= offsets_.kept();
  return solution;
}

void SummedBasis::PredictFold(
    Index fold,
    const fitting::PenalizedPath::Solutions& solutions,
    const std::function<void(const Rows&, const MatrixXd&)>& take) const {
  const ClampLimits margins;
  RowRanges trained(std::ssize(design_.inputs()));
  for (Index f = 0; f < folds_->folds.count(); ++f) {
    if (Predicts(f, fold)) {
      trained.Include(ranges_[static_cast<std::size_t>(f)]);
    }
  }
  const Bounds bounds =
      Widened(trained.error_min, trained.error_max, margins.error_margin);
  ForBlocks(members_[static_cast<std::size_t>(fold)], [&](const Rows& block) {
    MatrixXd inputs = Inputs(block);
    if (guarded_) {
      ClipColumns(
          trained.input_min, trained.input_max, margins.input_margin, &inputs);
    }
    const MatrixXd terms =
        guarded_ ? GuardedTerms(inputs, trained) : Terms(inputs);
    MatrixXd predicted(inputs.rows(), solutions.coefficients.cols());
    fitting::Multiply(terms, solutions.coefficients, predicted);
    predicted.rowwise() += solutions.intercepts.transpose();
    if (guarded_) {
      predicted = predicted.cwiseMax(bounds.low).cwiseMin(bounds.high);
    }
    take(block, predicted);
  });
}

VectorXd SummedBasis::Targets(const Rows& rows) const {
  return design_.dataset().target_values()(rows);
}

VectorXd SummedBasis::Weights(const Rows& rows) const {
  const VectorXd& weights = design_.dataset().weights();
  return weights.size() == 0 ? VectorXd() : VectorXd(weights(rows));
}

bool SummedBasis::Predicts(Index of, Index fold) const {
  return of != fold && (!folds_->folds.forward || of < fold);
}

CrossProducts SummedBasis::TrainingOf(Index fold) const {
  if (!folds_->folds.forward) {
    CrossProducts others = all_;
    others -= sums_[static_cast<std::size_t>(fold)];
    return others;
  }
  CrossProducts earlier = fitting::NoRows(design_.num_terms());
  for (Index f = 0; f < fold; ++f) {
    earlier += sums_[static_cast<std::size_t>(f)];
  }
  return earlier;
}

MatrixXd SummedBasis::Inputs(const Rows& rows) const {
  const MatrixXd inputs =
      design_.dataset().input_values()(rows, design_.inputs());
  return design_.scaling().Apply(inputs);
}

MatrixXd SummedBasis::Terms(const MatrixXd& inputs) const {
  MatrixXd terms = TermMatrix(inputs, design_.terms());
  // A column of zeros takes no part.
  for (Index j = 0; j < terms.cols(); ++j) {
    if (excluded_[static_cast<std::size_t>(j)]) terms.col(j).setZero();
  }
  return terms;
}

MatrixXd SummedBasis::GuardedTerms(const MatrixXd& inputs,
                                   const RowRanges& trained) const {
  MatrixXd held = inputs;
  std::vector<BendRange> ranges;
  for (Index j = 0; j < held.cols(); ++j) {
    const double low = trained.input_min[j];  // scaled: centred at 0
    const double high = trained.input_max[j];
    if (viewed_->is_position[static_cast<std::size_t>(j)] || low > 0.0 ||
        high < 0.0) {
      continue;
    }
    const double room = kBendMargin * (high - low);
    held.col(j) = held.col(j).cwiseMax(low - room).cwiseMin(high + room);
    ranges.push_back({.input = j});
  }
  MatrixXd terms = Terms(held);
  std::vector<Index> straight;
  std::vector<TermPowers> powers;
  for (Index j = 0; j < terms.cols(); ++j) {
    const TermPowers& term = design_.terms()[static_cast<std::size_t>(j)];
    if (Bends(ranges, term) || excluded_[static_cast<std::size_t>(j)]) {
      continue;
    }
    straight.push_back(j);
    powers.push_back(term);
  }
  terms(Eigen::all, straight) = TermMatrix(inputs, powers);
  return terms;
}

TermRows SummedBasis::RowsAsMeasured(const Rows& rows) const {
  return {Terms(Inputs(rows)), Targets(rows)};
}

TermRows SummedBasis::RowsAsFitted(const Rows& rows) const {
  TermRows fitted = RowsAsMeasured(rows);
  offsets_.TakeFrom(rows, &fitted);
  return fitted;
}

void SummedBasis::ForBlocks(
    const Rows& rows, const std::function<void(const Rows&)>& work) const {
  for (std::size_t first = 0; first < rows.size(); first += kBlockRows) {
    fitting::ThrowIfInterrupted();
    const std::size_t last =
        std::min(rows.size(), first + static_cast<std::size_t>(kBlockRows));
    work(Rows(rows.begin() + static_cast<std::ptrdiff_t>(first),
              rows.begin() + static_cast<std::ptrdiff_t>(last)));
  }
}

}  // namespace errmap::models
