#pragma once

#include <string>
#include <vector>

#include "fitting/least_squares/regression_diagnostics.h"
#include "models/error_model.h"
#include "models/option_list.h"
#include "models/polynomial/polynomial_design.h"
#include "models/regression_record.h"

namespace errmap::models {

/// Returns the columns 0 .. p-1.
std::vector<Index> AllColumns(const data::Dataset& dataset);

/// Returns the form in which terms are fitted.
struct FormOptions {
  Centring centring = Centring::kAll;
  bool intercept = true;
};

/// Base of all recipes of polynomials.
class PolynomialRecipe : public ModelRecipe {
 public:
  /// `guarded`: results of FitTerms are clipped (ClampLimits).
  PolynomialRecipe(std::string name, bool guarded)
      : name_(std::move(name)), guarded_(guarded) {}
  std::string name() const override { return name_; }
  ModelKind kind() const override { return ModelKind::kPolynomial; }

 protected:
  /// Fits intercept and `terms` by least squares in the columns `inputs` of
  /// `training`. Terms that depend on earlier ones are omitted and named.
  /// Coefficients are refined in 106 bits if the condition leaves double fewer
  /// than 13 digits. With context.explain it adds the report, to which a caller
  /// adds how it chose the terms; the map is the same. Throws
  /// std::invalid_argument if there are fewer rows than coefficients.
  FittedModel FitTerms(const data::Dataset& training,
                       const std::vector<Index>& inputs,
                       const std::vector<TermPowers>& terms,
                       const FitContext& context,
                       const FormOptions& form_options = {},
                       RegressionRecord* report = nullptr) const;

 private:
  std::string name_;
  bool guarded_;
};

/// Base of those with options.
template <typename Options>
class PolynomialRecipeWith : public PolynomialRecipe {
 public:
  PolynomialRecipeWith(const Options& options, std::string name, bool guarded)
      : PolynomialRecipe(CheckedName(options, std::move(name)), guarded),
        options_(options) {}
  std::vector<EffectiveOption> options() const final {
    return InEffect(options_);
  }

 protected:
  Options options_;  // those in effect
};

/// Returns the `chosen` terms of a design, over only the inputs that they
/// contain.
struct UsedTerms {
  std::vector<Index> inputs;
  std::vector<TermPowers> terms;
};
UsedTerms KeepUsedInputs(const std::vector<TermPowers>& terms,
                         const std::vector<Index>& chosen);

/// Returns why `column` (n) adds nothing to `intercept` (n; 0: ones) and
/// `others` (n x k), terms with these names: "is constant", "repeats t1_degC",
/// "follows from ...".
std::string WhyAliased(const VectorXd& column,
                       const MatrixXd& others,
                       const std::vector<std::string>& names,
                       const VectorXd& intercept);

/// Fills the lines of the coefficient table in the inputs' own units, and
/// their centres; `fit` is in scaled terms. Keeps the bootstrap inclusions of
/// lines that `report` already has, one for each term.
void FillCoefficientTable(const PolynomialDesign& design,
                          const fitting::RegressionDiagnostics& fit,
                          RegressionRecord* report);

}  // namespace errmap::models
