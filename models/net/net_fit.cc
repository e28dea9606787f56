#include "models/net/net_fit.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "fitting/interruption.h"
#include "fitting/parallel_for.h"
#include "models/net/feedforward_net.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

using data::Dataset;
ColumnScaling ScalingOf(InputScaling kind, const MatrixXd& inputs) {
  switch (kind) {
    case InputScaling::kStandard:
      return StandardScaling(inputs);
    case InputScaling::kRange:
      return UnitRangeScaling(inputs);
    case InputScaling::kNone:
      break;
  }
  return IdentityScaling(inputs.cols());
}

// Sum of squared errors of the net of these weights on `test`.
double SquaresOn(const Dataset& test,
                 const NetRows& rows,
                 const VectorXd& weights) {
  return (test.target_values() -
          FeedforwardNet(rows.FormOf(weights)).Predict(test.input_values()))
      .squaredNorm();
}

// Sum of squared errors on the test rows; NaN if there is no fit.
double HeldOutSquares(const NetDesign& design,
                      const NetTrainer& trainer,
                      const Dataset& all,
                      const fitting::FoldCodes::Rows& fold,
                      const NetTrial& trial) {
  if (fitting::IsInterrupted()) return stats::kNaN;
  try {
    NetDesign tried = design;
    tried.hidden = trial.hidden;
    const NetRows rows = ScaleRows(tried, all.SelectRows(fold.train));
    const fitting::Minimum minimum = TrainAlong(
        rows, trainer, trial.wfactors, trial.seed, {.keep_trace = false});
    if (minimum.summary.termination == fitting::Termination::kFailed) {
      return stats::kNaN;
    }
    return SquaresOn(all.SelectRows(fold.test), rows, minimum.x);
  } catch (const std::invalid_argument&) {
    // These rows cannot be fitted, such as a constant target.
    return stats::kNaN;
  }
}

// `all`, but for the rows that are not among `taken`.
NetTraining RowsOf(const NetTraining& all, const std::vector<Index>& taken) {
  return {.shape = all.shape,
          .inputs = all.inputs(taken, Eigen::all),
          .targets = all.targets(taken, Eigen::all),
          .row_weights = all.row_weights.size() == 0
                             ? VectorXd()
                             : VectorXd(all.row_weights(taken)),
          .wfactor = all.wfactor,
          .initial_weights = all.initial_weights,
          .seed = all.seed};
}

// The work of `earlier` steps in front of that of `last`.
void Precede(const fitting::FitSummary& earlier, fitting::FitSummary* last) {
  for (fitting::TracePoint& point : last->trace) {
    point.iteration += earlier.iterations;
  }
  last->trace.insert(
      last->trace.begin(), earlier.trace.begin(), earlier.trace.end());
  last->iterations += earlier.iterations;
  last->value_evaluations += earlier.value_evaluations;
  last->gradient_evaluations += earlier.gradient_evaluations;
  last->curvature_evaluations += earlier.curvature_evaluations;
  last->seconds += earlier.seconds;
}

}  // namespace

NetTraining NetRows::From(std::uint64_t seed, double wfactor) const {
  NetTraining from = training;
  from.wfactor = wfactor;
  from.seed = seed;
  from.initial_weights = InitialWeights(training.shape, seed);
  return from;
}

double NetRows::TrainingRms(const VectorXd& w) const {
  constexpr double kNoDecay = 0.0;
  const NetObjective misfit(training.shape,
                            training.inputs,
                            training.targets,
                            kNoDecay,
                            training.row_weights);
  return std::sqrt(2.0 * misfit.Evaluate(w, nullptr)) / std::abs(target.slope);
}

NetForm NetRows::FormOf(const VectorXd& w) const {
  return FormOfWeights(training.shape, w, scaling, target);
}

VectorXd NetRows::WeightsOf(const NetForm& form) const {
  const NetShape& shape = training.shape;
  VectorXd w(shape.num_weights());
  w << form.w1.reshaped() / shape.slope,
      form.w2.reshaped() / OutputSlope(shape);
  return w;
}

NetRows ScaleRows(const NetDesign& design, const Dataset& training) {
  NetRows rows;
  rows.scaling = ScalingOf(design.scaling, training.input_values());
  rows.target = SigmoidTargetScaling(training.target_values());
  rows.training.shape = design.ShapeFor(training);
  rows.training.inputs = rows.scaling.Apply(training.input_values());
  rows.training.targets =
      (training.target_values() * rows.target.slope).array() +
      rows.target.offset;
  rows.training.row_weights = training.weights();
  return rows;
}

std::uint64_t SeedOfStart(std::uint64_t seed, std::int64_t k) {
  if (k == 0) return seed;
  // SplitMix64 (Steele, Lea & Flood 2014): neighbouring seeds and starts give
  // numbers that have nothing in common.
  std::uint64_t z =
      seed + static_cast<std::uint64_t>(k) * 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  // 53 bits: every reader of JSON keeps them.
  return (z ^ (z >> 31U)) >> 11U;
}

const std::vector<double>& WfactorPath() {
  static const std::vector<double> path = [] {
    constexpr double kPerDecade = 2.0;
    constexpr int kDecades = 7;
    std::vector<double> all;
    for (int half = 0; half <= kDecades * 2; ++half) {
      all.push_back(std::pow(10.0, -half / kPerDecade));
    }
    return all;
  }();
  return path;
}

std::vector<double> WfactorPathTo(double wfactor) {
  std::vector<double> path;
  for (const double step : WfactorPath()) {
    if (step > wfactor) path.push_back(step);
  }
  path.push_back(wfactor);
  return path;
}

