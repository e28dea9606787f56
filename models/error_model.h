#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "data/measurements/dataset.h"
#include "fitting/minimisers/fit_summary.h"
#include "models/prediction_interval.h"
#include "stats/eigen.h"
#include "stats/not_a_number.h"

namespace errmap::models {

/// Product of powers of the scaled inputs times a coefficient.
struct PolynomialTerm {
  std::vector<int> powers;  // one per input, at least 0
  double coefficient = 0.0;
};

/// An input in which a polynomial is curved only within a range.
struct BendRange {
  Index input = 0;
  double min = 0.0;  // unit of the input
  double max = 0.0;
};

/// error = intercept + sum of terms in scaled inputs (x - offset) * scale.
struct PolynomialForm {
  VectorXd input_offset;   // (p) unit of the input
  VectorXd input_scale;    // (p) per unit of the input
  double intercept = 0.0;  // unit of the target
  std::vector<PolynomialTerm> terms;
  /// Inputs that are clipped to their range in curved terms. A term is curved
  /// if its powers of these inputs sum to more than 1. The map continues as a
  /// straight line beyond the range (polynomial/polynomial_model.h). Empty: no
  /// clipping.
  std::vector<BendRange> bends_within = {};
};

enum class OutputFunction { kSigmoid, kLinear };
std::string_view ToString(OutputFunction output);

/// One-hidden-layer net in scaled inputs (x - offset) * scale with scaled
/// outputs z. A prediction is (z - target_offset) / target_slope.
struct NetForm {
  OutputFunction output = OutputFunction::kSigmoid;
  VectorXd input_offset;   // (I)
  VectorXd input_scale;    // (I)
  VectorXd target_slope;   // (J)
  VectorXd target_offset;  // (J)
  MatrixXd w1;             // (H x (I+1)) last column = bias, Eq. 16
  MatrixXd w2;             // (J x (H+1)) last column = bias, Eq. 17
};

/// Weighted mean of maps, each clipped to its own bounds.
struct BlendForm {
  struct Member {
    std::string name;
    double weight = 0.0;        // the members' weights sum to 1
    std::vector<Index> inputs;  // indices of the blend's inputs it reads
    double lowest = -std::numeric_limits<double>::infinity();  // target's unit
    double highest = std::numeric_limits<double>::infinity();
    Index parameters = 0;
    std::variant<PolynomialForm, NetForm> form;
  };
  Index num_inputs = 0;
  std::string rule;  // how the weights are chosen
  std::vector<Member> members;
};

/// Operations of one prediction: counted, not timed, so the same on any
/// machine.
struct PredictionCost {
  Index multiplications = 0;
  Index exponentials = 0;
};

/// A model without a formula. It can be studied and reported, but not saved or
/// exported.
struct OpaqueForm {
  Index num_inputs = 0;
  PredictionCost cost;  // 0 if unknown
};

/// A model as plain data, for model files and exporters.
using ModelDescription =
    std::variant<PolynomialForm, NetForm, BlendForm, OpaqueForm>;

/// Throws std::invalid_argument, "<what> needs a map's formula, ...", if the
/// form is opaque.
void RequireFormula(const ModelDescription& form, std::string_view what);

PredictionCost CostOf(const PolynomialForm& form);
PredictionCost CostOf(const NetForm& form);
PredictionCost CostOf(const BlendForm& form);
PredictionCost CostOf(const OpaqueForm& form);
PredictionCost CostOf(const ModelDescription& form);

/// A fitted map from p inputs to one predicted error. It is immutable and safe
/// to use from several threads. Users may derive their own models: a recipe
/// that makes them (ModelRecipe) can be put into any study.
class ErrorModel {
 public:
  virtual ~ErrorModel() = default;
  virtual Index num_inputs() const = 0;
  virtual Index num_parameters() const = 0;
  /// Returns the error (m) of each row of `inputs` (m x p), in the training
  /// target's unit. A row's prediction is the same to the last bit whatever the
  /// other rows. Throws std::invalid_argument unless inputs.cols() == p.
  VectorXd Predict(const MatrixXd& inputs) const;
  /// Predicts one row (p). The models of this library allocate no memory here,
  /// except very large ones.
  double PredictRow(std::span<const double> inputs) const;
  /// Returns an OpaqueForm unless a model overrides it.
  virtual ModelDescription Describe() const;

