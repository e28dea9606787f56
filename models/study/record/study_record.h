#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "models/study/judgement/verdict.h"
#include "models/study/memorisation.h"
#include "models/study/record/machine_record.h"
#include "models/study/record/record.h"

// What a study found, as plain data: these structs are results.json, schema
// errmap-results-1, member by key in the same order. Lengths are in the data
// file's own unit; NaN stands for what there is not (null in the file), and
// nothing is infinite. Tables, pages and sentences are drawn from them.

namespace errmap::models {

inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// The entry of `list` that is called `name`, or null.
template <typename T>
requires requires(const T& entry) { entry.name; }
const T* FindNamed(const std::vector<T>& list, std::string_view name) {
  const auto found = std::ranges::find(list, name, &T::name);
  return found == list.end() ? nullptr : &*found;
}
template <typename T>
const T* FindNamed(const ByName<T>& list, std::string_view name) {
  const auto found =
      std::ranges::find(list, name, &std::pair<std::string, T>::first);
  return found == list.end() ? nullptr : &found->second;
}

/// Value of an option.
using OptionValue = std::variant<std::int64_t, double, std::string>;

/// A 95 % interval; NaN where there is none.
using IntervalRecord = std::array<double, 2>;

// --- A fit -----------------------------------------------------------------

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

// --- Residuals -------------------------------------------------------------

/// A test, and why it does not apply where it does not. The statistics have
/// the names of their keys.
#define ERRMAP_TEST_RECORD(Struct, statistic) \
  struct Struct {                             \
    double statistic = kNotKnown;             \
    double p = kNotKnown;                     \
    LeftOut<std::string> why;                 \
  };                                          \
  ERRMAP_RECORD(Struct, statistic, p, why)

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
ERRMAP_RECORD(KsRecord, d, p_given, why, p_given_exact)

struct PpccRecord {
  double lambda = kNotKnown;
  double r_max = kNotKnown;
  LeftOut<double> p_max;
  LeftOut<double> r_014;
  double r_normal = kNotKnown;
  LeftOut<double> p_normal;
  LeftOut<std::string> why;
};
ERRMAP_RECORD(PpccRecord, lambda, r_max, p_max, r_014, r_normal, p_normal, why)

/// p of simulated normal samples.
struct MonteCarloRecord {
  std::int64_t draws = 0;
  double lilliefors = kNotKnown;
  double shapiro_wilk = kNotKnown;
  double anderson_darling = kNotKnown;
  double jarque_bera = kNotKnown;
  double dagostino_pearson = kNotKnown;
  double normal_ppcc = kNotKnown;
};
ERRMAP_RECORD(MonteCarloRecord,
              draws,
              lilliefors,
              shapiro_wilk,
              anderson_darling,
              jarque_bera,
              dagostino_pearson,
              normal_ppcc)

/// p are cut off at 0.001 and 0.999 where they come from simulated tables.
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
  LeftOut<MonteCarloRecord> monte_carlo;
};
ERRMAP_RECORD(NormalityRecord,
              ks,
              lilliefors,
              shapiro_wilk,
              anderson_darling,
              jarque_bera,
              dagostino_pearson,
              ppcc,
              dip,
              skewness,
              kurtosis,
              monte_carlo)

struct RunsRecord {
  Inline<ZTestRecord> test;
  LeftOut<std::int64_t> runs;
  LeftOut<double> expected;
};
ERRMAP_RECORD(RunsRecord, test, runs, expected)

struct Lag1Record {
  Inline<RTestRecord> test;
  LeftOut<double> expected;
};
ERRMAP_RECORD(Lag1Record, test, expected)

struct LjungBoxRecord {
  Inline<QTestRecord> test;
  LeftOut<std::int64_t> lags;
};
ERRMAP_RECORD(LjungBoxRecord, test, lags)

