#include "fitting/selection/stepwise_selection.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include "fitting/interruption.h"
#include "fitting/least_squares/linear_least_squares.h"
#include "fitting/selection/swept_candidates.h"
#include "stats/f_test.h"
#include "stats/require.h"

namespace errmap::fitting {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

[[noreturn]] void Refuse(const std::string& why) {
  throw std::invalid_argument("SelectStepwise: " + why);
}

double Press(const VectorXd& residual, const VectorXd& leverage) {
  const Eigen::ArrayXd slack = 1.0 - leverage.array();
  if (!(slack.minCoeff() > kLeastSlack)) return kNoLimit;
  return (residual.array() / slack).square().sum();
}

double Variance(const RegressionProblem& problem) {
  const LeastSquaresFit full =
      SolveLeastSquares(problem.Design(), problem.response, problem.weights);
  const double freedom =
      problem.num_observations() - static_cast<double>(full.rank);
  if (!(freedom > 0.0)) {
    Refuse("Cp needs sigma2= or more rows than candidate terms; there are " +
           std::to_string(problem.terms.cols()) + " terms and " +
           std::to_string(static_cast<Index>(problem.num_observations())) +
           " rows");
  }
  return full.residual_sum_of_squares / freedom;
}

// One run of a selection.
class Selection {
 public:
  Selection(const RegressionProblem& problem,
            const TermRules& rules,
            const StepwiseOptions& options)
      : problem_(problem),
        rules_(rules),
        options_(options),
        state_(problem),
        n_(problem.num_observations()),
        open_(At(problem.terms.cols()), true),
        sigma2_(options.sigma2) {
    CheckRules();
    if (options.Uses(Criterion::kCp) && std::isnan(sigma2_)) {
      sigma2_ = Variance(problem);
    }
    total_ = state_.residual_sum_of_squares();
    most_terms_ = std::max<Index>(0, static_cast<Index>(n_) - 2);
    if (options.max_terms >= 0) {
      most_terms_ = std::min(most_terms_, options.max_terms);
    }
  }

  SelectionResult Run() {
    SelectionResult result;
    EnterIncluded(&result);
    if (options_.direction == Direction::kBackward) EnterAll();
    result.steps.push_back(Evaluate({}));
    std::vector<std::vector<Index>> models{state_.chosen()};
    std::set<std::vector<Index>> visited{SortedChosen()};
    for (;;) {
      if (IsInterrupted()) {
        result.ended = "interrupted";
        break;
      }
      const bool too_many = std::ssize(state_.chosen()) > most_terms_;
      SelectionMove move = FindMove(too_many);
      if (move.candidate < 0) {
        result.ended = why_none_;
        result.at_most_terms = at_most_terms_;
        break;
      }
      const SelectionStep step = Evaluate(move);
      if (!too_many && !Allows(step, result.steps.back())) {
        result.ended = "the best move does not pass " +
                       std::string(ToString(options_.stop));
        break;
      }
      state_.Apply(move);
      if (!visited.insert(SortedChosen()).second) {
        result.ended = "the next move leads back to an earlier model";
        break;
      }
      result.steps.push_back(step);
      models.push_back(state_.chosen());
    }
    Choose(models, &result);
    return result;
  }

 private:
  void CheckRules() {
    const Index cols = problem_.terms.cols();
    for (std::size_t j = 0; j < rules_.excluded.size(); ++j) {
      if (rules_.excluded[j]) open_[j] = false;
    }
    if (options_.heredity != Heredity::kNone && rules_.parents.empty() &&
        cols > 0) {
      Refuse("heredity needs the parents of the terms");
    }
    const bool are_observations = problem_.intercept.size() == 0;
    if (options_.Uses(Criterion::kPress) && !are_observations) {
      Refuse("PRESS needs the rows; it is not to be had from a triangle");
    }
    if (options_.Uses(Criterion::kCv) && rules_.folds.codes.empty()) {
      Refuse("CV needs folds");
    }
    if (static_cast<double>(rules_.include.size()) + 1.0 > n_) {
      Refuse("more included terms than rows");
    }
  }

  void EnterIncluded(SelectionResult* result) {
    is_included_.assign(open_.size(), false);
    for (const Index candidate : rules_.include) {
      const SelectionMove move = state_.EntryOf(candidate);
      if (move.candidate < 0) {
        if (!state_.is_chosen(candidate)) {
          result->aliased_includes.push_back(candidate);
        }
        continue;
      }
      state_.Apply(move);
      is_included_[At(candidate)] = true;
    }
  }

