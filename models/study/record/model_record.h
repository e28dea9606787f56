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
#include "models/study/shuffled_target_fit.h"
#include "stats/error_metrics.h"
#include "stats/normality/normality.h"
#include "stats/randomness.h"

// A model: its fits, and its metrics under each hold-out.

namespace errmap::models {

// Tests of held-out residuals: their distribution, their order, and remaining
// biases at the levels of a column.

/// A test, or the reason why it does not apply. The statistics are named as
/// their keys.
#define ERRMAP_TEST_RECORD(Struct, statistic) \
  struct Struct {                             \
    double statistic = kNotKnown;             \
    double p = kNotKnown;                     \
    LeftOut<std::string> why;                 \
  };

ERRMAP_TEST_RECORD(DTestRecord, d)
ERRMAP_TEST_RECORD(WTestRecord, w)
ERRMAP_TEST_RECORD(A2TestRecord, a2)
ERRMAP_TEST_RECORD(JbTestRecord, jb)
ERRMAP_TEST_RECORD(K2TestRecord, k2)
ERRMAP_TEST_RECORD(DipTestRecord, dip)
ERRMAP_TEST_RECORD(ZTestRecord, z)
ERRMAP_TEST_RECORD(RTestRecord, r)
ERRMAP_TEST_RECORD(QTestRecord, q)
ERRMAP_TEST_RECORD(FTestRecord, f)
ERRMAP_TEST_RECORD(LmTestRecord, lm)

struct KsRecord {
  double d = kNotKnown;
  double p_given = kNotKnown;  // Eq. 140: mean and sd taken as given
  LeftOut<std::string> why;
  double p_given_exact = kNotKnown;
};

struct PpccRecord {
  double lambda = kNotKnown;
  double r_max = kNotKnown;
  LeftOut<double> p_max;
  LeftOut<double> r_014;
  double r_normal = kNotKnown;
  LeftOut<double> p_normal;
  LeftOut<std::string> why;
};

/// p-values from simulated tables are limited to 0.001 and 0.999. With a `step`
/// they are shares of normal samples with the same rounding.
struct NormalityRecord {
  KsRecord ks;
  DTestRecord lilliefors;
  WTestRecord shapiro_wilk;
  A2TestRecord anderson_darling;
  JbTestRecord jarque_bera;
  K2TestRecord dagostino_pearson;
  PpccRecord ppcc;
  DipTestRecord dip;
  double skewness = kNotKnown;
  double kurtosis = kNotKnown;
  LeftOut<double> step;  // of rounded readings, if it matters
  LeftOut<stats::MonteCarloP> monte_carlo;
};

struct RunsRecord {
  Inline<ZTestRecord> test;
  LeftOut<std::int64_t> runs;
  LeftOut<double> expected;
};

struct Lag1Record {
  Inline<RTestRecord> test;
  LeftOut<double> expected;
};

struct LjungBoxRecord {
  Inline<QTestRecord> test;
  LeftOut<std::int64_t> lags;
};

struct SerialRecord {
  RunsRecord runs;
  Lag1Record lag1;
  DTestRecord durbin_watson;
  LjungBoxRecord ljung_box;
  LeftOut<stats::SerialShuffles> shuffled;
};

struct LevelRecord {
  std::string level;
  std::int64_t n = 0;
  double mean = kNotKnown;
  double standard_error = kNotKnown;
};

/// Biases at the levels of one column.
struct BiasRecord {
  Inline<FTestRecord> test;
  std::string column;
  double explained = kNotKnown;  // share of the sum of squares
  std::vector<LevelRecord> levels = {};
};

struct SpreadRecord {
  Inline<LmTestRecord> test;
  std::string column;
};

struct RandomnessRecord {
  std::string order;
  SerialRecord in_order;
  std::optional<SerialRecord> within_groups;
  DTestRecord halves;
  std::optional<BiasRecord> by_group;
  std::optional<BiasRecord> by_position;
  std::optional<SpreadRecord> breusch_pagan;
};

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
  LeftOut<std::vector<std::tuple<std::int64_t, double, double>>> trace = {};
};

struct FitRecord {
  double fit_seconds = kNotKnown;
  Inline<SummaryRecord> summary;
  std::vector<std::string> remarks;
  LeftOut<ByName<OptionValue>> choices =
      {};                             // made by the fit, such as wfactor=cv
  LeftOut<StartsRecord> starts = {};  // if there were several
};

struct FoldRecord {
  double train_rmse = kNotKnown;
  double test_rmse = kNotKnown;
  Inline<FitRecord> fit;
};

struct ShuffledTargetRecord {
  double train_r2 = kNotKnown;
  double shuffled_r2 = kNotKnown;
  double weights_per_row = kNotKnown;
  double effective_parameters = kNotKnown;
  NoiseLearning learning = NoiseLearning::kUnknown;
  std::optional<std::string> why_not;
  std::string sentence = {};
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
  std::optional<ShuffledTargetRecord> memorisation;
  ModelStatus status = ModelStatus::kFailed;
  std::optional<std::string> why;  // reason for the failure
  ByName<ResultRecord> results;    // by hold-out
  double predict_ns = kNotKnown;
};

}  // namespace errmap::models