/// p of shuffled orders.
struct ShuffledRecord {
  std::int64_t draws = 0;
  double runs = kNotKnown;
  double lag1 = kNotKnown;
  double durbin_watson = kNotKnown;
  double ljung_box = kNotKnown;
};
ERRMAP_RECORD(ShuffledRecord, draws, runs, lag1, durbin_watson, ljung_box)

struct SerialRecord {
  RunsRecord runs;
  Lag1Record lag1;
  DTestRecord durbin_watson;
  LjungBoxRecord ljung_box;
  LeftOut<ShuffledRecord> shuffled;
};
ERRMAP_RECORD(SerialRecord, runs, lag1, durbin_watson, ljung_box, shuffled)

struct LevelRecord {
  std::string level;
  std::int64_t n = 0;
  double mean = kNotKnown;
  double standard_error = kNotKnown;
};
ERRMAP_RECORD(LevelRecord, level, n, mean, standard_error)

/// Biases at the levels of one column.
struct BiasRecord {
  Inline<FTestRecord> test;
  std::string column;
  double explained = kNotKnown;  // share of the sum of squares
  std::vector<LevelRecord> levels;
};
ERRMAP_RECORD(BiasRecord, test, column, explained, levels)

struct SpreadRecord {
  Inline<LmTestRecord> test;
  std::string column;
};
ERRMAP_RECORD(SpreadRecord, test, column)

struct RandomnessRecord {
  std::string order;
  SerialRecord in_order;
  std::optional<SerialRecord> within_groups;
  DTestRecord halves;
  std::optional<BiasRecord> by_group;
  std::optional<BiasRecord> by_position;
  std::optional<SpreadRecord> breusch_pagan;
};
ERRMAP_RECORD(RandomnessRecord,
              order,
              in_order,
              within_groups,
              halves,
              by_group,
              by_position,
              breusch_pagan)

// --- A regression ----------------------------------------------------------

struct StepRecord {
  std::optional<std::string> term;  // nothing at the start
  bool entered = false;
  std::int64_t terms = 0;
  double f = kNotKnown;
  double p = kNotKnown;
  double rss = kNotKnown;
  double aic = kNotKnown;
  double aicc = kNotKnown;
  double bic = kNotKnown;
  double adjusted_r2 = kNotKnown;
  double press = kNotKnown;
  double cp = kNotKnown;
  double cv = kNotKnown;
};
ERRMAP_RECORD(StepRecord,
              term,
              entered,
              terms,
              f,
              p,
              rss,
              aic,
              aicc,
              bic,
              adjusted_r2,
              press,
              cp,
              cv)

/// What the intercept has not.
struct TermRecord {
  double standardised = kNotKnown;
  double vif = kNotKnown;
  double bootstrap_inclusion = kNotKnown;  // 0 to 1
};
ERRMAP_RECORD(TermRecord, standardised, vif, bootstrap_inclusion)

struct CoefficientRecord {
  std::string term;
  double estimate = kNotKnown;
  double standard_error = kNotKnown;
  double t = kNotKnown;
  double p = kNotKnown;
  IntervalRecord ci95 = {kNotKnown, kNotKnown};
  Inline<std::optional<TermRecord>> of_term;
};
ERRMAP_RECORD(
    CoefficientRecord, term, estimate, standard_error, t, p, ci95, of_term)

struct ExcludedRecord {
  std::string term;
  double f = kNotKnown;
  double p = kNotKnown;
  double bootstrap_inclusion = kNotKnown;
};
ERRMAP_RECORD(ExcludedRecord, term, f, p, bootstrap_inclusion)

struct AliasedRecord {
  std::string term;
  std::string why;
};
ERRMAP_RECORD(AliasedRecord, term, why)

struct PenaltyChoiceRecord {
  std::string holdout;
  std::vector<double> penalty;
  std::vector<double> mse;
  std::vector<double> standard_error;
};
ERRMAP_RECORD(PenaltyChoiceRecord, holdout, penalty, mse, standard_error)

