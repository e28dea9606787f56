#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fitting/minimisers/discrepancy_principle.h"
#include "models/net/net_fit.h"

namespace errmap::models {

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
  std::shared_ptr<const NetTrainer> full;
  /// Compare the wfactors of a tuned net. `along_path` is like `full`, in
  /// single precision if the method has one. `brief` is shorter and may suffice
  /// for the fit. If both are null, `full` compares.
  std::shared_ptr<const NetTrainer> along_path;
  std::shared_ptr<const NetTrainer> brief;
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

/// Returns the numbers of hidden nodes that hidden=cv tries for a fit of so
/// many rows: 5, 10, 20, 40 and 60, those above 5 only with at least 4 rows per
/// node. (P - 1 nodes can reproduce any P targets.)
std::vector<std::int64_t> HiddenToTry(Eigen::Index rows);

/// Returns the fewest nodes whose error is at most 5 % above the least, and
/// that error, from errors by number of nodes (NaN: not judged). Throws
/// std::invalid_argument if there is no error.
std::pair<std::int64_t, double> FewestGoodNodes(
    const std::vector<std::pair<std::int64_t, double>>& scores);

/// Chooses by the pooled error on the inner hold-outs of MakeInnerFolds. Every
/// fit starts from the weights of context.seed.
///
/// wfactor: goes down WfactorPath until three more values (whole decades: two)
/// bring no lower error, or a rival is out of reach; of equal errors takes the
/// larger. Along the path a fit continues the last, so all of them cost little
/// more than one. Else each starts anew and trains briefly, whole decades
/// first, then the half decades beside the best. The choice is then also
/// trained in full, and the iterations with the lower error are taken (early
/// stopping). Hidden nodes: the fewest of HiddenToTry whose error is at most 5
/// % above the least, about the effect of another start. Both: wfactor with the
/// design's nodes (or the most below them that are tried), then the nodes with
/// that wfactor, then, if their number changed, the wfactor again; the
/// iterations last. Throws std::invalid_argument if none could be judged.
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
