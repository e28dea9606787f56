#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "fitting/minimisers/fit_summary.h"
#include "models/prediction_interval.h"

namespace errmap::models {

/// Product of powers of the scaled inputs times a coefficient.
struct PolynomialTerm {
  std::vector<int> powers;  // one per input, at least 0
  double coefficient = 0.0;
};

/// Where an input may bend a polynomial.
struct BendRange {
  Eigen::Index input = 0;
  double min = 0.0;  // unit of the input
  double max = 0.0;
};

/// error = intercept + sum of terms in scaled inputs (x - offset) * scale.
struct PolynomialForm {
  Eigen::VectorXd input_offset;  // (p) unit of the input
  Eigen::VectorXd input_scale;   // (p) per unit of the input
  double intercept = 0.0;        // unit of the target
  std::vector<PolynomialTerm> terms;
  /// A term whose powers of the inputs named here add up to more than one sees
  /// these held within their range, so that the map goes on straight beyond it
  /// (polynomial/polynomial_model.h). Empty: every term goes on as it is.
  std::vector<BendRange> bends_within = {};
};

enum class OutputFunction { kSigmoid, kLinear };
std::string_view ToString(OutputFunction output);

/// One-hidden-layer net in scaled inputs (x - offset) * scale with scaled
/// outputs z; a prediction is (z - target_offset) / target_slope.
struct NetForm {
  OutputFunction output = OutputFunction::kSigmoid;
  Eigen::VectorXd input_offset;   // (I)
  Eigen::VectorXd input_scale;    // (I)
  Eigen::VectorXd target_slope;   // (J)
  Eigen::VectorXd target_offset;  // (J)
  Eigen::MatrixXd w1;             // (H x (I+1)) last column = bias, Eq. 16
  Eigen::MatrixXd w2;             // (J x (H+1)) last column = bias, Eq. 17
};

/// Weighted mean of maps, each kept within bounds of its own.
struct BlendForm {
  struct Member {
    std::string name;
    double weight = 0.0;               // of all members: sum 1
    std::vector<Eigen::Index> inputs;  // of the blend, that the member reads
    double lowest = 0.0;               // target's unit; may be infinite
    double highest = 0.0;
    Eigen::Index parameters = 0;
    std::variant<PolynomialForm, NetForm> form;
  };
  Eigen::Index num_inputs = 0;
  std::string rule;  // where the weights come from
  std::vector<Member> members;
};

/// Work of one prediction, counted rather than timed: the same on any machine.
struct PredictionCost {
  Eigen::Index multiplications = 0;
  Eigen::Index exponentials = 0;
};

/// A model that says no more of itself: it takes part in studies and reports,
/// but no file can hold it and no controller can run it.
struct OpaqueForm {
  Eigen::Index num_inputs = 0;
  PredictionCost cost;  // 0 where it does not say
};

/// What a model is, as plain data: for model files and exporters.
using ModelDescription =
    std::variant<PolynomialForm, NetForm, BlendForm, OpaqueForm>;

/// Throws std::invalid_argument, "<what> needs a map's formula, ...", where the
/// form is opaque.
void RequireFormula(const ModelDescription& form, std::string_view what);

PredictionCost CostOf(const PolynomialForm& form);
PredictionCost CostOf(const NetForm& form);
PredictionCost CostOf(const BlendForm& form);
PredictionCost CostOf(const OpaqueForm& form);
PredictionCost CostOf(const ModelDescription& form);

/// A fitted map from p inputs to one predicted error; immutable, and safe to
/// use from several threads. Others may derive models of their own: a recipe
/// that makes them (ModelRecipe) can be put into any study.
class ErrorModel {
 public:
  virtual ~ErrorModel() = default;
  virtual Eigen::Index num_inputs() const = 0;
  virtual Eigen::Index num_parameters() const = 0;
  /// Error (m) in the training target's unit, per row of `inputs` (m x p). A
  /// row's prediction does not depend on the rows around it, to the last bit.
  /// Throws std::invalid_argument unless inputs.cols() == p.
  Eigen::VectorXd Predict(const Eigen::MatrixXd& inputs) const;
  /// The same of one row (p); asks for no memory in the models of this library,
  /// but for very large ones.
  double PredictRow(std::span<const double> inputs) const;
  /// An OpaqueForm, unless a model knows better.
  virtual ModelDescription Describe() const;