/// Of a penalised fit.
struct PenaltyRecord {
  double penalty = kNotKnown;
  double effective_parameters = kNotKnown;
  PenaltyChoiceRecord cross_validation;
};
ERRMAP_RECORD(PenaltyRecord, penalty, effective_parameters, cross_validation)

struct AnovaRecord {
  std::int64_t regression_df = 0;
  double regression_ss = kNotKnown;
  double residual_df = kNotKnown;
  double residual_ss = kNotKnown;
  double total_ss = kNotKnown;
  double f = kNotKnown;
  double p = kNotKnown;
};
ERRMAP_RECORD(AnovaRecord,
              regression_df,
              regression_ss,
              residual_df,
              residual_ss,
              total_ss,
              f,
              p)

struct BootstrapRecord {
  std::int64_t repetitions = 0;
  std::string unit;
};
ERRMAP_RECORD(BootstrapRecord, repetitions, unit)

/// Of a fit by least squares.
struct LeastSquaresRecord {
  AnovaRecord anova;
  double s = kNotKnown;
  double r2 = kNotKnown;
  double adjusted_r2 = kNotKnown;
  double press = kNotKnown;
  double predicted_r2 = kNotKnown;
  std::int64_t rows_of_leverage_1 = 0;
  double largest_residual = kNotKnown;
  std::int64_t largest_residual_row = 0;
  double largest_leverage = kNotKnown;
  double condition = kNotKnown;
  std::int64_t effective_rank = 0;
  std::int64_t bits = 0;  // of the arithmetic of the estimates
  std::vector<ExcludedRecord> excluded;
  std::vector<AliasedRecord> aliased;
  bool after_selection = false;
  BootstrapRecord bootstrap;
  std::vector<std::string> notes;
};
ERRMAP_RECORD(LeastSquaresRecord,
              anova,
              s,
              r2,
              adjusted_r2,
              press,
              predicted_r2,
              rows_of_leverage_1,
              largest_residual,
              largest_residual_row,
              largest_leverage,
              condition,
              effective_rank,
              bits,
              excluded,
              aliased,
              after_selection,
              bootstrap,
              notes)

struct RegressionRecord {
  std::string method;
  std::int64_t candidates = 0;
  std::vector<StepRecord> steps;
  std::int64_t chosen_step = 0;
  std::string ended;
  /// The intercept first where there is one.
  std::vector<CoefficientRecord> coefficients;
  ByName<double> centres;
  Inline<std::optional<PenaltyRecord>> penalised;
  Inline<std::optional<LeastSquaresRecord>> least_squares;
};
ERRMAP_RECORD(RegressionRecord,
              method,
              candidates,
              steps,
              chosen_step,
              ended,
              coefficients,
              centres,
              penalised,
              least_squares)

// --- A model ---------------------------------------------------------------

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

// --- The judgement ---------------------------------------------------------

struct GapModelRecord {
  std::string model;
  double neighbours_rmse = kNotKnown;
  double unseen_rmse = kNotKnown;
  double ratio = kNotKnown;
  bool flatters = false;
};
ERRMAP_RECORD(
    GapModelRecord, model, neighbours_rmse, unseen_rmse, ratio, flatters)

struct GapRecord {
  std::string neighbours;
  std::string unseen;
  std::string warning;
  std::vector<GapModelRecord> models;
};
ERRMAP_RECORD(GapRecord, neighbours, unseen, warning, models)

struct WilcoxonRecord {
  double statistic = kNotKnown;
  double p = kNotKnown;
  bool exact = false;
};
ERRMAP_RECORD(WilcoxonRecord, statistic, p, exact)

struct MeanTestRecord {
  double statistic = kNotKnown;
  double df = kNotKnown;
  double p = kNotKnown;
};
ERRMAP_RECORD(MeanTestRecord, statistic, df, p)