  void EnterAll() {
    Index wanted = 0;
    for (const bool open : open_) wanted += open ? 1 : 0;
    for (std::size_t j = 0; j < open_.size(); ++j) {
      const Index candidate = static_cast<Index>(j);
      if (!open_[j] || state_.is_chosen(candidate)) continue;
      const SelectionMove move = state_.EntryOf(candidate);
      if (move.candidate < 0) continue;
      if (static_cast<double>(state_.chosen().size()) + 2.0 >= n_) {
        Refuse("backward selection starts from all " + std::to_string(wanted) +
               " candidate terms and needs more rows than terms; there are " +
               std::to_string(static_cast<Index>(n_)) + " rows");
      }
      state_.Apply(move);
    }
  }

  std::vector<Index> SortedChosen() const {
    std::vector<Index> sorted = state_.chosen();
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }

  // --- heredity

  bool MayEnter(Index candidate) const {
    if (!open_[At(candidate)] || state_.is_chosen(candidate)) return false;
    if (options_.heredity == Heredity::kNone) return true;
    const std::vector<Index>& parents = rules_.parents[At(candidate)];
    if (parents.empty()) return true;
    const auto is_in = [&](Index parent) {
      return parent >= 0 && state_.is_chosen(parent);
    };
    return options_.heredity == Heredity::kStrong
               ? std::all_of(parents.begin(), parents.end(), is_in)
               : std::any_of(parents.begin(), parents.end(), is_in);
  }

  bool MayLeave(Index candidate) const {
    if (is_included_[At(candidate)]) return false;
    if (options_.heredity == Heredity::kNone) return true;
    for (const Index child : state_.chosen()) {
      if (is_included_[At(child)]) continue;
      const std::vector<Index>& parents = rules_.parents[At(child)];
      if (std::find(parents.begin(), parents.end(), candidate) ==
          parents.end()) {
        continue;
      }
      if (options_.heredity == Heredity::kStrong) return false;
      const bool has_other =
          std::any_of(parents.begin(), parents.end(), [&](Index parent) {
            return parent >= 0 && parent != candidate &&
                   state_.is_chosen(parent);
          });
      if (!has_other) return false;
    }
    return true;
  }

  // --- moves

  SelectionMove FindMove(bool must_leave) {
    SelectionMove exit;
    if (options_.direction != Direction::kForward || must_leave) {
      exit = FindExit();
    }
    if (must_leave) {
      why_none_ = "no term may leave";
      return exit;
    }
    if (options_.direction == Direction::kBackward) {
      why_none_ = "no term is left to leave";
      return exit;
    }
    if (exit.candidate >= 0 && options_.select == Criterion::kPValue) {
      // Efroymson: what is no longer significant leaves first.
      if (Evaluate(exit).p > options_.remove) return exit;
      exit = {};
    }
    SelectionMove entry = FindEntry();
    if (exit.candidate < 0) return entry;
    if (entry.candidate < 0) return exit;
    const double by_exit = Evaluate(exit).ValueOf(options_.select);
    const double by_entry = Evaluate(entry).ValueOf(options_.select);
    return by_exit < by_entry ? exit : entry;
  }

  SelectionMove FindEntry() {
    if (!(state_.residual_sum_of_squares() > state_.noise())) {
      why_none_ = "what is left is rounding";
      return {};
    }
    why_none_ = "no candidate is left to enter";
    std::vector<bool> open(open_.size());
    for (std::size_t j = 0; j < open.size(); ++j) {
      open[j] = MayEnter(static_cast<Index>(j));
    }
    at_most_terms_ = std::ssize(state_.chosen()) >= most_terms_ &&
                     std::ranges::count(open, true) > 0;
    if (at_most_terms_) {
      why_none_ = "no more terms are allowed";
      return {};
    }
    if (options_.select == Criterion::kPress) return BestByPress(open);
    if (options_.select == Criterion::kCv) return BestByCv(open);
    return state_.BestEntry(open);
  }

  SelectionMove BestByPress(const std::vector<bool>& open) {
    if (!swept_) {
      swept_ = std::make_unique<SweptCandidates>(
          problem_,
          std::vector<bool>(At(problem_.response.size()), true),
          std::vector<bool>(At(problem_.response.size()), false));
    }
    swept_->Follow(state_.chosen());
    return LowestOf(swept_->PressAfterEntry(state_.leverage(), open));
  }