 private:
  // Of num_inputs() numbers.
  virtual double DoPredictRow(const double* inputs) const = 0;
  // Of rows of num_inputs() numbers; one by one, unless a model that others
  // made knows a quicker way.
  virtual Eigen::VectorXd DoPredict(const Eigen::MatrixXd& inputs) const;
};

/// kFile: a map, or predictions, made elsewhere.
enum class ModelKind { kBaseline, kPolynomial, kNet, kBlend, kFile };
std::string_view ToString(ModelKind kind);

/// An input of a model and where it was trained.
struct TrainedInput {
  data::ColumnInfo column;
  double min = 0.0;
  double max = 0.0;
  double mean = 0.0;
  double sd = 0.0;
};

struct RegressionReport;

/// An option with the value that took effect.
struct EffectiveOption {
  std::string key;
  std::variant<std::int64_t, double, std::string> value;
};

/// One of several starts of an iterative fit.
struct StartResult {
  std::uint64_t seed = 0;
  double final_cost = std::numeric_limits<double>::quiet_NaN();
  fitting::Termination stop = fitting::Termination::kFailed;
  std::int64_t iterations = 0;
  /// On inner hold-outs, in the target's unit; NaN where not asked for.
  double holdout_rmse = std::numeric_limits<double>::quiet_NaN();
  bool chosen = false;
};

struct History;
struct Applicability;
struct HeldOutErrors;
struct LearntRows;

struct Bounds {
  double low, high;
};

/// [min - m * range, max + m * range]: the one way that guards widen a range,
/// so that fits, predictions and exported programs clip at the same bits.
inline Bounds Widened(double min, double max, double margin) {
  const double widened = margin * (max - min);
  return {min - widened, max + widened};
}

/// Bounds within which a map was trained: what goes beyond is clipped to them.
/// A column that hardly moved in training may move far on another day.
struct Guards {
  /// Inputs of the form are clipped at their range, Widened by this.
  double input_margin = 2.0;
  /// Predictions likewise.
  double error_margin = 0.3;
  Eigen::VectorXd input_min;  // (inputs of the form) in training
  Eigen::VectorXd input_max;
  double error_min = 0.0;  // of the target in training, in its unit
  double error_max = 0.0;

  Bounds InputBounds(Eigen::Index input) const {
    return Widened(input_min[input], input_max[input], input_margin);
  }
  Bounds ErrorBounds() const {
    return Widened(error_min, error_max, error_margin);
  }
};

/// Guards with the default margins at the trained range of the form's inputs
/// and of `targets` (at least one). Where the map goes on in an input that only
/// grows, the error may leave its range by as much again.
Guards MakeGuards(const std::vector<TrainedInput>& form_inputs,
                  const Eigen::VectorXd& targets,
                  bool grows = false);

struct Prediction {
  Eigen::VectorXd errors;  // (m) target's unit
  /// (m) whether an input of the form, or the error, was clipped.
  Eigen::Array<bool, Eigen::Dynamic, 1> clipped;
};

/// A model with what is needed to use and to judge it.
struct FittedModel {
  std::string name;  // the SPEC as given
  ModelKind kind = ModelKind::kPolynomial;
  data::ColumnInfo target;
  data::Alignment align = data::Alignment::kNone;  // of the target
  /// Rows that it is made for, such as those of one direction; none: all.
  std::vector<data::ColumnFilter> where;
  /// Columns that the map reads, in the order of the form, which reads the
  /// inputs derived from them where there is a history.
  std::vector<TrainedInput> inputs;
  std::shared_ptr<const ErrorModel> model;
  fitting::FitSummary summary;
  std::string equation;  // in physical units; "" where there is none
  std::vector<std::string> remarks;  // such as aliased terms; one line each
  /// Values that the fit itself chose, such as wfactor=cv.
  std::vector<EffectiveOption> choices;
  std::vector<StartResult> starts;  // empty where there was one only
  /// Of polynomials where FitContext asks to explain, else null.
  std::shared_ptr<const RegressionReport> regression;
  /// How the inputs of the form are derived (models/history/history.h); null:
  /// the form reads `inputs` as they are.
  std::shared_ptr<const History> history;
  std::optional<Guards> guards;  // nothing is clipped without them
  /// RMSE on the inner hold-outs of what the fit chose there (target's unit);
  /// NaN where it chose nothing.
  double inner_rmse = std::numeric_limits<double>::quiet_NaN();
  /// What rows held out say of predictions; nothing where none were.
  std::optional<PredictionInterval> interval;
  /// Where it was trained (map_experience.h); may be null.
  std::shared_ptr<const Applicability> applicability;
  /// The errors behind the interval, or null.
  std::shared_ptr<const HeldOutErrors> held_out;
  /// The rows of training, or null.
  std::shared_ptr<const LearntRows> learnt;
  /// How the file was understood that it was trained on, or null.
  std::shared_ptr<const data::Reading> reading;

