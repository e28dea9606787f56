#pragma once

#include <cstdint>
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
};

/// One thing that was chosen.
struct TunedValue {
  EffectiveOption choice;  // {"wfactor", 1e-3}
  double rmse = 0.0;       // held out, in the target's unit
  std::string scores;      // "1e-07: 0.00031, ...": all that were tried
};

struct TunedNet {
  std::int64_t hidden = 0;
  double wfactor = 0.0;
  double rmse = 0.0;               // held out, of what was chosen
  std::string folds;               // "groups:5 of cycle"
  std::vector<TunedValue> chosen;  // hidden before wfactor
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
/// wfactor: down WfactorPath, until four steps in a row bring no lower error;
/// of equal errors the larger wfactor. Along the path a fit goes on from the
/// last, so that all of them cost little more than one. Hidden nodes: the
/// fewest of HiddenToTry whose error is at most 5 % above the least, which is
/// what another start alone changes. Both: wfactor with the design's nodes (or
/// the most below them that are tried), then the nodes with that wfactor, then,
/// if their number changed, the wfactor again. Throws std::invalid_argument
/// where none could be judged.
TunedNet TuneNet(const NetDesign& design,
                 const NetTuning& tuning,
                 const NetTrainer& trainer,
                 const data::Dataset& training,
                 const FitContext& context);

/// The wfactors of a fit at `wfactor`: the path to it, or it alone.
std::vector<double> WfactorsOf(double wfactor, bool along_path);

}  // namespace errmap::models