 private:
  // `inputs` holds num_inputs() values.
  virtual double DoPredictRow(const double* inputs) const = 0;
  // `inputs` has num_inputs() columns. Predicts row by row, unless a derived
  // model overrides it with something faster.
  virtual VectorXd DoPredict(const MatrixXd& inputs) const;
};

/// kFile: a map or predictions from another program.
enum class ModelKind { kBaseline, kPolynomial, kNet, kBlend, kFile };
std::string_view ToString(ModelKind kind);

/// An input of a model and its range in training.
struct TrainedInput {
  data::ColumnInfo column;
  double min = 0.0;
  double max = 0.0;
  double mean = 0.0;
  double sd = 0.0;
};

struct RegressionRecord;

/// An option and the value that took effect.
struct EffectiveOption {
  std::string key;
  std::variant<std::int64_t, double, std::string> value;
};

/// One of several starts of an iterative fit.
struct StartResult {
  std::uint64_t seed = 0;
  double final_cost = stats::kNaN;
  fitting::Termination stop = fitting::Termination::kFailed;
  std::int64_t iterations = 0;
  /// RMSE on inner hold-outs, in the target's unit; NaN if not requested.
  double holdout_rmse = stats::kNaN;
  bool chosen = false;
};

struct History;
struct Applicability;
struct HeldOutErrors;
struct LearntRows;

struct Bounds {
  double low, high;
};

/// Returns [min - m * range, max + m * range]. All guards use this function, so
/// fits, predictions and exported programs clip at exactly the same values.
inline Bounds Widened(double min, double max, double margin) {
  const double widened = margin * (max - min);
  return {min - widened, max + widened};
}

/// Bounds to which a map's inputs and predictions are clipped. A column that
/// hardly moved in training may move far on another day.
struct ClampLimits {
  /// Inputs of the form are clipped to their range, Widened by this.
  double input_margin = 2.0;
  /// Predictions are clipped to the target's range, Widened by this.
  double error_margin = 0.3;
  VectorXd input_min;  // (inputs of the form) in training
  VectorXd input_max;
  double error_min = 0.0;  // range of the target in training, in its unit
  double error_max = 0.0;

  Bounds InputBounds(Index input) const {
    return Widened(input_min[input], input_max[input], input_margin);
  }
  Bounds ErrorBounds() const {
    return Widened(error_min, error_max, error_margin);
  }
};

/// Returns ClampLimits with default margins at the trained range of the form's
/// inputs and of `targets` (at least one). If the map extrapolates in an input
/// that only increases, the error may leave its range by the width of that
/// range.
ClampLimits MakeClampLimits(const std::vector<TrainedInput>& form_inputs,
                            const VectorXd& targets,
                            bool grows = false);

struct Prediction {
  VectorXd errors;  // (m) target's unit
  /// (m) true if an input of the form, or the error, was clipped.
  Eigen::Array<bool, Eigen::Dynamic, 1> clipped;
};

/// A model with everything needed to use and judge it.
struct FittedModel {
  std::string name;  // the SPEC as given
  ModelKind kind = ModelKind::kPolynomial;
  data::ColumnInfo target;
  data::Alignment align = data::Alignment::kNone;  // of the target
  /// Rows for which it is made, such as those of one direction; empty: all
  /// rows.
  std::vector<data::ColumnFilter> where;
  /// Columns that the map reads, in the form's order. With a history the form
  /// reads inputs derived from these columns.
  std::vector<TrainedInput> inputs;
  std::shared_ptr<const ErrorModel> model;
  fitting::FitSummary summary;
  std::string equation;              // in physical units; "" if there is none
  std::vector<std::string> remarks;  // such as aliased terms; one line each
  /// Values that the fit itself chose, such as the wfactor of wfactor=cv.
  std::vector<EffectiveOption> choices;
  std::vector<StartResult> starts;  // empty if there was only one
  /// Set for polynomials if FitContext::explain is set, else null.
  std::shared_ptr<const RegressionRecord> regression;
  /// Derives the inputs of the form (models/history/history.h). Null: the form
  /// reads `inputs` as they are.
  std::shared_ptr<const History> history;
  std::optional<ClampLimits> guards;  // empty: nothing is clipped
  /// RMSE on inner hold-outs of the options that the fit chose (target's unit).
  /// NaN if the fit chose nothing.
  double inner_rmse = stats::kNaN;
  /// Prediction interval from held-out rows; empty if none were held out.
  std::optional<PredictionInterval> interval;
  /// Describes the training data (map_experience.h); may be null.
  std::shared_ptr<const Applicability> applicability;
  /// The held-out errors that gave the interval, or null.
  std::shared_ptr<const HeldOutErrors> held_out;
  /// The training rows, or null.
  std::shared_ptr<const LearntRows> learnt;
  /// How the training file was read, or null.
  std::shared_ptr<const data::Reading> reading;