fitting::Minimum TrainAlong(const NetRows& rows,
                            const NetTrainer& trainer,
                            const std::vector<double>& wfactors,
                            std::uint64_t seed,
                            const fitting::RunControl& run) {
  if (wfactors.empty()) throw std::invalid_argument("TrainAlong: no wfactor");
  const Index count = rows.training.inputs.rows();
  const bool walks_on_few = wfactors.size() > 1 && count > kMostTuningRows;
  std::vector<double> steps = wfactors;
  if (walks_on_few) {  // the last twice, in place of the first
    steps.erase(steps.begin());
    steps.push_back(steps.back());
  }
  NetTraining all = rows.From(seed, steps.front());
  NetTraining few;
  if (walks_on_few) few = RowsOf(all, StratifiedRows(count, kMostTuningRows));
  fitting::Minimum minimum = trainer(walks_on_few ? few : all, run);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const fitting::Termination end = minimum.summary.termination;
    if (end == fitting::Termination::kFailed ||
        end == fitting::Termination::kInterrupted) {
      break;
    }
    NetTraining& step = walks_on_few && i + 1 < steps.size() ? few : all;
    step.wfactor = steps[i];
    step.initial_weights = std::move(minimum.x);
    const fitting::FitSummary earlier = std::move(minimum.summary);
    minimum = trainer(step, run);
    Precede(earlier, &minimum.summary);
  }
  return minimum;
}

std::vector<double> InnerHoldoutRmse(const NetDesign& design,
                                     const NetTrainer& trainer,
                                     const Dataset& training,
                                     const InnerFolds& folds,
                                     const std::vector<NetTrial>& trials,
                                     const FitContext& context) {
  const std::vector<fitting::FoldCodes::Rows> split = folds.folds.Splits();
  const auto count = std::ssize(split);
  VectorXd rows(count);
  for (Index fold = 0; fold < count; ++fold) {
    rows[fold] =
        static_cast<double>(split[static_cast<std::size_t>(fold)].test.size());
  }
  MatrixXd squares(count, std::ssize(trials));
  fitting::ParallelFor(
      context.threads, trials.size() * split.size(), [&](std::size_t job) {
        squares.reshaped()[static_cast<Index>(job)] =
            HeldOutSquares(design,
                           trainer,
                           training,
                           split[job % split.size()],
                           trials[job / split.size()]);
      });
  std::vector<double> rmse;
  for (Index trial = 0; trial < squares.cols(); ++trial) {
    rmse.push_back(
        TypicalRmse(folds, squares.col(trial), rows, context.indifference));
  }
  return rmse;
}

struct WfactorWalk::Fold {
  std::optional<NetRows> rows;  // none where they cannot be fitted
  Dataset test;
  VectorXd weights;              // of the last step
  double squares = stats::kNaN;  // of the last step
};

WfactorWalk::WfactorWalk(const NetDesign& design,
                         const NetTrainer& trainer,
                         const Dataset& training,
                         const InnerFolds& folds,
                         std::uint64_t seed,
                         bool warm,
                         const FitContext& context)
    : trainer_(trainer),
      inner_(folds),
      context_(context),
      seed_(seed),
      warm_(warm) {
  for (const fitting::FoldCodes::Rows& split : folds.folds.Splits()) {
    Fold fold{.rows = std::nullopt,
              .test = training.SelectRows(split.test),
              .weights = {}};
    try {
      fold.rows = ScaleRows(design, training.SelectRows(split.train));
      fold.weights = InitialWeights(fold.rows->training.shape, seed);
    } catch (const std::invalid_argument&) {
      fold.rows.reset();  // such as a constant target
    }
    folds_.push_back(std::move(fold));
  }
}

WfactorWalk::~WfactorWalk() = default;

double WfactorWalk::Step(double wfactor) {
  fitting::ParallelFor(context_.threads, folds_.size(), [&](std::size_t job) {
    Fold& fold = folds_[job];
    if (!fold.rows) return;
    NetTraining training = fold.rows->From(seed_, wfactor);
    if (warm_) training.initial_weights = fold.weights;
    fitting::Minimum minimum = trainer_(training, {.keep_trace = false});
    if (minimum.summary.termination == fitting::Termination::kFailed) {
      fold.rows.reset();
      fold.squares = stats::kNaN;
      return;
    }
    fold.squares = SquaresOn(fold.test, *fold.rows, minimum.x);
    fold.weights = std::move(minimum.x);
  });
  VectorXd squares(std::ssize(folds_));
  VectorXd rows(squares.size());
  for (Index fold = 0; fold < squares.size(); ++fold) {
    const Fold& from = folds_[static_cast<std::size_t>(fold)];
    squares[fold] = from.squares;
    rows[fold] = static_cast<double>(from.test.num_rows());
  }
  return TypicalRmse(inner_, squares, rows, context_.indifference);
}

std::vector<fitting::Minimum> TrainFromStarts(
    const NetRows& rows,
    const NetTrainer& trainer,
    const std::vector<double>& wfactors,
    std::vector<std::uint64_t>* seeds,
    const FitContext& context) {
  std::vector<fitting::Minimum> minima(seeds->size());
  fitting::ParallelFor(context.threads, seeds->size(), [&](std::size_t i) {
    if (i > 0 && fitting::IsInterrupted()) return;
    minima[i] = TrainAlong(rows,
                           trainer,
                           wfactors,
                           (*seeds)[i],
                           {.keep_trace = context.keep_trace});
  });
  std::vector<std::uint64_t> begun;
  for (std::size_t i = 0; i < minima.size(); ++i) {
    if (minima[i].x.size() != 0) begun.push_back((*seeds)[i]);
  }
  std::erase_if(minima,
                [](const auto& minimum) { return minimum.x.size() == 0; });
  *seeds = std::move(begun);
  return minima;
}

}  // namespace errmap::models
