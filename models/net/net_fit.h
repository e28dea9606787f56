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

/// Training rows as scaled for a net, and the way back to physical units.
struct NetRows {
  ColumnScaling scaling;
  TargetScaling target;
  NetTraining training;  // wfactor, initial weights and seed not yet set

  /// Returns `training` with the initial weights of `seed`.
  NetTraining From(std::uint64_t seed, double wfactor) const;
  /// Returns the RMS residual of these rows for the weights w (N), in the
  /// target's unit, weighted like the cost.
  double TrainingRms(const Eigen::VectorXd& w) const;
  /// Returns the net with these weights in the units of the rows.
  NetForm FormOf(const Eigen::VectorXd& w) const;
  /// Returns the weights (N) of a net made by FormOf, up to rounding.
  Eigen::VectorXd WeightsOf(const NetForm& form) const;
};

/// Throws std::invalid_argument if the targets do not vary.
NetRows ScaleRows(const NetDesign& design, const data::Dataset& training);

/// Returns the seed of start k (0-based); start 0 has the seed of the fit.
std::uint64_t SeedOfStart(std::uint64_t seed, std::int64_t k);

/// Returns the wfactors of a path from strong to weak: from 1 down to 1e-7 in
/// steps of half a decade.
const std::vector<double>& WfactorPath();

/// Returns the values of WfactorPath above `wfactor`, then `wfactor`.
std::vector<double> WfactorPathTo(double wfactor);

/// A net to be assessed on inner hold-outs.
struct NetTrial {
  std::int64_t hidden = 1;       // instead of the design's
  std::vector<double> wfactors;  // trained along, see TrainAlong
  std::uint64_t seed = 1;
};

/// Most rows used to compare nets, and in all but the last fit along a path.
inline constexpr Eigen::Index kMostTuningRows = 5'000;

/// Trains at each of `wfactors` in turn: first from the start of `seed`, then
/// from the previous weights. With more than kMostTuningRows rows and at least
/// two wfactors, all but the first use that many rows, spread over all. The
/// last is then repeated on all rows. The summary is that of the last fit, with
/// counts, seconds and trace of all. Throws std::invalid_argument if there are
/// no wfactors.
fitting::Minimum TrainAlong(const NetRows& rows,
                            const NetTrainer& trainer,
                            const std::vector<double>& wfactors,
                            std::uint64_t seed,
                            const fitting::RunControl& run);

/// A net on inner folds whose wfactor decreases from step to step.
class WfactorWalk {
 public:
  /// Each step trains from the last weights if `warm`, else from the start of
  /// `seed`. All arguments must outlive the walk.
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

  /// Trains at `wfactor`; returns the held-out RMSE like InnerHoldoutRmse.
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

/// Returns, for each trial, the RMSE on held-out rows, pooled over all folds,
/// in the target's unit; NaN if one of its fits failed. Runs on
/// context.threads; their number does not change any bit.
std::vector<double> InnerHoldoutRmse(const NetDesign& design,
                                     const NetTrainer& trainer,
                                     const data::Dataset& training,
                                     const InnerFolds& folds,
                                     const std::vector<NetTrial>& trials,
                                     const FitContext& context);

/// Returns the minima of TrainAlong from the starts of these seeds, in their
/// order. Runs on context.threads; their number does not change any bit. If
/// context.stop becomes true, it returns those of the seeds already started,
/// always including the first, and removes the others from `seeds`.
std::vector<fitting::Minimum> TrainFromStarts(
    const NetRows& rows,
    const NetTrainer& trainer,
    const std::vector<double>& wfactors,
    std::vector<std::uint64_t>* seeds,
    const FitContext& context);

}  // namespace errmap::models
