#include "models/polynomial/penalized_basis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "fitting/least_squares/cross_products.h"
#include "fitting/matrix_product.h"
#include "models/history/with_history.h"
#include "models/out_of_reach.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/polynomial/polynomial_model.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using fitting::CrossProducts;
using fitting::Penalty;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr Index kBlockRows = 4096;
// Predictions of held-out rows are kept for stacking up to this many.
constexpr Index kMostKept = 100'000;

// Where a set of rows lies: their scaled inputs and their target.
struct Ranges {
  explicit Ranges(Index inputs)
      : input_min(VectorXd::Constant(inputs, kNaN)),
        input_max(VectorXd::Constant(inputs, kNaN)) {}

  void Include(const MatrixXd& inputs, const VectorXd& targets) {
    WidenInputs(inputs.colwise().minCoeff(), inputs.colwise().maxCoeff());
    WidenErrors(targets.minCoeff(), targets.maxCoeff());
  }
  void Include(const Ranges& other) {
    if (std::isnan(other.error_min)) return;
    WidenInputs(other.input_min, other.input_max);
    WidenErrors(other.error_min, other.error_max);
  }

  VectorXd input_min;
  VectorXd input_max;
  double error_min = kNaN;
  double error_max = kNaN;

 private:
  void WidenInputs(const VectorXd& low, const VectorXd& high) {
    for (Index j = 0; j < input_min.size(); ++j) {
      if (!(input_min[j] <= low[j])) input_min[j] = low[j];
      if (!(input_max[j] >= high[j])) input_max[j] = high[j];
    }
  }
  void WidenErrors(double low, double high) {
    if (!(error_min <= low)) error_min = low;
    if (!(error_max >= high)) error_max = high;
  }
};

void ClipColumns(const VectorXd& min,
                 const VectorXd& max,
                 double margin,
                 MatrixXd* values) {
  for (Index j = 0; j < values->cols(); ++j) {
    const double widened = margin * (max[j] - min[j]);
    values->col(j) =
        values->col(j).cwiseMax(min[j] - widened).cwiseMin(max[j] + widened);
  }
}

// Whether a term is more than a straight line of an input that only grows: what
// bends is foretold by nothing where such an input has never been.
bool BendsWhatGrows(const TermPowers& powers, const ViewedRows& viewed) {
  int degree = 0;
  bool grows = false;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    degree += powers[i];
    grows = grows || (powers[i] > 0 && viewed.only_grows[i]);
  }
  return grows && degree > 1;
}