  /// How many of the rows that it was given: a net draws some of very many.
  Eigen::Index RowsLearntFrom(const data::Dataset& training) const;
  /// (m x inputs of the form) of every row; `inputs` are found by name. Throws
  /// std::invalid_argument naming an input not there, or where the sessions
  /// and times that the history needs are not known.
  Eigen::MatrixXd FormInputs(const data::Dataset& dataset) const;
  /// Clips, predicts, clips. Throws std::invalid_argument on another number of
  /// columns than the form has inputs.
  Prediction PredictForm(const Eigen::MatrixXd& form_inputs) const;
  /// The same of one row, without memory being asked for; `clipped` may be
  /// null.
  double PredictFormRow(std::span<const double> form_inputs,
                        bool* clipped) const;
  /// Predicted error (m) of every row, in the unit of `target`. Throws as
  /// FormInputs.
  Eigen::VectorXd Predict(const data::Dataset& dataset) const;
};

/// How rows are held out for the choices made inside a fit: as outside of it,
/// so that what is chosen is what does well there (inner_folds.h). Where the
/// training rows have fewer than two of a kind the next finer one serves.
enum class InnerHoldout {
  /// Of the kind that decides which map is recommended: whole sessions where
  /// there are kFewestSessionsToDecide, else whole groups, else blocks.
  kDecisive,
  kWholeSessions,  // else kWholeGroups
  kWholeGroups,    // else kBlocks
  kBlocks,         // contiguous runs of rows
  kRows,
  kForward,
};
/// "decisive", "sessions", "groups", "blocks", "rows", "forward".
std::string_view ToString(InnerHoldout inner);

/// Two or three days hardly tell which map does well on another one.
inline constexpr Eigen::Index kFewestSessionsToDecide = 4;

class SharedWork;

/// What a fit may use besides the training rows.
struct FitContext {
  std::uint64_t seed = 1;
  const std::atomic<bool>* stop = nullptr;
  /// Also make the report of a regression (tables, and bootstraps), and judge
  /// each of several starts by inner hold-outs.
  bool explain = false;
  /// Explain with the recipe's default number of bootstraps; without it, with
  /// as many as its options ask for.
  bool default_bootstraps = true;
  int threads = 1;  // at least 1; changes no figure
  /// Numbers that a design matrix may hold (8 bytes each); a larger one is
  /// reduced to a triangle in one pass over the rows.
  double most_design_values = 2e7;
  bool keep_trace = false;  // of an iterative fit, in its summary
  InnerHoldout inner_holdout = InnerHoldout::kDecisive;
  /// The difference in error that never matters (target's unit).
  double indifference = 0.0;
  /// Of the rows that are fitted: what several recipes need is made once. May
  /// be null.
  SharedWork* shared = nullptr;
};

/// How to fit one kind of model: kind and options; immutable.
class ModelRecipe {
 public:
  virtual ~ModelRecipe() = default;
  /// The SPEC as the user wrote it.
  virtual std::string name() const = 0;
  virtual ModelKind kind() const = 0;
  virtual std::vector<EffectiveOption> options() const { return {}; }
  /// What the data lack for this model ("a position column"), if anything.
  virtual std::optional<std::string> WhatIsMissing(
      const data::Dataset& /*dataset*/) const {
    return std::nullopt;
  }
  /// Number of coefficients over these data where it is known before the fit.
  virtual std::optional<Eigen::Index> NumCoefficients(
      const data::Dataset& /*dataset*/) const {
    return std::nullopt;
  }
  /// Fits the rows of `training` and sees no others: scaling and every tuned
  /// choice are learnt here. Throws std::invalid_argument with the reason
  /// where these rows cannot be fitted (too few, an input missing).
  virtual FittedModel Fit(const data::Dataset& training,
                          const FitContext& context) const = 0;
};

/// What a recipe's Fit returns of a model that reads every input of `training`
/// as it is and took no iterations.
FittedModel MapOfModel(const ModelRecipe& recipe,
                       const data::Dataset& training,
                       std::shared_ptr<const ErrorModel> model);

/// Position of a data set: the input `wanted`, or by default the first that
/// the Reading has made one; -1 where there is none. Throws
/// std::invalid_argument where `wanted` is named and not an input.
Eigen::Index FindPosition(const data::Dataset& dataset,
                          const std::string& wanted);

/// The inputs `columns` of `training` with their trained range.
std::vector<TrainedInput> DescribeInputs(
    const data::Dataset& training, const std::vector<Eigen::Index>& columns);

}  // namespace errmap::models