/// Allows for the memory from unit to unit (memory_bounds.h).
struct MemoryTestRecord {
  double statistic = kNotKnown;
  double df = kNotKnown;
  double p = kNotKnown;
  double p_holm = kNotKnown;
  double memory = kNotKnown;
};
ERRMAP_RECORD(MemoryTestRecord, statistic, df, p, p_holm, memory)

struct PairTestsRecord {
  WilcoxonRecord wilcoxon;
  MemoryTestRecord memory_t;
  MeanTestRecord block_t;
  std::optional<MeanTestRecord> corrected_t;
  std::optional<MeanTestRecord> diebold_mariano;
};
ERRMAP_RECORD(
    PairTestsRecord, wilcoxon, memory_t, block_t, corrected_t, diebold_mariano)

/// Two models under one hold-out.
struct PairRecord {
  std::string a;
  std::string b;
  std::string holdout;
  double rmse_a = kNotKnown;
  double rmse_b = kNotKnown;
  double difference = kNotKnown;
  IntervalRecord ci95 = {kNotKnown, kNotKnown};  // of the difference
  double p = kNotKnown;
  double p_holm = kNotKnown;
  std::string test;
  bool exact = false;
  double smallest_p = kNotKnown;
  std::string unit_of_analysis;
  std::int64_t units = 0;
  double lag1 = kNotKnown;
  bool correlated = false;
  bool established = false;
  Confidence confidence = Confidence::kNotShown;
  PairTestsRecord tests;
};
ERRMAP_RECORD(PairRecord,
              a,
              b,
              holdout,
              rmse_a,
              rmse_b,
              difference,
              ci95,
              p,
              p_holm,
              test,
              exact,
              smallest_p,
              unit_of_analysis,
              units,
              lag1,
              correlated,
              established,
              confidence,
              tests)

struct WinRecord {
  std::string model;
  double share = kNotKnown;
};
ERRMAP_RECORD(WinRecord, model, share)

/// Who wins when the groups are cut anew.
struct StabilityRecord {
  std::string holdout;
  std::int64_t repeats = 0;
  std::vector<WinRecord> wins;
};
ERRMAP_RECORD(StabilityRecord, holdout, repeats, wins)

/// Why no difference could be established at all.
struct ObstacleRecord {
  Obstacle::Kind kind = Obstacle::Kind::kNone;
  std::int64_t units = 0;
  std::int64_t needed = 0;  // 0: no number of units would do
  std::int64_t pairs = 0;
};
ERRMAP_RECORD(ObstacleRecord, kind, units, needed, pairs)

struct VerdictRecord {
  std::string holdout;
  Choice choice = Choice::kBaseline;
  std::string model;
  std::optional<std::string> rival;
  std::optional<Confidence> against_rival;  // that the model is better
  std::optional<std::string> best_baseline;
  std::optional<ObstacleRecord> obstacle;
  bool established = false;
  Confidence confidence = Confidence::kNotShown;
  std::string why;
};
ERRMAP_RECORD(VerdictRecord,
              holdout,
              choice,
              model,
              rival,
              against_rival,
              best_baseline,
              obstacle,
              established,
              confidence,
              why)

/// What speaks for a recommendation, then what bounds its worth. The figures
/// that a remark does not hold stand elsewhere in the record.
enum class RemarkKind {
  kAveragesMaps,        // model: the single map beside it, of its tier if any
  kLowestAndSimplest,   // of the first tier
  kSimplestNearLowest,  // of one unit only; model: of the lowest error
  kSimplestOfTier,      // model: of the lowest error; excess, confidence
  kRemoves,             // removed_share of what is there without a map
  kBeatsBaseline,       // model: the best one
  kGap,
  kPromise,
  kOneMoreSession,
  kGoal,
  kCost,
  kNotNoise,  // columns, shares
  kInterrupted,
  kOneRunOnly,
  kGroupFitsFailed,
  kNoGroupsHeldOut,
  kNoGroups,
  kBlocksForUnits,
  kTooFewUnits,
  kTooManyMaps,       // for so few units
  kIgnoreNeighbours,  // model: what they flatter most temptingly
  kHoldoutsDisagree,  // holdouts: in whose first tier the map is not
  kUnitsCorrelated,   // lag1, pairs, established
  kExtrapolates,
  kNotConverged,
  kNoiseLearning,
  kOtherCuts,
  kBetterWithoutMap,  // model: the predictions
};
/// "averages maps", ...: the enumerator's words.
std::string_view ToString(RemarkKind kind);