std::vector<bool> ExcludedTerms(const PenalizedBasis& basis,
                                const ViewedRows& viewed,
                                const PolynomialDesign& design) {
  std::vector<bool> excluded(static_cast<std::size_t>(design.num_terms()),
                             false);
  std::vector<std::string> names;
  for (const data::ColumnInfo& input : design.dataset().inputs()) {
    names.push_back(input.name);
  }
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

class SummedBasis {
 public:
  SummedBasis(std::shared_ptr<const ViewedRows> viewed,
              const PenalizedBasis& basis,
              const InnerFolds* folds,
              const FitContext& context)
      : viewed_(std::move(viewed)),
        design_(std::make_shared<const PolynomialDesign>(
            MakeDesign(*viewed_, basis))),
        excluded_(ExcludedTerms(basis, *viewed_, *design_)),
        guarded_(basis.guarded),
        stop_(context.stop) {
    if (folds != nullptr) folds_ = *folds;
    if (basis.between < 1.0) TakeSessionMeans(std::sqrt(basis.between));
    const Index n = design_->rows();
    if (folds_ && (static_cast<Index>(folds_->folds.codes.size()) != n ||
                   folds_->folds.count() < 2)) {
      throw std::invalid_argument(
          "the penalty is chosen by cross-validation, which needs a fold for "
          "each row and at least 2 folds");
    }
    members_.resize(folds_ ? static_cast<std::size_t>(folds_->folds.count())
                           : 1);
    for (Index row = 0; row < n; ++row) {
      const Index fold =
          folds_ ? folds_->folds.codes[static_cast<std::size_t>(row)] : 0;
      members_[static_cast<std::size_t>(fold)].push_back(row);
    }
    for (const std::vector<Index>& rows : members_) {
      sums_.push_back(fitting::NoRows(design_->num_terms()));
      ranges_.emplace_back(static_cast<Index>(design_->inputs().size()));
      ForBlocks(rows, [&](const std::vector<Index>& block) {
        const MatrixXd inputs = Inputs(block);
        ranges_.back().Include(inputs, Targets(block));
        const Rows fitted = FittedRows(block, Terms(inputs));
        sums_.back() +=
            fitting::SumProducts(fitted.terms, fitted.targets, Weights(block));
      });
    }
    all_ = sums_.front();
    for (std::size_t fold = 1; fold < sums_.size(); ++fold) {
      all_ += sums_[fold];
    }
  }

  const std::shared_ptr<const ViewedRows>& viewed() const { return viewed_; }
  const std::shared_ptr<const PolynomialDesign>& design() const {
    return design_;
  }
  // Nothing where the penalty is given.
  const std::optional<InnerFolds>& inner() const { return folds_; }
  // Of all rows, or of those that predict a fold.
  fitting::PenalizedPath PathOf(Penalty penalty,
                                std::optional<Index> fold) const {
    const CrossProducts sums = fold ? TrainingOf(*fold) : all_;
    const bool intercept = viewed_->intercept;
    std::vector<Index> rows;
    for (Index f = 0; f < static_cast<Index>(members_.size()); ++f) {
      if (fold && !Predicts(f, *fold)) continue;
      const std::vector<Index>& more = members_[static_cast<std::size_t>(f)];
      rows.insert(rows.end(), more.begin(), more.end());
    }
    // The space of the rows is the smaller one of many filtered sensors.
    if (penalty != Penalty::kRidge || rows.empty() ||
        static_cast<Index>(rows.size()) >= design_->num_terms()) {
      return {penalty, sums, intercept};
    }
    const Rows fitted = FittedRows(rows, Terms(Inputs(rows)));
    return {sums, intercept, fitted.terms, fitted.targets, Weights(rows)};
  }

  // Of the errors as they are; those of the fitted rows are less.
  fitting::PenalizedPath::Solutions Solve(
      const fitting::PenalizedPath& path,
      const std::vector<double>& strengths) const {
    auto solutions = path.Solve(strengths);
    solutions.intercepts /= offset_kept_;
    return solutions;
  }

  // A ridge's solution to all rows, to full precision.
  void Refine(const fitting::PenalizedPath& path,
              double strength,
              fitting::PenalizedPath::Solutions* solution) const {
    solution->intercepts *= offset_kept_;
    double residuals = 0.0;
    VectorXd with_columns = VectorXd::Zero(design_->num_terms());
    for (const std::vector<Index>& rows : members_) {
      ForBlocks(rows, [&](const std::vector<Index>& block) {
        const Rows fitted = FittedRows(block, Terms(Inputs(block)));
        VectorXd left =
            fitted.targets - fitted.terms * solution->coefficients.col(0);
        left.array() -= solution->intercepts[0];
        const VectorXd weights = Weights(block);
        if (weights.size() > 0) left.array() *= weights.array();
        residuals += left.sum();
        with_columns += fitted.terms.transpose() * left;
      });
    }
    path.Refine(strength, residuals, with_columns, solution);
    solution->intercepts /= offset_kept_;
  }

  // Predictions (rows of the fold x solutions), clipped where guarded.
  template <typename Take>
  void PredictFold(Index fold,
                   const fitting::PenalizedPath::Solutions& solutions,
                   Take&& take) const {
    const Guards margins;
    Ranges trained(static_cast<Index>(design_->inputs().size()));
    for (Index f = 0; f < folds_->folds.count(); ++f) {
      if (Predicts(f, fold)) {
        trained.Include(ranges_[static_cast<std::size_t>(f)]);
      }
    }
    const double widened =
        margins.error_margin * (trained.error_max - trained.error_min);
    ForBlocks(members_[static_cast<std::size_t>(fold)],
              [&](const std::vector<Index>& block) {
                MatrixXd inputs = Inputs(block);
                MatrixXd terms;
                if (guarded_) {
                  ClipColumns(trained.input_min,
                              trained.input_max,
                              margins.input_margin,
                              &inputs);
                  terms = GuardedTerms(inputs, trained);
                } else {
                  terms = Terms(inputs);
                }
                MatrixXd predicted(inputs.rows(),
                                   solutions.coefficients.cols());
                fitting::Multiply(terms, solutions.coefficients, predicted);
                predicted.rowwise() += solutions.intercepts.transpose();
                if (guarded_) {
                  predicted = predicted.cwiseMax(trained.error_min - widened)
                                  .cwiseMin(trained.error_max + widened);
                }
                take(block, predicted);
              });
  }

  VectorXd Targets(const std::vector<Index>& rows) const {
    return design_->dataset().target_values()(rows);
  }
  VectorXd Weights(const std::vector<Index>& rows) const {
    const VectorXd& weights = design_->dataset().weights();
    return weights.size() == 0 ? VectorXd() : VectorXd(weights(rows));
  }

 private:
  // As they are fitted.
  struct Rows {
    MatrixXd terms;
    VectorXd targets;
  };

  // Less the share of their session's mean that does not count.
  Rows FittedRows(const std::vector<Index>& rows, MatrixXd terms) const {
    Rows fitted{std::move(terms), Targets(rows)};
    if (offset_kept_ == 1.0) return fitted;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Index session = sessions_[static_cast<std::size_t>(rows[i])];
      const auto row = static_cast<Index>(i);
      fitted.terms.row(row) -=
          (1.0 - offset_kept_) * session_means_.terms.row(session);
      fitted.targets[row] -=
          (1.0 - offset_kept_) * session_means_.targets[session];
    }
    return fitted;
  }

  void TakeSessionMeans(double offset_kept) {
    offset_kept_ = offset_kept;
    sessions_ = design_->dataset().session_codes();
    const Index count = 1 + std::ranges::max(sessions_);
    session_means_ = {MatrixXd::Zero(count, design_->num_terms()),
                      VectorXd::Zero(count)};
    VectorXd weight = VectorXd::Zero(count);
    std::vector<Index> all(static_cast<std::size_t>(design_->rows()));
    std::iota(all.begin(), all.end(), Index{0});
    ForBlocks(all, [&](const std::vector<Index>& block) {
      const MatrixXd terms = Terms(Inputs(block));
      const VectorXd targets = Targets(block);
      const VectorXd weights = Weights(block);
      for (Index i = 0; i < terms.rows(); ++i) {
        const Index session = sessions_[static_cast<std::size_t>(
            block[static_cast<std::size_t>(i)])];
        const double w = weights.size() == 0 ? 1.0 : weights[i];
        weight[session] += w;
        session_means_.terms.row(session) += w * terms.row(i);
        session_means_.targets[session] += w * targets[i];
      }
    });
    session_means_.terms.array().colwise() /= weight.array();
    session_means_.targets.array() /= weight.array();
  }

  // Whether the rows of fold `of` are among those that predict `fold`.
  bool Predicts(Index of, Index fold) const {
    return of != fold && (!folds_->folds.forward || of < fold);
  }

  // Of the rows that predict a fold.
  CrossProducts TrainingOf(Index fold) const {
    if (!folds_->folds.forward) {
      CrossProducts others = all_;
      others -= sums_[static_cast<std::size_t>(fold)];
      return others;
    }
    CrossProducts earlier = fitting::NoRows(design_->num_terms());
    for (Index f = 0; f < fold; ++f) {
      earlier += sums_[static_cast<std::size_t>(f)];
    }
    return earlier;
  }

  MatrixXd Inputs(const std::vector<Index>& rows) const {
    const MatrixXd inputs =
        design_->dataset().input_values()(rows, design_->inputs());
    return design_->scaling().Apply(inputs);
  }

  MatrixXd Terms(const MatrixXd& inputs) const {
    MatrixXd terms = TermMatrix(inputs, design_->terms());
    // A column of zeros takes no part.
    for (Index j = 0; j < terms.cols(); ++j) {
      if (excluded_[static_cast<std::size_t>(j)]) terms.col(j).setZero();
    }
    return terms;
  }

  // Terms that bend see inputs held near where the fold was trained, as in
  // MapOfTerms.
  MatrixXd GuardedTerms(const MatrixXd& inputs, const Ranges& trained) const {
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
      const TermPowers& term = design_->terms()[static_cast<std::size_t>(j)];
      if (Bends(ranges, term) || excluded_[static_cast<std::size_t>(j)]) {
        continue;
      }
      straight.push_back(j);
      powers.push_back(term);
    }
    terms(Eigen::all, straight) = TermMatrix(inputs, powers);
    return terms;
  }

  template <typename Work>
  void ForBlocks(const std::vector<Index>& rows, Work&& work) const {
    for (std::size_t first = 0; first < rows.size(); first += kBlockRows) {
      if (stop_ != nullptr && stop_->load()) {
        throw std::invalid_argument("interrupted");
      }
      const std::size_t last =
          std::min(rows.size(), first + static_cast<std::size_t>(kBlockRows));
      work(
          std::vector<Index>(rows.begin() + static_cast<std::ptrdiff_t>(first),
                             rows.begin() + static_cast<std::ptrdiff_t>(last)));
    }
  }

  std::shared_ptr<const ViewedRows> viewed_;
  std::shared_ptr<const PolynomialDesign> design_;
  std::vector<bool> excluded_;
  bool guarded_;
  double offset_kept_ = 1.0;     // of a session's mean, in the fitted rows
  std::vector<Index> sessions_;  // of each row, where less than all is kept
  Rows session_means_;           // (sessions)
  const std::atomic<bool>* stop_;
  std::optional<InnerFolds> folds_;
  std::vector<std::vector<Index>> members_;
  std::vector<CrossProducts> sums_;
  std::vector<Ranges> ranges_;
  CrossProducts all_;
};

