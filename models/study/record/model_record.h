#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "fitting/minimisers/fit_summary.h"
#include "models/error_model.h"
#include "models/record.h"
#include "models/regression_record.h"
#include "models/study/judgement/choice.h"
#include "models/study/judgement/goal.h"
#include "models/study/memorisation.h"
#include "models/study/record/residual_record.h"
#include "stats/error_metrics.h"

// A model: its fits, and its metrics under each hold-out.

namespace errmap::models {

/// Statistics of the finite final costs.
struct CostSpreadRecord {
  std::int64_t finite = 0;
  double min = kNotKnown;
  double median = kNotKnown;
  double max = kNotKnown;
  double sd = kNotKnown;  // n - 1; NaN for fewer than two
};

struct StartsRecord {
  std::vector<StartResult> table;
  CostSpreadRecord spread;
};

/// The outcome of a fit.
struct SummaryRecord {
  fitting::Termination stop = fitting::Termination::kFailed;
  bool converged = false;
  std::string message;
  std::int64_t iterations = 0;
  std::int64_t evaluations = 0;
  std::int64_t value_evaluations = 0;
  std::int64_t gradient_evaluations = 0;
  std::int64_t curvature_evaluations = 0;
  double initial_cost = kNotKnown;
  double final_cost = kNotKnown;
  double initial_gradient_norm = kNotKnown;
  double final_gradient_norm = kNotKnown;
  double mean_iteration_seconds = kNotKnown;
  double sd_iteration_seconds = kNotKnown;
  /// Iteration, sqrt(2 E), gradient norm.
  LeftOut<std::vector<std::tuple<std::int64_t, double, double>>> trace;
};

struct FitRecord {
  double fit_seconds = kNotKnown;
  Inline<SummaryRecord> summary;
  std::vector<std::string> remarks;
  LeftOut<ByName<OptionValue>> choices;  // made by the fit, such as wfactor=cv
  LeftOut<StartsRecord> starts;          // if there were several
};

struct FoldRecord {
  double train_rmse = kNotKnown;
  double test_rmse = kNotKnown;
  Inline<FitRecord> fit;
};

struct MemorisationRecord {
  double train_r2 = kNotKnown;
  double shuffled_r2 = kNotKnown;
  double weights_per_row = kNotKnown;
  double effective_parameters = kNotKnown;
  NoiseLearning learning = NoiseLearning::kUnknown;
  std::optional<std::string> why_not;
  std::string sentence;
};

/// A model under one hold-out.
struct ResultRecord {
  stats::ErrorMetrics train;  // metrics averaged over the folds
  stats::ErrorMetrics test;   // of the pooled residuals of all folds
  std::vector<FoldRecord> folds;
  NormalityRecord normality;
  RandomnessRecord randomness;
  IntervalRecord ci95 = {kNotKnown, kNotKnown};
  std::int64_t tier = 0;           // 1-based
  std::optional<bool> meets_goal;  // empty if not judged
  GoalStanding goal_standing = GoalStanding::kNotJudged;
  std::vector<double> unit_rmse;
};

/// Operations of one step of the exported map; ProgramCost.
struct StepCostRecord {
  std::int64_t additions = 0;
  std::int64_t multiplications = 0;
  std::int64_t divisions = 0;
  std::int64_t exponentials = 0;
  std::int64_t state_bytes = 0;

  /// Returns all operations; an exponential counts as one.
  std::int64_t operations() const {
    return additions + multiplications + divisions + exponentials;
  }
};

enum class ModelStatus { kFailed, kOk };
inline std::string_view ToString(ModelStatus status) {
  return status == ModelStatus::kOk ? "ok" : "failed";
}

struct ModelRecord {
  std::string name;  // the SPEC as given
  ModelKind kind = ModelKind::kPolynomial;
  Choice choice = Choice::kGiven;
  bool baseline = false;
  ByName<OptionValue> options;
  std::optional<std::int64_t> parameters;  // nothing without a map
  std::optional<std::string> equation;
  std::optional<std::vector<std::string>> sensors;
  std::optional<std::vector<std::string>> inputs_used;
  LeftOut<std::string> file;  // of the map, beside results.json
  LeftOut<StepCostRecord> step_cost;
  LeftOut<bool> counts_rows;       // true if memory counts rows, not seconds
  std::optional<FitRecord> final;  // the fit to all rows
  std::optional<RegressionRecord> regression;
  std::optional<MemorisationRecord> memorisation;
  ModelStatus status = ModelStatus::kFailed;
  std::optional<std::string> why;  // reason for the failure
  ByName<ResultRecord> results;    // by hold-out
  double predict_ns = kNotKnown;
};

}  // namespace errmap::models