struct RemarkRecord {
  RemarkKind kind = RemarkKind::kCost;
  /// Its place among what is told first, from 1; nothing: told on request.
  LeftOut<std::int64_t> rank = {};
  LeftOut<std::string> model = {};
  LeftOut<std::vector<std::string>> holdouts = {};
  LeftOut<double> excess = {};  // of its RMSE over the model's, at most; 95 %
  LeftOut<Confidence> confidence = {};
  LeftOut<std::vector<std::string>> columns = {};
  /// Of the squared residuals, what the means by each column explain (0 to 1).
  LeftOut<std::vector<double>> shares = {};
  LeftOut<double> lag1 = {};
  LeftOut<std::int64_t> pairs = {};
  LeftOut<std::int64_t> established = {};
  /// Of each of `columns`: below and above what more is to be measured.
  LeftOut<std::vector<double>> below = {};
  LeftOut<std::vector<double>> above = {};
};
ERRMAP_RECORD(RemarkRecord,
              kind,
              rank,
              model,
              holdouts,
              excess,
              confidence,
              columns,
              shares,
              lag1,
              pairs,
              established,
              below,
              above)

/// Of one prediction.
struct CostRecord {
  std::int64_t multiplications = 0;
  std::int64_t exponentials = 0;
};
ERRMAP_RECORD(CostRecord, multiplications, exponentials)

/// What a map remembers.
struct MemoryRecord {
  double longest = 0.0;  // time constant; 0: of none
  std::string time_unit;
  bool zeroed = false;  // at the start of a session
};
ERRMAP_RECORD(MemoryRecord, longest, time_unit, zeroed)

/// A share of the errors on a unit never seen lies within half_width;
/// PredictionInterval.
struct PromiseLevelRecord {
  double coverage = kNotKnown;
  double half_width = kNotKnown;
  bool at_least = false;
};
ERRMAP_RECORD(PromiseLevelRecord, coverage, half_width, at_least)

struct PromiseRecord {
  std::string holdout;
  std::string unit;
  std::int64_t units = 0;
  std::vector<PromiseLevelRecord> levels;
};
ERRMAP_RECORD(PromiseRecord, holdout, unit, units, levels)
PromiseRecord MakeRecord(const PredictionInterval& interval);

/// Held-out residuals from `from` to before `until` seconds after the first row
/// of their session (NaN: to its end).
struct SinceStartRecord {
  double from = 0.0;
  double until = kNotKnown;
  std::int64_t n = 0;
  double mean = kNotKnown;
  double rmse = kNotKnown;
};
ERRMAP_RECORD(SinceStartRecord, from, until, n, mean, rmse)

/// See SessionWorth.
struct SessionWorthRecord {
  std::int64_t sessions = 0;
  std::int64_t folds = 0;
  double ratio_of_one_fewer = kNotKnown;
  double ratio_of_one_more = kNotKnown;
};
ERRMAP_RECORD(
    SessionWorthRecord, sessions, folds, ratio_of_one_fewer, ratio_of_one_more)

/// See SensorImportance.
struct WithoutSensorsRecord {
  std::vector<std::string> sensors;
  double rmse = kNotKnown;
};
ERRMAP_RECORD(WithoutSensorsRecord, sensors, rmse)

