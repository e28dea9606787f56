#include "models/net/net_fit.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "models/net/feedforward_net.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Every job writes to a place of its own, so their order does not matter.
template <typename Job>
void RunJobs(std::size_t count, int threads, const Job& job) {
  if (threads <= 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) job(i);
    return;
  }
  oneapi::tbb::task_arena arena(threads);
  arena.execute([&] { oneapi::tbb::parallel_for(std::size_t{0}, count, job); });
}

ColumnScaling ScalingOf(InputScaling kind, const Eigen::MatrixXd& inputs) {
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

// Sum of squared errors on the test rows; NaN where there is no fit.
double HeldOutSquares(const NetDesign& design,
                      const NetTrainer& trainer,
                      const Dataset& all,
                      const fitting::FoldCodes::Rows& fold,
                      const NetTrial& trial,
                      const FitContext& context) {
  try {
    NetDesign tried = design;
    tried.hidden = trial.hidden;
    const NetRows rows = ScaleRows(tried, all.SelectRows(fold.train));
    const fitting::Minimum minimum =
        trainer.Train(rows.From(trial.seed, trial.wfactor),
                      {.stop = context.stop, .keep_trace = false});
    if (minimum.summary.termination == fitting::Termination::kFailed) {
      return kNaN;
    }
    const Dataset test = all.SelectRows(fold.test);
    return (test.target_values() -
            FeedforwardNet(rows.FormOf(minimum.x)).Predict(test.input_values()))
        .squaredNorm();
  } catch (const std::invalid_argument&) {
    return kNaN;  // these rows cannot be fitted, such as a constant target
  }
}

}  // namespace

const std::vector<std::string>& InputScalingNames() {
  static const std::vector<std::string> names = {"standard", "range", "none"};
  return names;
}

NetTraining NetRows::From(std::uint64_t seed, double wfactor) const {
  NetTraining from = training;
  from.wfactor = wfactor;
  from.seed = seed;
  from.initial_weights = InitialWeights(training.shape, seed);
  return from;
}

double NetRows::TrainingRms(const Eigen::VectorXd& w) const {
  constexpr double kNoDecay = 0.0;
  const NetObjective misfit(training.shape,
                            training.inputs,
                            training.targets,
                            kNoDecay,
                            training.row_weights);
  return std::sqrt(2.0 * misfit.Evaluate(w, nullptr)) / std::abs(target.slope);
}

NetForm NetRows::FormOf(const Eigen::VectorXd& w) const {
  const NetShape& shape = training.shape;
  // A slope c multiplies every sum that a sigmoid sees: so may the weights.
  return {.input_offset = scaling.offset,
          .input_scale = scaling.scale,
          .w1 = shape.slope * FirstLayer(shape, w),
          .w2 = OutputSlope(shape) * SecondLayer(shape, w),
          .output = shape.output,
          .target_slope = Eigen::VectorXd::Constant(1, target.slope),
          .target_offset = Eigen::VectorXd::Constant(1, target.offset)};
}

Eigen::VectorXd NetRows::WeightsOf(const NetForm& form) const {
  const NetShape& shape = training.shape;
  Eigen::VectorXd w(shape.num_weights());
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

std::vector<double> InnerHoldoutRmse(const NetDesign& design,
                                     const NetTrainer& trainer,
                                     const Dataset& training,
                                     const InnerFolds& folds,
                                     const std::vector<NetTrial>& trials,
                                     const FitContext& context) {
  std::vector<fitting::FoldCodes::Rows> split;
  for (Index fold = folds.folds.first_judged(); fold < folds.folds.count();
       ++fold) {
    split.push_back(folds.folds.Split(fold));
  }
  Eigen::VectorXd rows(static_cast<Index>(split.size()));
  for (std::size_t fold = 0; fold < split.size(); ++fold) {
    rows[static_cast<Index>(fold)] =
        static_cast<double>(split[fold].test.size());
  }
  std::vector<double> squares(trials.size() * split.size());
  RunJobs(squares.size(), context.threads, [&](std::size_t job) {
    squares[job] = HeldOutSquares(design,
                                  trainer,
                                  training,
                                  split[job % split.size()],
                                  trials[job / split.size()],
                                  context);
  });
  std::vector<double> rmse;
  for (std::size_t trial = 0; trial < trials.size(); ++trial) {
    Eigen::VectorXd means(static_cast<Index>(split.size()));
    for (std::size_t fold = 0; fold < split.size(); ++fold) {
      const auto at = static_cast<Index>(fold);
      means[at] = squares[trial * split.size() + fold] / rows[at];
    }
    rmse.push_back(std::sqrt(
        TypicalError(folds, means, rows, context.indifference).mean_square));
  }
  return rmse;
}

std::vector<fitting::Minimum> TrainFromStarts(
    const NetRows& rows,
    const NetTrainer& trainer,
    double wfactor,
    const std::vector<std::uint64_t>& seeds,
    const FitContext& context) {
  std::vector<fitting::Minimum> minima(seeds.size());
  RunJobs(seeds.size(), context.threads, [&](std::size_t i) {
    minima[i] =
        trainer.Train(rows.From(seeds[i], wfactor),
                      {.stop = context.stop, .keep_trace = context.keep_trace});
  });
  return minima;
}

}  // namespace errmap::models
