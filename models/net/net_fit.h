#pragma once

#include <cstdint>
#include <vector>

#include "data/measurements/dataset.h"
#include "fitting/minimisers/optimizer.h"
#include "models/error_model.h"
#include "models/inner_folds.h"
#include "models/net/net_design.h"
#include "models/net/net_trainer.h"
#include "models/scaling.h"

namespace errmap::models {

/// Training rows as a net sees them, and the way back to physical units.
struct NetRows {
  ColumnScaling scaling;
  TargetScaling target;
  NetTraining training;  // wfactor, initial weights and seed not yet set

  /// `training` from the start of that seed.
  NetTraining From(std::uint64_t seed, double wfactor) const;
  /// RMS residual of these rows at the weights w (N), in the target's unit;
  /// weighted as the cost is.
  double TrainingRms(const Eigen::VectorXd& w) const;
  /// The net of these weights in the rows' own units.
  NetForm FormOf(const Eigen::VectorXd& w) const;
  /// The weights (N) of a net that FormOf made, but for roundings.
  Eigen::VectorXd WeightsOf(const NetForm& form) const;
};

/// Throws std::invalid_argument where the targets do not vary.
NetRows ScaleRows(const NetDesign& design, const data::Dataset& training);

/// Seed of start k (0-based): start 0 is that of the fit itself.
std::uint64_t SeedOfStart(std::uint64_t seed, std::int64_t k);

/// Wfactors of a path from strong to weak: 1 and every half decade below it,
/// down to 1e-7.
const std::vector<double>& WfactorPath();

/// The beginning of WfactorPath that is above `wfactor`, then `wfactor`.
std::vector<double> WfactorPathTo(double wfactor);

/// A net to be judged by inner hold-outs.
struct NetTrial {
  std::int64_t hidden = 1;       // in place of the design's
  std::vector<double> wfactors;  // trained along, see TrainAlong
  std::uint64_t seed = 1;
};

/// So many rows stand for all where nets are compared, and on the way to one.
inline constexpr Eigen::Index kMostTuningRows = 5'000;

/// Trains at each of `wfactors` in turn, the first from the start of `seed`,
/// each other from the weights of the one before. Of more rows than
/// kMostTuningRows, two wfactors or more: at all but the first on so many of
/// the rows, drawn from all over them, then at the last again on all. The
/// summary is that of the last, but for the counts, seconds and trace, which
/// are those of all. Throws std::invalid_argument where there are no wfactors.
fitting::Minimum TrainAlong(const NetRows& rows,
                            const NetTrainer& trainer,
                            const std::vector<double>& wfactors,
                            std::uint64_t seed,
                            const fitting::RunControl& run);

/// A net on inner folds whose wfactor falls from step to step.
class WfactorWalk {
 public:
  /// Each step trains from the weights of the last where `warm`, else from the
  /// start of `seed`. What is given must outlive the walk.
  WfactorWalk(const NetDesign& design,
              const NetTrainer& trainer,
              const data::Dataset& training,
              const InnerFolds& folds,
              std::uint64_t seed,
              bool warm,
              const FitContext& context);
  ~WfactorWalk();
  WfactorWalk(const WfactorWalk&) = delete;
  WfactorWalk& operator=(const WfactorWalk&) = delete;

  /// Trains at `wfactor`: the RMSE on the rows left out, as InnerHoldoutRmse.
  double Step(double wfactor);

 private:
  struct Fold;
  std::vector<Fold> folds_;
  const NetTrainer& trainer_;
  const InnerFolds& inner_;
  const FitContext& context_;
  std::uint64_t seed_;
  bool warm_;
};

/// Of each trial the RMSE on the rows left out of its fits, all folds pooled,
/// in the target's unit; NaN where one of its fits failed. Runs on
/// context.threads, which changes no bit.
std::vector<double> InnerHoldoutRmse(const NetDesign& design,
                                     const NetTrainer& trainer,
                                     const data::Dataset& training,
                                     const InnerFolds& folds,
                                     const std::vector<NetTrial>& trials,
                                     const FitContext& context);

/// The minima of TrainAlong from the starts of these seeds, in their order; on
/// context.threads, which changes no bit. Where context.stop comes, those of
/// the seeds that were begun, the first among them; others are taken out of
/// `seeds`.
std::vector<fitting::Minimum> TrainFromStarts(
    const NetRows& rows,
    const NetTrainer& trainer,
    const std::vector<double>& wfactors,
    std::vector<std::uint64_t>* seeds,
    const FitContext& context);

}  // namespace errmap::models