struct ImportanceRecord {
  std::int64_t rows = 0;
  double rmse = kNotKnown;
  double alike = kNotKnown;
  std::vector<WithoutSensorsRecord> one_by_one;
  std::vector<WithoutSensorsRecord> together;
};
ERRMAP_RECORD(ImportanceRecord, rows, rmse, alike, one_by_one, together)

struct RecommendationRecord {
  Choice choice = Choice::kBaseline;
  std::string model;
  std::string holdout;
  double rmse = kNotKnown;
  IntervalRecord ci95 = {kNotKnown, kNotKnown};
  std::vector<std::string> first_tier;
  std::optional<std::string> best_baseline;
  std::vector<std::string> sensors;
  std::int64_t parameters = 0;
  double predict_ns = kNotKnown;
  std::optional<Confidence> against_baseline;
  std::optional<bool> meets_goal;
  GoalStanding goal_standing = GoalStanding::kNotJudged;
  double extrapolated_share = kNotKnown;
  /// Of the error without compensation, 1 - RMSE / RMSE; below 0: it adds.
  double removed_share = kNotKnown;
  CostRecord cost;
  std::optional<MemoryRecord> memory;
  LeftOut<PromiseRecord> promise;
  /// Under `holdout`; empty without times in seconds.
  std::vector<SinceStartRecord> since_start;
  LeftOut<SessionWorthRecord> session_worth;
  LeftOut<ImportanceRecord> importance;  // of its sensors
  std::vector<RemarkRecord> grounds;
  std::vector<RemarkRecord> doubts;
  std::string sentence;
  std::string why;
  std::vector<std::string> reasons;  // the grounds in words
  std::vector<std::string> caveats;  // the doubts in words
};
ERRMAP_RECORD(RecommendationRecord,
              choice,
              model,
              holdout,
              rmse,
              ci95,
              first_tier,
              best_baseline,
              sensors,
              parameters,
              predict_ns,
              against_baseline,
              meets_goal,
              goal_standing,
              extrapolated_share,
              removed_share,
              cost,
              memory,
              promise,
              since_start,
              session_worth,
              importance,
              grounds,
              doubts,
              sentence,
              why,
              reasons,
              caveats)

// --- The rows behind the figures -------------------------------------------

struct FigureInputRecord {
  std::string name;
  std::string unit;
};
ERRMAP_RECORD(FigureInputRecord, name, unit)

/// Rows of one file, thinned evenly where they are many.
struct FigureTableRecord {
  std::string file;
  std::int64_t rows_total = 0;
  std::vector<std::int64_t> rows;  // 0-based data rows
  std::vector<std::string> labels;
  std::vector<std::int64_t> groups;  // index into labels
  std::vector<double> target;
  std::vector<std::vector<double>> inputs;  // one list per input
  LeftOut<std::vector<std::string>> session_labels;
  LeftOut<std::vector<std::int64_t>> sessions;  // index into them
  LeftOut<std::vector<double>> time;  // in data.time_unit, where that is s
};
ERRMAP_RECORD(FigureTableRecord,
              file,
              rows_total,
              rows,
              labels,
              groups,
              target,
              inputs,
              session_labels,
              sessions,
              time)

struct FigureHoldoutRecord {
  std::string name;
  std::int64_t table = 0;
  ByName<std::vector<double>> predictions;  // NaN: not held out
  /// Entries of the table where an input of the recommended map lay outside
  /// what its fold was trained on.
  LeftOut<std::vector<std::int64_t>> outside;
};
ERRMAP_RECORD(FigureHoldoutRecord, name, table, predictions, outside)

struct CorrelationRecord {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> matrix;
};
ERRMAP_RECORD(CorrelationRecord, columns, matrix)

