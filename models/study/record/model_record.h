#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "fitting/minimisers/optimizer.h"
#include "models/error_model.h"
#include "models/study/judgement/choice.h"
#include "models/study/judgement/goal.h"
#include "models/study/memorisation.h"
#include "models/study/record/record.h"
#include "models/study/record/record_values.h"
#include "models/study/record/regression_record.h"
#include "models/study/record/residual_record.h"

// A model: its fits, and its figures under each hold-out.

namespace errmap::models {

struct MetricsRecord {
  std::int64_t n = 0;
  double mean = kNotKnown;
  double sd = kNotKnown;  // n - 1
  double rmse = kNotKnown;
  double mae = kNotKnown;
  double min = kNotKnown;
  double max = kNotKnown;
  double range = kNotKnown;
  double r2 = kNotKnown;
};
ERRMAP_RECORD(MetricsRecord, n, mean, sd, rmse, mae, min, max, range, r2)

struct StartRecord {
  std::uint64_t seed = 0;
  double final_cost = kNotKnown;
  fitting::Termination stop = fitting::Termination::kFailed;
  std::int64_t iterations = 0;
  double holdout_rmse = kNotKnown;
  bool chosen = false;
};
ERRMAP_RECORD(
    StartRecord, seed, final_cost, stop, iterations, holdout_rmse, chosen)

/// Of the final costs that are finite.
struct CostSpreadRecord {
  std::int64_t finite = 0;
  double min = kNotKnown;
  double median = kNotKnown;
  double max = kNotKnown;
  double sd = kNotKnown;  // n - 1; NaN for fewer than two
};
ERRMAP_RECORD(CostSpreadRecord, finite, min, median, max, sd)

struct StartsRecord {
  std::vector<StartRecord> table;
  CostSpreadRecord spread;
};
ERRMAP_RECORD(StartsRecord, table, spread)

/// How a fit went.
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
ERRMAP_RECORD(SummaryRecord,
              stop,
              converged,
              message,
              iterations,
              evaluations,
              value_evaluations,
              gradient_evaluations,
              curvature_evaluations,
              initial_cost,
              final_cost,
              initial_gradient_norm,
              final_gradient_norm,
              mean_iteration_seconds,
              sd_iteration_seconds,
              trace)

struct FitRecord {
  double fit_seconds = kNotKnown;
  Inline<SummaryRecord> summary;
  std::vector<std::string> remarks;
  LeftOut<ByName<OptionValue>> choices;  // made by the fit, such as wfactor=cv
  LeftOut<StartsRecord> starts;          // where there were several
};
ERRMAP_RECORD(FitRecord, fit_seconds, summary, remarks, choices, starts)

struct FoldRecord {
  double train_rmse = kNotKnown;
  double test_rmse = kNotKnown;
  Inline<FitRecord> fit;
};
ERRMAP_RECORD(FoldRecord, train_rmse, test_rmse, fit)

struct MemorisationRecord {
  double train_r2 = kNotKnown;
  double shuffled_r2 = kNotKnown;
  double weights_per_row = kNotKnown;
  double effective_parameters = kNotKnown;
  NoiseLearning learning = NoiseLearning::kUnknown;
  std::optional<std::string> why_not;
  std::string sentence;
};
ERRMAP_RECORD(MemorisationRecord,
              train_r2,
              shuffled_r2,
              weights_per_row,
              effective_parameters,
              learning,
              why_not,
              sentence)

/// A model under one hold-out.
struct ResultRecord {
  MetricsRecord train;  // each figure averaged over the folds
  MetricsRecord test;   // of the pooled residuals of all folds
  std::vector<FoldRecord> folds;
  NormalityRecord normality;
  RandomnessRecord randomness;
  IntervalRecord ci95 = {kNotKnown, kNotKnown};
  std::int64_t tier = 0;           // 1-based
  std::optional<bool> meets_goal;  // nothing where it was not judged
  GoalStanding goal_standing = GoalStanding::kNotJudged;
  std::vector<double> unit_rmse;
};
ERRMAP_RECORD(ResultRecord,
              train,
              test,
              folds,
              normality,
              randomness,
              ci95,
              tier,
              meets_goal,
              goal_standing,
              unit_rmse)

/// Of one step of the exported map; ProgramCost.
struct StepCostRecord {
  std::int64_t additions = 0;
  std::int64_t multiplications = 0;
  std::int64_t divisions = 0;
  std::int64_t exponentials = 0;
  std::int64_t state_bytes = 0;
};
ERRMAP_RECORD(StepCostRecord,
              additions,
              multiplications,
              divisions,
              exponentials,
              state_bytes)

enum class ModelStatus { kFailed, kOk };
std::string_view ToString(ModelStatus status);

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
  std::optional<FitRecord> final;  // the fit to all rows
  std::optional<RegressionRecord> regression;
  std::optional<MemorisationRecord> memorisation;
  ModelStatus status = ModelStatus::kFailed;
  std::optional<std::string> why;  // it failed
  ByName<ResultRecord> results;    // by hold-out
  double predict_ns = kNotKnown;
};
ERRMAP_RECORD(ModelRecord,
              name,
              kind,
              choice,
              baseline,
              options,
              parameters,
              equation,
              sensors,
              inputs_used,
              file,
              step_cost,
              final,
              regression,
              memorisation,
              status,
              why,
              results,
              predict_ns)

}  // namespace errmap::models
