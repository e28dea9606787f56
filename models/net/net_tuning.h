#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "models/net/net_fit.h"

namespace errmap::models {

/// What of a net the inner hold-outs choose, and what is fixed.
struct NetTuning {
  bool hidden = false;   // else that of the design
  bool wfactor = false;  // else the one below
  double fixed_wfactor = 0.0;
  bool along_path = false;  // each fit as TrainAlong WfactorPathTo its wfactor
  /// RMSE of a rival (out_of_reach.h).
  double rival = std::numeric_limits<double>::infinity();
};

/// The trainers of a recipe's fits.
struct NetTrainers {
  std::shared_ptr<const NetTrainer> full;
  /// Of a tuned net: compares wfactors. Along a path it is as `full`, in single
  /// precision where the method has one; else brief, and may be all that the
  /// fit needs. Null: `full` compares.
  std::shared_ptr<const NetTrainer> along_path;
  std::shared_ptr<const NetTrainer> brief;
  std::int64_t full_iterations = 0;
  std::int64_t brief_iterations = 0;
};

/// One thing that was chosen.
struct TunedValue {
  EffectiveOption choice;  // {"wfactor", 1e-3}
  std::string text;        // "wfactor 0.001"
  double rmse = 0.0;       // held out, in the target's unit
  std::string scores;      // "1e-07: 0.00031, ...": all that were tried
};

struct TunedNet {
  std::int64_t hidden = 0;
  double wfactor = 0.0;
  std::int64_t iterations = 0;     // of one of NetTrainers; 0: of `full`
  double rmse = 0.0;               // held out, of what was chosen
  std::string folds;               // "groups:5 of cycle"
  std::vector<TunedValue> chosen;  // hidden, wfactor, iterations
};

/// Numbers of hidden nodes that hidden=cv tries for a fit of so many rows: 5,
/// 10, 20, 40 and 60, those above 5 while each node has at least 4 rows. (P - 1
/// nodes can reproduce any P targets.)
std::vector<std::int64_t> HiddenToTry(Eigen::Index rows);

/// Of errors by number of nodes (NaN: not judged) the fewest nodes whose error
/// is at most 5 % above the least, with it. Throws std::invalid_argument where
/// none is.
std::pair<std::int64_t, double> FewestGoodNodes(
    const std::vector<std::pair<std::int64_t, double>>& scores);

/// Chooses by the pooled error on the inner hold-outs of MakeInnerFolds; every
/// fit starts from the weights of context.seed.
///
/// wfactor: down WfactorPath, until three more (whole decades: two) bring no
/// lower error or a rival is out of reach; of equal errors the larger. Along
/// the path a fit goes on from the last, so that all of them cost little more
/// than one. Else each starts anew and trains briefly, whole decades first,
/// then the half ones beside the best; what was chosen then trains in full,
/// too, and is taken with the iterations that err less (early stopping). Hidden
/// nodes: the fewest of HiddenToTry whose error is at most 5 % above the least,
/// which is what another start alone changes. Both: wfactor with the design's
/// nodes (or the most below them that are tried), then the nodes with that
/// wfactor, then, if their number changed, the wfactor again; the iterations
/// last. Throws std::invalid_argument where none could be judged.
TunedNet TuneNet(const NetDesign& design,
                 const NetTuning& tuning,
                 const NetTrainers& trainers,
                 const data::Dataset& training,
                 const FitContext& context);

/// The wfactors of a fit at `wfactor`: the path to it, or it alone.
std::vector<double> WfactorsOf(double wfactor, bool along_path);

}  // namespace errmap::models
