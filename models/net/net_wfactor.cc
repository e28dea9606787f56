#include "models/net/net_wfactor.h"

namespace errmap::models {
namespace {

// Continues a fit ended by a limit until another run lowers the cost by at most
// a hundredth. Otherwise its misfit would depend on the length of the run
// instead of on alpha.
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