namespace {

// What the inner hold-outs say of each strength tried.
class StrengthSearch {
 public:
  StrengthSearch(const SummedBasis& rows, Penalty penalty, double indifference)
      : rows_(rows),
        folds_(*rows.inner()),
        indifference_(indifference),
        keeps_(rows.design()->rows() <= kMostKept) {
    for (Index fold = folds_.folds.first_judged(); fold < folds_.folds.count();
         ++fold) {
      paths_.push_back(rows.PathOf(penalty, fold));
    }
  }

  // Judges `strengths`, falling.
  void Judge(const std::vector<double>& strengths) {
    const auto count = static_cast<Index>(strengths.size());
    const auto judged = static_cast<Index>(paths_.size());
    MatrixXd errors = MatrixXd::Zero(judged, count);  // sums of squares
    VectorXd weights = VectorXd::Zero(judged);
    MatrixXd held_out;
    if (keeps_) {
      held_out = MatrixXd::Constant(rows_.design()->rows(), count, kNaN);
    }
    for (Index i = 0; i < judged; ++i) {
      rows_.PredictFold(
          i + folds_.folds.first_judged(),
          rows_.Solve(paths_[static_cast<std::size_t>(i)], strengths),
          [&](const std::vector<Index>& block, const MatrixXd& predicted) {
            VectorXd w = rows_.Weights(block);
            if (w.size() == 0) w = VectorXd::Ones(predicted.rows());
            const MatrixXd residuals =
                (-predicted).colwise() + rows_.Targets(block);
            errors.row(i) += w.transpose() * residuals.cwiseAbs2();
            weights[i] += w.sum();
            if (keeps_) held_out(block, Eigen::all) = predicted;
          });
    }
    for (Index s = 0; s < count; ++s) {
      Judged result;
      result.error = TypicalError(
          folds_, errors.col(s).cwiseQuotient(weights), weights, indifference_);
      if (keeps_) result.held_out = held_out.col(s);
      judged_[-strengths[static_cast<std::size_t>(s)]] = std::move(result);
    }
  }