  SelectionMove BestByCv(const std::vector<bool>& open) {
    if (swept_folds_.empty()) {
      const FoldCodes& folds = rules_.folds;
      for (Index fold = folds.first_judged(); fold < folds.count(); ++fold) {
        std::vector<bool> fitted(folds.codes.size());
        std::vector<bool> held_out(folds.codes.size());
        for (std::size_t i = 0; i < fitted.size(); ++i) {
          fitted[i] = folds.Fits(fold, i);
          held_out[i] = folds.codes[i] == fold;
        }
        swept_folds_.push_back(
            std::make_unique<SweptCandidates>(problem_, fitted, held_out));
      }
    }
    VectorXd errors = VectorXd::Zero(problem_.terms.cols());
    for (const auto& swept : swept_folds_) {
      swept->Follow(state_.chosen());
      errors += swept->HeldOutErrorAfterEntry(open);
    }
    return LowestOf(errors);
  }

  SelectionMove LowestOf(VectorXd values) {
    for (;;) {
      Index best = -1;
      double lowest = kNoLimit;
      for (Index j = 0; j < values.size(); ++j) {
        if (values[j] < lowest) {
          lowest = values[j];
          best = j;
        }
      }
      if (best < 0) return {};
      SelectionMove move = state_.EntryOf(best);
      if (move.candidate >= 0) return move;
      values[best] = kNoLimit;  // determined by the terms after all
    }
  }

  SelectionMove FindExit() {
    const bool by_rows = options_.select == Criterion::kPress ||
                         options_.select == Criterion::kCv;
    SelectionMove best;
    double lowest = kNoLimit;
    for (SelectionMove& exit : state_.Exits(by_rows)) {
      if (!MayLeave(exit.candidate)) continue;
      const double value =
          by_rows ? Evaluate(exit).ValueOf(options_.select) : exit.gain;
      if (value < lowest) {
        lowest = value;
        best = std::move(exit);
      }
    }
    if (best.candidate < 0 || by_rows) return best;
    return state_.ExitOf(best.candidate);
  }

  // --- what a move leads to

  SelectionStep Evaluate(const SelectionMove& move) const {
    SelectionStep step;
    step.candidate = move.candidate;
    step.entered = move.enters;
    step.terms = std::ssize(state_.chosen());
    VectorXd residual = state_.residual();
    VectorXd leverage = state_.leverage();
    const double before = state_.residual_sum_of_squares();
    if (move.candidate >= 0) {
      const double sign = move.enters ? 1.0 : -1.0;
      step.terms += move.enters ? 1 : -1;
      if (move.enters) {
        residual -= move.direction.dot(residual) * move.direction;
      } else {
        residual += move.direction.dot(problem_.Weighted(problem_.response)) *
                    move.direction;
      }
      leverage += sign * move.direction.cwiseAbs2();
    }
    const double rss = residual.squaredNorm();
    const double k = static_cast<double>(step.terms) + 1.0;
    step.residual_sum_of_squares = rss;
    if (move.candidate >= 0) {
      const double larger = move.enters ? rss : before;
      const double freedom = n_ - (move.enters ? k : k + 1.0);
      step.f = move.gain / (larger / freedom);
      step.p = stats::FTestPValue(step.f, 1.0, freedom);
    }
    step.aic = Aic(rss, n_, k);
    step.aicc = Aicc(rss, n_, k);
    step.bic = Bic(rss, n_, k);
    step.adjusted_r2 = AdjustedR2(rss, total_, n_, k);
    if (problem_.intercept.size() == 0) step.press = Press(residual, leverage);
    if (!std::isnan(sigma2_)) step.cp = MallowsCp(rss, sigma2_, n_, k);
    if (options_.Uses(Criterion::kCv)) step.cv = CvOf(move);
    return step;
  }

  double CvOf(const SelectionMove& move) const {
    std::vector<Index> terms = state_.chosen();
    if (move.candidate >= 0 && move.enters) terms.push_back(move.candidate);
    if (move.candidate >= 0 && !move.enters) std::erase(terms, move.candidate);
    MatrixXd design(problem_.response.size(), std::ssize(terms) + 1);
    design.col(0) = problem_.InterceptColumn();
    design.rightCols(design.cols() - 1) = problem_.terms(Eigen::all, terms);
    if (problem_.weights.size() != 0) {
      design = problem_.weights.cwiseSqrt().asDiagonal() * design;
    }
    return CrossValidatedError(
        design, problem_.Weighted(problem_.response), rules_.folds);
  }

  // --- ends

  bool Allows(const SelectionStep& step, const SelectionStep& last) const {
    switch (options_.stop) {
      case Criterion::kNone:
        return true;
      case Criterion::kPValue:
        return step.entered ? step.p <= options_.enter
                            : step.p > options_.remove;
      default:
        return step.ValueOf(options_.stop) < last.ValueOf(options_.stop);
    }
  }