struct FiguresRecord {
  std::vector<FigureInputRecord> inputs;
  std::int64_t inputs_left_out = 0;
  std::optional<std::string> position;
  std::optional<std::string> group;
  std::vector<FigureTableRecord> tables;
  std::vector<FigureHoldoutRecord> holdouts;
  /// Of the recommended map, fitted to all rows, of the first table.
  LeftOut<std::vector<double>> fitted;
  CorrelationRecord correlation;
};
ERRMAP_RECORD(FiguresRecord,
              inputs,
              inputs_left_out,
              position,
              group,
              tables,
              holdouts,
              fitted,
              correlation)

// --- A component -----------------------------------------------------------

struct DroppedRecord {
  std::string column;
  std::string why;
};
ERRMAP_RECORD(DroppedRecord, column, why)

/// Readings that no machine made; data::ColumnFault.
struct FaultRecord {
  data::FaultKind kind = data::FaultKind::kOutlying;
  std::string column;
  std::vector<std::int64_t> rows;  // 0-based data rows
  bool of_cells = false;
  double value = kNotKnown;
  double low = kNotKnown;
  double high = kNotKnown;
};
ERRMAP_RECORD(FaultRecord, kind, column, rows, of_cells, value, low, high)

struct DataRecord {
  std::string file;
  std::string sha256;
  std::int64_t rows = 0;
  std::string target;
  std::string unit;  // "": none
  std::vector<std::string> inputs;
  std::optional<std::string> group;
  std::optional<std::string> session;
  std::optional<std::string> time;
  std::string time_unit;
  std::int64_t sessions = 0;
  data::Alignment align = data::Alignment::kNone;
  std::vector<DroppedRecord> dropped;
  std::vector<FaultRecord> faults;
};
ERRMAP_RECORD(DataRecord,
              file,
              sha256,
              rows,
              target,
              unit,
              inputs,
              group,
              session,
              time,
              time_unit,
              sessions,
              align,
              dropped,
              faults)

/// What people see is value * scale, in this unit.
struct DisplayRecord {
  std::string unit;
  double scale = 1.0;
};
ERRMAP_RECORD(DisplayRecord, unit, scale)

using RowsOfFolds = std::vector<std::vector<std::int64_t>>;

struct HoldoutRecord {
  std::string name;
  std::int64_t folds = 0;
  bool whole_groups = false;
  bool whole_sessions = false;
  bool among_neighbours = false;
  bool another_file = false;
  std::int64_t repeats = 1;
  /// Of each fold: how its training rows are held out for choices in a fit.
  std::vector<std::string> inner;
  RowsOfFolds train_rows;
  RowsOfFolds test_rows;
  std::string unit_of_analysis;
  std::int64_t units = 0;
  std::vector<std::string> unit_labels;
};
ERRMAP_RECORD(HoldoutRecord,
              name,
              folds,
              whole_groups,
              whole_sessions,
              among_neighbours,
              another_file,
              repeats,
              inner,
              train_rows,
              test_rows,
              unit_of_analysis,
              units,
              unit_labels)

struct ProbedModelRecord {
  std::string model;
  std::vector<double> rmse;  // as `numbers` of the whole
};
ERRMAP_RECORD(ProbedModelRecord, model, rmse)

/// What probes of a session would make of each model on sessions held out.
struct ProbesRecord {
  std::string holdout;
  std::string unit;
  double spacing = kNotKnown;  // in time_unit
  std::string time_unit;
  std::vector<std::int64_t> numbers;
  std::int64_t scored_rows = 0;
  std::vector<ProbedModelRecord> models;
};
ERRMAP_RECORD(ProbesRecord,
              holdout,
              unit,
              spacing,
              time_unit,
              numbers,
              scored_rows,
              models)