  double Best() const { return -Lowest()->first; }
  double LeastRmse() const {
    return std::sqrt(Lowest()->second.error.mean_square);
  }

  // The chosen strength and all that was found, into `candidate`.
  void Report(bool one_standard_error, PenalizedCandidate* candidate) const {
    auto chosen = Lowest();
    const InnerError least = chosen->second.error;
    if (one_standard_error && !std::isnan(least.standard_error)) {
      const double enough = least.mean_square + least.standard_error;
      chosen =
          std::find_if(judged_.begin(), judged_.end(), [&](const auto& judged) {
            return judged.second.error.mean_square <= enough;
          });
    }
    for (const auto& [strength, judged] : judged_) {
      candidate->strengths.push_back(-strength);
      candidate->mean_squared_errors.push_back(judged.error.mean_square);
      candidate->standard_errors.push_back(judged.error.standard_error);
    }
    candidate->strength = -chosen->first;
    candidate->held_out_rmse = std::sqrt(chosen->second.error.mean_square);
    candidate->held_out = chosen->second.held_out;
  }

 private:
  struct Judged {
    InnerError error;
    VectorXd held_out;
  };
  // By falling strength: the key is its negative.
  using Results = std::map<double, Judged>;

  // Of equal errors the stronger penalty.
  Results::const_iterator Lowest() const {
    return std::ranges::min_element(judged_, {}, [](const auto& judged) {
      return judged.second.error.mean_square;
    });
  }