  void Choose(const std::vector<std::vector<Index>>& models,
              SelectionResult* result) const {
    result->chosen_step = models.size() - 1;
    if (options_.choose != Criterion::kPValue &&
        options_.choose != Criterion::kNone) {
      double lowest = kNoLimit;
      for (std::size_t i = 0; i < models.size(); ++i) {
        const bool fits = std::ssize(models[i]) <= most_terms_;
        const double value = result->steps[i].ValueOf(options_.choose);
        if (fits && value < lowest) {
          lowest = value;
          result->chosen_step = i;
        }
      }
    }
    result->chosen = models[result->chosen_step];
  }

  const RegressionProblem& problem_;
  const TermRules& rules_;
  const StepwiseOptions& options_;
  SelectionState state_;
  double n_;
  std::vector<bool> open_;
  std::vector<bool> is_included_;
  double sigma2_;
  double total_ = 0.0;
  Index most_terms_ = 0;
  std::string why_none_;
  bool at_most_terms_ = false;
  std::unique_ptr<SweptCandidates> swept_;
  std::vector<std::unique_ptr<SweptCandidates>> swept_folds_;
};

}  // namespace

double SelectionStep::ValueOf(Criterion criterion) const {
  switch (criterion) {
    case Criterion::kPValue:
      return p;
    case Criterion::kAic:
      return aic;
    case Criterion::kAicc:
      return aicc;
    case Criterion::kBic:
      return bic;
    case Criterion::kAdjustedR2:
      return -adjusted_r2;
    case Criterion::kPress:
      return press;
    case Criterion::kCp:
      return cp;
    case Criterion::kCv:
      return cv;
    case Criterion::kNone:
      break;
  }
  return stats::kNaN;
}

bool StepwiseOptions::Uses(Criterion criterion) const {
  return select == criterion || stop == criterion || choose == criterion;
}

void StepwiseOptions::Validate() const {
  const auto refuse = [](const std::string& what) {
    throw std::invalid_argument("StepwiseOptions: " + what);
  };
  stats::Require(enter > 0.0 && enter < 1.0,
                 "StepwiseOptions: enter must be above 0 and below 1",
                 enter);
  stats::Require(remove > 0.0 && remove < 1.0,
                 "StepwiseOptions: remove must be above 0 and below 1",
                 remove);
  if (remove < enter) {
    refuse("remove (" + std::to_string(remove) + ") must not be below enter (" +
           std::to_string(enter) + "): a term could enter and leave for ever");
  }
  stats::Require(std::isnan(sigma2) || (sigma2 > 0.0 && std::isfinite(sigma2)),
                 "StepwiseOptions: sigma2 must be above 0",
                 sigma2);
  if (select == Criterion::kNone) refuse("something must select");
}

SelectionResult SelectStepwise(const RegressionProblem& problem,
                               const TermRules& rules,
                               const StepwiseOptions& options) {
  options.Validate();
  ValidateSelection(problem, "SelectStepwise");
  return Selection(problem, rules, options).Run();
}

std::vector<ExcludedTerm> JudgeExcluded(const RegressionProblem& problem,
                                        const std::vector<Index>& chosen) {
  ValidateSelection(problem, "JudgeExcluded");
  SelectionState state(problem);
  for (const Index candidate : chosen) {
    const SelectionMove move = state.EntryOf(candidate);
    if (move.candidate >= 0) state.Apply(move);
  }
  const double rss = state.residual_sum_of_squares();
  const double freedom = problem.num_observations() -
                         static_cast<double>(state.chosen().size()) - 2.0;
  std::vector<ExcludedTerm> excluded;
  for (Index j = 0; j < problem.terms.cols(); ++j) {
    if (IsInterrupted()) break;
    if (state.is_chosen(j)) continue;
    ExcludedTerm term;
    term.candidate = j;
    const SelectionMove move = state.EntryOf(j);
    term.aliased = move.candidate < 0;
    if (!term.aliased && freedom > 0.0) {
      // From the residual itself: rss - gain cancels if a term fits all.
      const double left =
          (state.residual() -
           move.direction.dot(state.residual()) * move.direction)
              .squaredNorm();
      term.f = rss > 0.0 ? move.gain / (left / freedom) : stats::kNaN;
      term.p = stats::FTestPValue(term.f, 1.0, freedom);
    }
    excluded.push_back(term);
  }
  return excluded;
}

double CrossValidatedError(const MatrixXd& design,
                           const VectorXd& response,
                           const FoldCodes& folds) {
  double sum = 0.0;
  for (const auto& [train, test] : folds.Splits()) {
    const LeastSquaresFit fit =
        SolveLeastSquares(design(train, Eigen::all), response(train));
    sum += (response(test) - design(test, Eigen::all) * fit.coefficients)
               .squaredNorm();
  }
  return sum;
}

}  // namespace errmap::fitting
