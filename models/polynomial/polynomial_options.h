#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fitting/information_criteria.h"
#include "fitting/least_squares/penalized_path.h"
#include "fitting/selection/stepwise_selection.h"
#include "models/error_model.h"
#include "models/history/view.h"
#include "models/polynomial/formula.h"
#include "models/polynomial/term_set.h"

namespace errmap::models {

// Options of constants and polynomials. `Validate` throws
// std::invalid_argument naming option, value and range, or the contradiction;
// so does `MakeRecipe`. The recipe's name is `name`; if that is empty,
// SpecOf(options).

/// zero (no compensation at all) and mean.
struct ConstantOptions {
  bool is_zero = false;

  std::string_view type() const { return is_zero ? "zero" : "mean"; }
  void Validate() const;
  bool operator==(const ConstantOptions&) const = default;
};

/// The report's forms in position x and one temperature T; two of the forms use
/// only one of these.
enum class PositionTemperatureForm {
  kPosition,
  kTemperature,
  kEq7,
  kEq8,
  kEq9,
};

/// poly:position, poly:temperature, poly:eq7, poly:eq8, poly:eq9.
struct PositionTemperatureOptions {
  PositionTemperatureForm form = PositionTemperatureForm::kEq8;
  std::string position = {};     // "": the first position
  std::string temperature = {};  // T; "": the input that fits best
  bool clip = true;              // true: the map is guarded (ClampLimits)

  std::string_view type() const;
  void Validate() const;
  bool operator==(const PositionTemperatureOptions&) const = default;
};

/// poly:full: all products up to a degree.
struct FullOptions {
  int degree = 2;    // 1 .. 12
  bool clip = true;  // true: the map is guarded (ClampLimits)

  std::string_view type() const { return "poly:full"; }
  void Validate() const;
  bool operator==(const FullOptions&) const = default;
};

/// Terms to choose from.
struct TermOptions {
  TermSet set = TermSet::kFull;
  std::optional<int> degree = {};      // 1 .. 4; empty: DefaultDegreeOf the set
  Centring centring = Centring::kAll;  // or kNone
  std::vector<NamedTerm> include = {};
  std::vector<NamedTerm> exclude = {};

  bool operator==(const TermOptions&) const = default;
};

/// poly:stepwise: terms chosen one by one (fitting::StepwiseOptions).
struct StepwiseOptions {
  /// Value of max_terms without a limit.
  static constexpr std::int64_t kNoLimit = -1;

  fitting::Criterion criterion = fitting::Criterion::kBic;
  std::optional<fitting::Criterion> select = {};  // empty: the criterion
  std::optional<fitting::Criterion> stop = {};
  std::optional<fitting::Criterion> choose = {};
  fitting::Direction direction = fitting::Direction::kForward;
  fitting::Heredity heredity = fitting::Heredity::kNone;
  /// p-values, 0 < enter <= remove < 1; used only if p selects or stops. Empty:
  /// 0.05, and the larger of 0.10 and `enter`.
  std::optional<double> enter = {};
  std::optional<double> remove = {};
  /// 0 .. 1,000,000, or kNoLimit; empty: a fifth of the rows.
  std::optional<std::int64_t> max_terms = {};
  std::optional<double> sigma2 = {};  // for Cp, above 0; empty: estimated
  /// 0 .. 1,000,000 for the report; empty: 200 if the rows are few.
  std::optional<std::int64_t> bootstrap = {};
  TermOptions terms = {};
  /// Its `intercept` is always true.
  std::optional<ViewOptions> view = {};
  bool clip = true;  // true: the map is guarded (ClampLimits)

  std::string_view type() const { return "poly:stepwise"; }
  void Validate() const;
  bool operator==(const StepwiseOptions&) const = default;
};

/// poly:best: the best of all subsets (fitting::BestSubsetOptions).
struct BestSubsetOptions {
  fitting::Criterion criterion = fitting::Criterion::kBic;  // not p, PRESS, CV
  std::optional<std::int64_t> max_terms = {};  // 0 .. 48; empty: no limit
  std::optional<double> sigma2 = {};  // for Cp, above 0; empty: estimated
  std::int64_t bootstrap = 0;         // 0 .. 1,000,000 for the report
  TermOptions terms = {};
  bool clip = true;  // true: the map is guarded (ClampLimits)

  std::string_view type() const { return "poly:best"; }
  void Validate() const;
  bool operator==(const BestSubsetOptions&) const = default;
};

/// Rule to choose a penalty.
struct PenaltyRule {
  /// The strength, if given, at least 0; empty: chosen by inner hold-outs.
  std::optional<double> strength = {};
  /// True to take the strongest penalty within one standard error of the least
  /// error (Breiman et al. 1984).
  bool one_standard_error = false;

  bool operator==(const PenaltyRule&) const = default;
};

/// Bases of a penalised family.
struct BasisOptions {
  std::optional<ViewOptions> view = {};
  std::optional<TermSet> terms = {};  // empty: those that suit, if a view is
                                      // given, else full
  std::optional<int> degree = {};     // 1 .. 4; empty: that of the terms
  Centring centring = Centring::kStandardised;  // or kAll, kNone
  std::vector<NamedTerm> exclude = {};
  bool clip = true;  // true: the map is guarded (ClampLimits)
  /// PenalizedBasis::between if the inner hold-outs are of whole sessions;
  /// above 0, at most 1. Empty: a quarter if a view is given and no column only
  /// grows, else 1.
  std::optional<double> between = {};

  bool operator==(const BasisOptions&) const = default;

  /// Returns true if more than one basis may be tried.
  bool chooses_basis() const { return view && (!view->view || !terms); }
};

/// poly:ridge and poly:lasso: all terms of a basis, shrunk.
struct PenalizedOptions {
  fitting::Penalty family = fitting::Penalty::kRidge;
  PenaltyRule penalty = {};
  BasisOptions basis = {};

  std::string_view type() const;
  void Validate() const;
  bool operator==(const PenalizedOptions&) const = default;
};

/// poly:formula=...: the terms as written.
struct FormulaOptions {
  std::string formula = {};                 // as ParseTerms reads them
  Centring centring = Centring::kHarmless;  // or kNone
  bool intercept = true;
  /// Names one view; its `intercept` is not used.
  std::optional<ViewOptions> view = {};
  bool clip = true;  // true: the map is guarded (ClampLimits)

  std::string_view type() const { return "poly"; }
  void Validate() const;
  bool operator==(const FormulaOptions&) const = default;
};

std::unique_ptr<ModelRecipe> MakeRecipe(const ConstantOptions& options,
                                        std::string name = "");
std::unique_ptr<ModelRecipe> MakeRecipe(
    const PositionTemperatureOptions& options, std::string name = "");
std::unique_ptr<ModelRecipe> MakeRecipe(const FullOptions& options,
                                        std::string name = "");
std::unique_ptr<ModelRecipe> MakeRecipe(const StepwiseOptions& options,
                                        std::string name = "");
std::unique_ptr<ModelRecipe> MakeRecipe(const BestSubsetOptions& options,
                                        std::string name = "");
std::unique_ptr<ModelRecipe> MakeRecipe(const PenalizedOptions& options,
                                        std::string name = "");
std::unique_ptr<ModelRecipe> MakeRecipe(const FormulaOptions& options,
                                        std::string name = "");

}  // namespace errmap::models