struct ComponentRecord {
  std::string name;
  bool interrupted = false;
  DataRecord data;
  double goal = kNotKnown;
  double indifference = kNotKnown;
  DisplayRecord display;
  std::vector<HoldoutRecord> holdouts;
  std::vector<ModelRecord> models;
  std::optional<GapRecord> gap;
  std::vector<PairRecord> comparisons;
  ByName<std::vector<std::vector<std::string>>> tiers;
  std::vector<StabilityRecord> stability;
  std::vector<VerdictRecord> verdict;
  std::optional<RecommendationRecord> recommendation;
  /// Where it was asked for.
  LeftOut<ProbesRecord> probes;
  FiguresRecord figures;
};
ERRMAP_RECORD(ComponentRecord,
              name,
              interrupted,
              data,
              goal,
              indifference,
              display,
              holdouts,
              models,
              gap,
              comparisons,
              tiers,
              stability,
              verdict,
              recommendation,
              probes,
              figures)

// --- The whole -------------------------------------------------------------

struct ComponentConfigurationRecord {
  LeftOut<std::string> name;
  LeftOut<std::string> data;
  LeftOut<ByName<std::variant<std::int64_t, double, std::string>>> where;
  LeftOut<std::string> target;
  LeftOut<std::vector<std::string>> inputs;
  LeftOut<std::vector<std::string>> exclude;
  LeftOut<std::string> group;
  LeftOut<std::string> time;
  LeftOut<std::string> session;
  LeftOut<data::Alignment> align;  // where there is one
  LeftOut<std::string> weight;
  data::MissingPolicy missing = data::MissingPolicy::kError;
  data::FaultPolicy faults = data::FaultPolicy::kKeep;
  bool keep_dead = false;
  LeftOut<double> goal;
  LeftOut<double> indifference;
};
ERRMAP_RECORD(ComponentConfigurationRecord,
              name,
              data,
              where,
              target,
              inputs,
              exclude,
              group,
              time,
              session,
              align,
              weight,
              missing,
              faults,
              keep_dead,
              goal,
              indifference)

/// The study as it was carried out, with the words of a study file.
struct ConfigurationRecord {
  std::uint64_t seed = 0;
  LeftOut<double> goal;
  LeftOut<double> indifference;
  LeftOut<std::vector<std::string>> holdouts;
  LeftOut<std::vector<std::string>> models;
  std::vector<ComponentConfigurationRecord> component;
};
ERRMAP_RECORD(
    ConfigurationRecord, seed, goal, indifference, holdouts, models, component)

struct InputFileRecord {
  std::string file;
  std::string sha256;
};
ERRMAP_RECORD(InputFileRecord, file, sha256)

struct ProvenanceRecord {
  std::string version;
  std::string command_line;
  ConfigurationRecord configuration;
  std::vector<InputFileRecord> inputs;
  std::string compiler;
  ByName<std::string> libraries;
  std::string platform;
};
ERRMAP_RECORD(ProvenanceRecord,
              version,
              command_line,
              configuration,
              inputs,
              compiler,
              libraries,
              platform)

inline constexpr std::string_view kResultsSchema = "errmap-results-1";

struct StudyRecord {
  std::string schema;
  std::string version;
  std::uint64_t seed = 0;
  bool interrupted = false;
  ProvenanceRecord provenance;
  std::vector<ComponentRecord> components;
  LeftOut<MachineRecord> machine;  // where they were put together
};
ERRMAP_RECORD(StudyRecord,
              schema,
              version,
              seed,
              interrupted,
              provenance,
              components,
              machine)

/// Two models under a hold-out, either way round, or null.
const PairRecord* FindPair(const ComponentRecord& component,
                           std::string_view holdout,
                           std::string_view one,
                           std::string_view other);

/// results.json; what is no UTF-8 in names is replaced.
std::string ToJsonText(const StudyRecord& record);

/// What ToJsonText wrote: Same(FromJsonText(ToJsonText(r)), r). Of a document
/// that is older, incomplete or of a failed run what is missing, null or of
/// another type is as in a new record. Throws data::InputError where the text
/// is no JSON or of another schema.
StudyRecord FromJsonText(std::string_view text);

}  // namespace errmap::models
