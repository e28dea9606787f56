#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "fitting/minimisers/optimizer.h"
#include "models/error_model.h"
#include "models/history/view.h"
#include "models/model_spec.h"
#include "models/net/net_fit.h"
#include "models/net/net_trainer.h"

namespace errmap::models {

/// How wfactor comes about.
enum class WfactorRule { kGiven, kCrossValidation, kDiscrepancy };

/// What a SPEC says of wfactor: wfactor= or discrepancy=.
struct WfactorOption {
  WfactorRule rule = WfactorRule::kGiven;
  double wfactor = 1e-5;
  double delta = 0.0;  // kDiscrepancy: wanted RMS, the target's unit
};

/// What the SPEC of a net says.
struct NetOptions {
  // Time grows with the rows, accuracy beyond these hardly.
  static constexpr std::int64_t kMostRows = 20'000;

  ViewOptions view;
  Eigen::Index most_rows = kMostRows;  // of those it trains on
  bool clips = true;                   // guards a map in a view
  std::int64_t members = 1;            // starts that are averaged
  NetDesign design;
  WfactorOption wfactor;
  bool walks_path = false;    // goes down WfactorPath to its wfactor
  bool tunes_hidden = false;  // else the nodes of the design
  std::int64_t starts = 1;    // of which one is chosen
  bool chooses_start_by_cv = false;
  fitting::StoppingRules stopping;            // of a fit, its path included
  std::shared_ptr<const NetTrainer> trainer;  // not null

  /// Those in effect, under their names in a SPEC.
  std::vector<EffectiveOption> Describe() const;
};

/// Those of a model of NetTypes(). Throws std::invalid_argument on options that
/// are unknown, out of range or at odds with each other.
NetOptions TakeNetOptions(const ModelSpec& spec);

}  // namespace errmap::models
