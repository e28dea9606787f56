#include "models/net_wfactor.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

namespace errmap::models {
namespace {

// Held-out error of each wfactor tried so far, by half decades of log10.
using Scores = std::map<int, double>;

double WfactorOf(int half_decades) {
  constexpr double kPerDecade = 2.0;
  return std::pow(10.0, half_decades / kPerDecade);
}

// The lowest error; of equal ones the larger wfactor, since it is simpler.
Scores::const_iterator Best(const Scores& scores) {
  auto best = scores.end();
  for (auto it = scores.begin(); it != scores.end(); ++it) {
    if (std::isnan(it->second)) continue;
    if (best == scores.end() || it->second <= best->second) best = it;
  }
  if (best == scores.end()) {
    throw std::invalid_argument(
        "wfactor=cv: no inner hold-out could be fitted; give a number");
  }
  return best;
}

// A fit that a limit has ended goes on from where it was until another run
// lowers the cost by no more than a hundredth: its misfit would otherwise tell
// how long it ran rather than what alpha is.
fitting::Minimum TrainUntilSettled(const NetTrainer& trainer,
                                   const fitting::RunControl& run,
                                   NetTraining* training) {
  constexpr int kMostRuns = 20;
  constexpr double kSettled = 0.99;
  fitting::Minimum minimum = trainer.Train(*training, run);
  for (int i = 1; i < kMostRuns; ++i) {
    if (minimum.summary.termination != fitting::Termination::kIterationLimit) {
      break;
    }
    const double before = minimum.summary.final_cost;
    training->initial_weights = minimum.x;
    minimum = trainer.Train(*training, run);
    if (!(minimum.summary.final_cost < kSettled * before)) break;
  }
  return minimum;
}

}  // namespace

CrossValidatedWfactor ChooseWfactorByCv(const NetDesign& design,
                                        const NetTrainer& trainer,
                                        const data::Dataset& training,
                                        const FitContext& context) {
  constexpr int kLeast = -14;  // 1e-7
  constexpr int kDecade = 2;
  constexpr int kMost = 0;  // 1
  const InnerFolds folds = MakeInnerFolds(training, context.seed);
  Scores scores;
  const auto judge = [&](const std::vector<int>& exponents) {
    std::vector<NetTrial> trials;
    for (const int exponent : exponents) {
      trials.push_back({WfactorOf(exponent), context.seed});
    }
    const std::vector<double> rmse =
        InnerHoldoutRmse(design, trainer, training, folds, trials, context);
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      scores[exponents[i]] = rmse[i];
    }
  };
  std::vector<int> decades;
  for (int i = kLeast; i <= kMost; i += kDecade) decades.push_back(i);
  judge(decades);
  const int coarse = Best(scores)->first;
  judge({coarse - 1, coarse + 1});

  const auto best = Best(scores);
  CrossValidatedWfactor chosen{
      WfactorOf(best->first), best->second, folds.text, ""};
  for (const auto& [exponent, rmse] : scores) {
    if (!chosen.scores.empty()) chosen.scores += ", ";
    chosen.scores += fmt::format("{:.2g}: {:.4g}", WfactorOf(exponent), rmse);
  }
  return chosen;
}

fitting::DiscrepancyChoice ChooseWfactorByDiscrepancy(
    const NetRows& rows,
    const NetTrainer& trainer,
    double delta,
    const FitContext& context) {
  const fitting::RunControl run{.stop = context.stop,
                                .keep_trace = context.keep_trace};
  NetTraining training = rows.From(context.seed, 0.0);
  const Eigen::VectorXd start = training.initial_weights;
  return fitting::ChooseByDiscrepancy(
      {.delta = delta},
      start,
      [&](double wfactor, const Eigen::VectorXd& from) {
        training.wfactor = wfactor;
        training.initial_weights = from;
        return TrainUntilSettled(trainer, run, &training);
      },
      [&](const Eigen::VectorXd& w) { return rows.TrainingRms(w); });
}

}  // namespace errmap::models
