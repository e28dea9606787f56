#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "data/measurements/dataset.h"
#include "fitting/minimisers/discrepancy_principle.h"
#include "fitting/minimisers/optimizer.h"
#include "models/error_model.h"
#include "models/inner_folds.h"
#include "models/net/net_design.h"
#include "models/net/net_trainer.h"
#include "models/scaling.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Training rows scaled for a net, and the conversion back to physical units.
struct NetRows {
  ColumnScaling scaling;
  TargetScaling target;
  NetTraining training;  // wfactor, initial weights and seed not yet set

  /// Returns `training` with the initial weights of `seed`.
  NetTraining From(std::uint64_t seed, double wfactor) const;
  /// Returns the RMS residual of these rows for the weights w (N), in the
  /// target's unit, weighted like the cost.
  double TrainingRms(const VectorXd& w) const;
  /// Returns the net with these weights in the units of the rows.
  NetForm FormOf(const VectorXd& w) const;
  /// Returns the weights (N) of a net made by FormOf, up to rounding.
  VectorXd WeightsOf(const NetForm& form) const;
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

/// Most rows used to compare nets and for all but the last fit along a path.
inline constexpr Index kMostTuningRows = 5'000;

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
  /// Each step continues from the last weights if `warm`, else it begins at the
  /// start of `seed`. All arguments must outlive this object.
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
/// interrupted, it returns those of the seeds already started, always including
/// the first, and removes the others from `seeds`.
std::vector<fitting::Minimum> TrainFromStarts(
    const NetRows& rows,
    const NetTrainer& trainer,
    const std::vector<double>& wfactors,
    std::vector<std::uint64_t>* seeds,
    const FitContext& context);

/// Returns at most `most` representative rows of `training`, ascending; all if
/// there are no more. Takes whole groups if enough of them fit: one drawn from
/// each stretch of groups in file order. Else takes one row drawn from each
/// stretch of rows, since regular steps might hit the same positions
/// repeatedly. The draw depends only on `training` and `most`. Throws
/// std::invalid_argument if most < 1.
std::vector<Index> StratifiedRows(const data::Dataset& training, Index most);

/// Returns the same for `count` rows without groups.
std::vector<Index> StratifiedRows(Index count, Index most);

/// Options of a net that inner hold-outs choose, and those that are fixed.
struct NetTuning {
  bool hidden = false;   // else the design's
  bool wfactor = false;  // else the one below
  double fixed_wfactor = 0.0;
  bool along_path = false;  // true: fits TrainAlong WfactorPathTo
  /// RMSE of a rival (kOutOfReach).
  double rival = std::numeric_limits<double>::infinity();
};

/// The trainers of a recipe's fits.
struct NetTrainers {
  NetTrainer full;
  /// Used to compare the wfactors of a tuned net. `along_path` is like `full`,
  /// in single precision if the method has it. `brief` is shorter and may
  /// suffice for the fit. If both are empty, `full` is used.
  NetTrainer along_path;
  NetTrainer brief;
  std::int64_t full_iterations = 0;
  std::int64_t brief_iterations = 0;
};

/// One chosen value.
struct TunedValue {
  EffectiveOption choice;  // {"wfactor", 1e-3}
  std::string text;        // "wfactor 0.001"
  double rmse = 0.0;       // held out, in the target's unit
  std::string scores;      // "1e-07: 0.00031, ...": all values tried
};

struct TunedNet {
  std::int64_t hidden = 0;
  double wfactor = 0.0;
  std::int64_t iterations = 0;     // of one of NetTrainers; 0: of `full`
  double rmse = 0.0;               // held out, of the choice
  std::string folds;               // "groups:5 of cycle"
  std::vector<TunedValue> chosen;  // hidden, wfactor, iterations
};

/// Returns the numbers of hidden nodes that hidden=cv tries for a fit of this
/// many rows: 5, 10, 20, 40 and 60, those above 5 only with at least 4 rows per
/// node. (P - 1 nodes can reproduce any P targets.)
std::vector<std::int64_t> HiddenToTry(Index rows);

/// Takes errors by number of nodes (NaN: not tested). Returns the fewest nodes
/// whose error is at most 5 % above the least, and that error. Throws
/// std::invalid_argument if there is no error.
std::pair<std::int64_t, double> FewestGoodNodes(
    const std::vector<std::pair<std::int64_t, double>>& scores);

/// Chooses by the pooled error on the inner hold-outs of MakeInnerFolds. Every
/// fit starts from the weights of context.seed.
///
/// wfactor: goes down WfactorPath until three more values (whole decades: two)
/// give no lower error, or a rival is out of reach; of equal errors it takes
/// the larger wfactor. Along the path each fit continues the last one, so all
/// of them cost little more than one. Otherwise each fit starts again and
/// trains briefly, whole decades first, then the half decades beside the best.
/// The choice is then also trained in full, and the number of iterations with
/// the lower error is taken (early stopping). Hidden nodes: the fewest of
/// HiddenToTry whose error is at most 5 % above the least, which is about the
/// effect of another start. Both: first wfactor with the design's nodes (or the
/// most tried below them), then the nodes with that wfactor. If their number
/// changed, then wfactor again; last the iterations. Throws
/// std::invalid_argument if no option could be tested.
TunedNet TuneNet(const NetDesign& design,
                 const NetTuning& tuning,
                 const NetTrainers& trainers,
                 const data::Dataset& training,
                 const FitContext& context);

/// Returns the wfactors of a fit at `wfactor`: the path to it, or only itself.
std::vector<double> WfactorsOf(double wfactor, bool along_path);

/// Returns the largest wfactor whose fit has an RMS residual of at most
/// `delta`, in the target's unit, on the training rows.
fitting::DiscrepancyChoice ChooseWfactorByDiscrepancy(
    const NetRows& rows,
    const NetTrainer& trainer,
    double delta,
    const FitContext& context);

}  // namespace errmap::models
