#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "fitting/minimisers/ceres_optimizer.h"
#include "fitting/minimisers/gradient_descent.h"
#include "fitting/minimisers/nlopt_optimizer.h"
#include "fitting/minimisers/optimizer.h"
#include "fitting/minimisers/scaled_conjugate_gradient.h"
#include "models/error_model.h"
#include "models/history/view.h"
#include "models/net/net_design.h"

namespace errmap::models {

/// Marks a number as chosen on inner hold-outs.
struct ByCrossValidation {};
inline constexpr ByCrossValidation kByCrossValidation;

/// A number, or kByCrossValidation.
template <typename Value>
class GivenOrByCv {
 public:
  constexpr GivenOrByCv(Value value) : value_(value) {}
  constexpr GivenOrByCv(ByCrossValidation /*by_cv*/) {}

  constexpr bool by_cv() const { return !value_.has_value(); }
  /// Returns the number, which must be given.
  constexpr explicit operator Value() const { return *value_; }
  bool operator==(const GivenOrByCv&) const = default;

 private:
  std::optional<Value> value_;
};

// Training methods of a net, one type each.

/// net:scg: fitting::ScaledConjugateGradient.
struct ScgTraining {
  fitting::ScgVariant variant = fitting::ScgVariant::kMoller;
  bool is_single = false;  // float instead of double

  bool operator==(const ScgTraining&) const = default;
};

/// net:lm: fitting::LevenbergMarquardt.
struct LmTraining {
  bool operator==(const LmTraining&) const = default;
};

/// net:cg: fitting::ConjugateGradient.
struct CgTraining {
  bool operator==(const CgTraining&) const = default;
};

/// net:backprop: fitting::GradientDescent.
struct BackpropTraining {
  /// 1e-12 .. 1e12
  double learning_rate = fitting::GradientDescentOptions().learning_rate;
  /// 0 .. 0.999999
  double momentum = fitting::GradientDescentOptions().momentum;

  bool operator==(const BackpropTraining&) const = default;
};

/// net:ceres: fitting::CeresOptimizer.
struct CeresTraining {
  fitting::CeresMethod method = fitting::CeresMethod::kAuto;
  int memory = fitting::CeresOptions().memory;  // 1 .. 1000

  bool operator==(const CeresTraining&) const = default;
};

/// net:nlopt: fitting::NloptOptimizer.
struct NloptTraining {
  fitting::NloptMethod method = fitting::NloptMethod::kLbfgs;
  int memory = fitting::NloptOptions().memory;  // 1 .. 1000
  double box = fitting::NloptOptions().box;     // of kCrs2Lm, 1e-6 .. 1e6

  bool operator==(const NloptTraining&) const = default;
};

using NetMethod = std::variant<ScgTraining,
                               LmTraining,
                               CgTraining,
                               BackpropTraining,
                               CeresTraining,
                               NloptTraining>;

/// Parameters that wfactor shrinks towards 0.
enum class Decay {
  kAll,      // every weight and bias, as in the report
  kWeights,  // no bias: an offset of the inputs costs nothing
};

/// Rule to choose among several starts: lowest cost, or least error on inner
/// hold-outs.
enum class StartRule { kCost, kCrossValidation };

/// A net with one hidden layer. Defaults of empty options depend on the others
/// (Resolved), since a net in a view must hold beyond its training data.
struct NetOptions {
  NetMethod method = ScgTraining{};
  /// Number of nodes, 1 .. 10,000; empty: 20, in a view 16.
  std::optional<GivenOrByCv<std::int64_t>> hidden = {};
  /// wfactor of Eq. 20, 0 .. 1e6; empty: 1e-5, in a view chosen by
  /// cross-validation.
  std::optional<GivenOrByCv<double>> wfactor = {};
  /// Empty: weights and biases, or in a view only the weights. net:lm and
  /// net:ceres always shrink both.
  std::optional<Decay> decay = {};
  /// Instead of a wfactor: takes the largest wfactor whose RMS residual on the
  /// training rows is at most this (Eq. 126-135). Above 0, in the target's
  /// unit.
  std::optional<double> discrepancy = {};
  /// The fit goes down WfactorPath. Empty: true if it chooses the wfactor of a
  /// view.
  std::optional<bool> path = {};
  /// Limit of a fit, including its path; 1 .. 1e9. Empty: 1500, for net:lm 200,
  /// in a view at most 500.
  std::optional<std::int64_t> iterations = {};
  /// 0 .. 1e12 (fitting::StoppingRules::cost_goal).
  double egoal = fitting::StoppingRules().cost_goal;
  /// 0 .. 1e12 (fitting::StoppingRules::gradient_goal).
  double gwgoal = fitting::StoppingRules().gradient_goal;
  InputScaling scale = InputScaling::kStandard;
  OutputFunction output = OutputFunction::kSigmoid;
  double slope = 1.0;  // slope of the sigmoid, Eq. 12; 1e-3 .. 1e3
  /// At least 1 (fitting::StoppingRules::evaluations).
  std::int64_t evaluations = fitting::StoppingRules().evaluations;
  /// 1e-6 .. 1e12 (fitting::StoppingRules::slow_ratio); empty: never stops.
  std::optional<double> errdel = {};
  /// 1 .. 1e9 (fitting::StoppingRules::progress_interval).
  std::int64_t nfreq = fitting::StoppingRules().progress_interval;
  std::optional<double> seconds = {};  // 1e-3 .. 1e12; empty: no limit
  /// Number of starts, of which the best is taken, 1 .. 10,000; empty: 1.
  std::optional<std::int64_t> starts = {};
  std::optional<StartRule> choose = {};  // for several starts; empty: kCost
  /// Number of starts averaged, 1 .. 100. Empty: 1, in a view 3 unless `starts`
  /// or `discrepancy` is given.
  std::optional<std::int64_t> members = {};
  /// Maximum number of training rows, at least 100; kAllRows uses all. Time
  /// grows with the rows, but accuracy hardly does beyond this number.
  std::int64_t rows = 20'000;
  std::optional<ViewOptions> view = {};
  bool clip = true;  // true: the map is guarded (ClampLimits)

  static constexpr std::int64_t kAllRows =
      std::numeric_limits<std::int64_t>::max();

  std::string_view type() const;
  /// Throws std::invalid_argument naming option, value and range, or the
  /// contradiction.
  void Validate() const;
  bool operator==(const NetOptions&) const = default;

  /// Returns the options with all empty ones filled in, except wfactor with a
  /// discrepancy, and choose with one start.
  NetOptions Resolved() const;

  // For resolved options:
  NetDesign design() const;
  fitting::StoppingRules stopping() const;
  bool tunes_hidden() const { return hidden->by_cv(); }
  bool tunes_wfactor() const { return wfactor && wfactor->by_cv(); }
  /// Returns the wfactor given, or the default if the fit chooses it.
  double given_wfactor() const;
};

/// Throws like Validate. The recipe's name is `name`; if that is empty,
/// SpecOf(options).
std::unique_ptr<ModelRecipe> MakeRecipe(const NetOptions& options,
                                        std::string name = "");

}  // namespace errmap::models
