#include "models/polynomial/penalized_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "models/history/with_history.h"
#include "models/inner_folds.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/polynomial/polynomial_model.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

using data::Dataset;
using fitting::Penalty;

// Results of the inner hold-outs for each strength tried.
class StrengthSearch {
 public:
  StrengthSearch(const SummedBasis& rows, Penalty penalty, double indifference)
      : rows_(rows), folds_(*rows.inner()), indifference_(indifference) {
    for (Index fold = folds_.folds.first_judged(); fold < folds_.folds.count();
         ++fold) {
      paths_.push_back(rows.PathOf(penalty, fold));
    }
  }

  // Judges `strengths`, falling.
  void Judge(const std::vector<double>& strengths) {
    const auto count = std::ssize(strengths);
    const auto judged = std::ssize(paths_);
    MatrixXd errors = MatrixXd::Zero(judged, count);  // sums of squares
    VectorXd weights = VectorXd::Zero(judged);
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
          });
    }
    for (Index s = 0; s < count; ++s) {
      judged_[-strengths[static_cast<std::size_t>(s)]] = TypicalError(
          folds_, errors.col(s).cwiseQuotient(weights), weights, indifference_);
    }
  }

  double Best() const { return -Lowest()->first; }
  double LeastRmse() const { return std::sqrt(Lowest()->second.mean_square); }

  // The chosen strength and all that was found, into `candidate`.
  void Report(bool one_standard_error, PenalizedCandidate* candidate) const {
    auto chosen = Lowest();
    const InnerError least = chosen->second;
    if (one_standard_error && !std::isnan(least.standard_error)) {
      const double enough = least.mean_square + least.standard_error;
      chosen =
          std::find_if(judged_.begin(), judged_.end(), [&](const auto& judged) {
            return judged.second.mean_square <= enough;
          });
    }
    for (const auto& [strength, judged] : judged_) {
      candidate->strengths.push_back(-strength);
      candidate->mean_squared_errors.push_back(judged.mean_square);
      candidate->standard_errors.push_back(judged.standard_error);
    }
    candidate->strength = -chosen->first;
    candidate->held_out_rmse = std::sqrt(chosen->second.mean_square);
  }

 private:
  // By falling strength: the key is its negative.
  using Results = std::map<double, InnerError>;

  // Returns the lowest error; of equal ones the stronger penalty.
  Results::const_iterator Lowest() const {
    return std::ranges::min_element(judged_, {}, [](const auto& judged) {
      return judged.second.mean_square;
    });
  }

  const SummedBasis& rows_;
  const InnerFolds& folds_;
  double indifference_;
  std::vector<fitting::PenalizedPath> paths_;  // of the judged folds
  Results judged_;
};

std::vector<double> EverySecond(const std::vector<double>& values) {
  std::vector<double> taken;
  for (std::size_t i = 0; i < values.size(); i += 2) taken.push_back(values[i]);
  return taken;
}

// Each strength of a ridge costs a factorisation. Judges the falling `grid`
// first, then the strengths around the best; stops early if the first few leave
// the basis behind.
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

// A term beyond its bend keeps its slope at the offset, which must lie in the
// trained range. An input with another offset, as in terms that are not
// centred, bends everywhere. `columns`: of the inputs, in the view.
std::vector<BendRange> BendsWithin(const ViewedRows& viewed,
                                   const std::vector<Index>& columns,
                                   const std::vector<TrainedInput>& inputs,
                                   const VectorXd& offset) {
  std::vector<BendRange> ranges;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const TrainedInput& input = inputs[i];
    const auto at = static_cast<Index>(i);
    if (viewed.is_position[static_cast<std::size_t>(columns[i])] ||
        offset[at] < input.min || offset[at] > input.max) {
      continue;
    }
    const double room = kBendMargin * (input.max - input.min);
    ranges.push_back({at, input.min - room, input.max + room});
  }
  return ranges;
}

}  // namespace

std::shared_ptr<const PenalizedFit> FitPenalty(const SummedBasis& basis,
                                               Penalty penalty,
                                               const PenaltyRule& rule,
                                               double indifference,
                                               double promising) {
  PenalizedCandidate candidate;
  candidate.penalty = penalty;
  candidate.held_out_rmse = stats::kNaN;
  const fitting::PenalizedPath path = basis.PathOf(penalty, std::nullopt);
  if (rule.strength) {
    candidate.strength = *rule.strength;
  } else if (!basis.inner()) {
    throw std::invalid_argument("FitPenalty: there are no folds to choose by");
  } else {
    StrengthSearch search(basis, penalty, indifference);
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
  const bool refines = penalty == Penalty::kRidge && candidate.strength > 0.0;
  const auto solutions = refines ? basis.SolveRefined(path, candidate.strength)
                                 : basis.Solve(path, {candidate.strength});
  candidate.coefficients = solutions.coefficients.col(0);
  candidate.intercept = solutions.intercepts[0];
  candidate.degrees_of_freedom =
      path.DegreesOfFreedom(candidate.strength, candidate.coefficients);
  const PolynomialDesign& design = basis.design();
  return std::make_shared<const PenalizedFit>(PenalizedFit{
      design.inputs(), design.scaling(), design.terms(), std::move(candidate)});
}

FittedModel MapOfCandidate(const std::string& name,
                           const Dataset& raw,
                           const ViewedRows& viewed,
                           const PolynomialDesign& design,
                           const PenalizedCandidate& candidate,
                           bool guarded) {
  std::vector<Index> chosen;
  for (Index j = 0; j < candidate.coefficients.size(); ++j) {
    if (candidate.coefficients[j] != 0.0) chosen.push_back(j);
  }
  const UsedTerms used = KeepUsedInputs(design.terms(), chosen);
  std::vector<Index> columns;
  for (const Index input : used.inputs) {
    columns.push_back(design.inputs()[static_cast<std::size_t>(input)]);
  }
  PolynomialForm form{design.scaling().offset(used.inputs),
                      design.scaling().scale(used.inputs),
                      candidate.intercept,
                      {}};
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    form.terms.push_back({used.terms[i], candidate.coefficients[chosen[i]]});
  }
  const Dataset& rows = design.dataset();
  FittedModel fitted = NewMap(name, ModelKind::kPolynomial, rows);
  fitted.inner_rmse = candidate.held_out_rmse;
  fitted.inputs = DescribeInputs(rows, columns);
  if (guarded) {
    form.bends_within =
        BendsWithin(viewed, columns, fitted.inputs, form.input_offset);
  }
  const Index parameters = std::ssize(chosen) + 1;
  fitted.model = std::make_shared<PolynomialModel>(form, parameters);
  const VectorXd residual = rows.target_values() - fitted.Predict(rows);
  fitted.equation = EquationText(
      form,
      fitted.target,
      fitted.inputs,
      std::sqrt(residual.squaredNorm() / static_cast<double>(design.rows())));
  if (guarded) {
    fitted.guards =
        MakeClampLimits(fitted.inputs, raw.target_values(), viewed.grows());
  }
  if (viewed.history != nullptr) {
    fitted = WithHistory(std::move(fitted), raw, *viewed.history);
  }
  return fitted;
}

}  // namespace errmap::models