  /// Number of training rows used. For very many rows, a net uses a sample.
  Index RowsLearntFrom(const data::Dataset& training) const;
  /// Returns the form's inputs of every row (m x inputs of the form); finds
  /// `inputs` by name. Throws std::invalid_argument if an input is missing, or
  /// if the history needs sessions and times that are unknown.
  MatrixXd FormInputs(const data::Dataset& dataset) const;
  /// Clips the inputs, predicts, clips the errors. Throws std::invalid_argument
  /// if the number of columns is not that of the form's inputs.
  Prediction PredictForm(const MatrixXd& form_inputs) const;
  /// Predicts one row without allocating memory; `clipped` may be
  /// null.
  double PredictFormRow(std::span<const double> form_inputs,
                        bool* clipped) const;
  /// Returns the predicted error (m) of every row, in the unit of `target`.
  /// Throws as FormInputs.
  VectorXd Predict(const data::Dataset& dataset) const;
};

/// How rows are held out for choices inside a fit (inner_folds.h). It mirrors
/// the outer hold-out, so that the choice suits the outer test. With fewer than
/// two units of a kind, the next finer kind is used.
enum class InnerHoldout {
  /// The kind that decides the recommended map: whole sessions if there are at
  /// least kFewestSessionsToDecide, else whole groups, else blocks.
  kDecisive,
  kWholeSessions,  // else kWholeGroups
  kWholeGroups,    // else kBlocks
  kBlocks,         // contiguous runs of rows
  kRows,
  kForward,
};
/// "decisive", "sessions", "groups", "blocks", "rows", "forward".
std::string_view ToString(InnerHoldout inner);

/// Fewer days hardly show which map does well on another day.
inline constexpr Index kFewestSessionsToDecide = 4;

class SharedWork;

/// Information for a fit besides the training rows. An InterruptionScope
/// (fitting/interruption.h) around the fit can interrupt it.
struct FitContext {
  std::uint64_t seed = 1;
  /// Also makes the regression record (tables and bootstraps), and tests each
  /// of several starts on inner hold-outs.
  bool explain = false;
  /// True: uses the recipe's default number of bootstraps. False: the number in
  /// its options.
  bool default_bootstraps = true;
  int threads = 1;  // at least 1; does not change results
  /// Largest number of values in a design matrix (8 bytes each). A larger one
  /// is reduced to a triangle in one pass over the rows.
  double most_design_values = 2e7;
  bool keep_trace = false;  // keep an iterative fit's trace in its summary
  InnerHoldout inner_holdout = InnerHoldout::kDecisive;
  /// The difference in error that does not matter (target's unit).
  double indifference = 0.0;
  /// Results on these training rows that several recipes share; may be
  /// null.
  SharedWork* shared = nullptr;
};

/// How to fit one kind of model: its kind and options; immutable.
class ModelRecipe {
 public:
  virtual ~ModelRecipe() = default;
  /// The SPEC as the user wrote it.
  virtual std::string name() const = 0;
  virtual ModelKind kind() const = 0;
  virtual std::vector<EffectiveOption> options() const { return {}; }
  /// Returns what the model needs and the data lack, such as "a position
  /// column", or nothing.
  virtual std::optional<std::string> WhatIsMissing(
      const data::Dataset& /*dataset*/) const {
    return std::nullopt;
  }
  /// Number of coefficients for these data, if known before the fit.
  virtual std::optional<Index> NumCoefficients(
      const data::Dataset& /*dataset*/) const {
    return std::nullopt;
  }
  /// Fits the rows of `training` only: scaling and every tuned choice are
  /// learnt from them. Throws std::invalid_argument with the reason if these
  /// rows cannot be fitted (too few, an input missing).
  virtual FittedModel Fit(const data::Dataset& training,
                          const FitContext& context) const = 0;
};

/// Returns a map of these rows without inputs and model, with the summary of a
/// direct solution.
FittedModel NewMap(std::string name,
                   ModelKind kind,
                   const data::Dataset& training);

/// Wraps a model as the result of a recipe's Fit. For models that read every
/// input of `training` unchanged and need no iterations.
FittedModel MapOfModel(const ModelRecipe& recipe,
                       const data::Dataset& training,
                       std::shared_ptr<const ErrorModel> model);

/// Returns the index of the position input: `wanted`, or if that is empty the
/// first input that is a position; -1 if there is none. Throws
/// std::invalid_argument if `wanted` is not an input.
Index FindPosition(const data::Dataset& dataset, const std::string& wanted);

/// Returns the inputs `columns` of `training` with their trained range.
std::vector<TrainedInput> DescribeInputs(const data::Dataset& training,
                                         const std::vector<Index>& columns);

}  // namespace errmap::models