  const SummedBasis& rows_;
  const InnerFolds& folds_;
  double indifference_;
  bool keeps_;
  std::vector<fitting::PenalizedPath> paths_;  // of the judged folds
  Results judged_;
};

std::vector<double> EverySecond(const std::vector<double>& values) {
  std::vector<double> taken;
  for (std::size_t i = 0; i < values.size(); i += 2) taken.push_back(values[i]);
  return taken;
}

// Each strength of a ridge costs a factorisation: the falling `grid` first,
// then the strengths around the best; no further where the first few leave the
// basis behind.
void SearchRidge(const std::vector<double>& grid,
                 double promising,
                 StrengthSearch* search) {
  const auto few = grid.begin() + kTrialsBeforeGivenUp;
  search->Judge({grid.begin(), few});
  if (!(search->LeastRmse() <= promising)) return;
  search->Judge({few, grid.end()});
  for (const double step : {10.0, std::sqrt(10.0)}) {
    const double best = search->Best();
    search->Judge({best * step, best / step});
  }
}

}  // namespace

std::shared_ptr<const SummedBasis> SumBasis(
    std::shared_ptr<const ViewedRows> viewed,
    const PenalizedBasis& basis,
    const InnerFolds* folds,
    const FitContext& context) {
  return std::make_shared<const SummedBasis>(
      std::move(viewed), basis, folds, context);
}

std::shared_ptr<const PenalizedFit> FitPenalty(
    const std::shared_ptr<const SummedBasis>& basis,
    Penalty penalty,
    const PenaltyRule& rule,
    double indifference,
    double promising) {
  PenalizedCandidate candidate;
  candidate.penalty = penalty;
  candidate.held_out_rmse = kNaN;
  const fitting::PenalizedPath path = basis->PathOf(penalty, std::nullopt);
  if (rule.strength) {
    candidate.strength = *rule.strength;
  } else if (!basis->inner()) {
    throw std::invalid_argument("FitPenalty: there are no folds to choose by");
  } else {
    StrengthSearch search(*basis, penalty, indifference);
    const std::vector<double> grid = path.Grid();
    if (penalty == Penalty::kLasso) {
      search.Judge(grid);
    } else if (rule.one_standard_error) {
      SearchRidge(grid, std::numeric_limits<double>::infinity(), &search);
    } else {
      SearchRidge(EverySecond(grid), promising, &search);
    }
    search.Report(rule.one_standard_error, &candidate);
  }
  auto solutions = basis->Solve(path, {candidate.strength});
  if (penalty == Penalty::kRidge && candidate.strength > 0.0) {
    basis->Refine(path, candidate.strength, &solutions);
  }
  candidate.coefficients = solutions.coefficients.col(0);
  candidate.intercept = solutions.intercepts[0];
  candidate.degrees_of_freedom =
      path.DegreesOfFreedom(candidate.strength, candidate.coefficients);
  const PolynomialDesign& design = *basis->design();
  return std::make_shared<const PenalizedFit>(PenalizedFit{
      design.inputs(), design.scaling(), design.terms(), std::move(candidate)});
}

FittedModel MapOfCandidate(const std::string& name,
                           const Dataset& raw,
                           const ViewedRows& viewed,
                           const PolynomialDesign& design,
                           const PenalizedCandidate& candidate,
                           bool guarded) {
  FittedModel fitted = MapOfTerms(
      name, design, candidate.intercept, candidate.coefficients, guarded);
  fitted.inner_rmse = candidate.held_out_rmse;
  if (guarded) {
    fitted.guards = MakeGuards(fitted.inputs, raw.target_values());
    LeaveRoom(
        NamesOfGrowing(viewed), viewed.room, fitted.inputs, &*fitted.guards);
  }
  if (viewed.history != nullptr) {
    fitted = WithHistory(std::move(fitted), raw, *viewed.history);
  }
  return fitted;
}

}  // namespace errmap::models
