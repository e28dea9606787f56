#pragma once

#include <string>
#include <vector>

#include "models/error_model.h"
#include "models/polynomial/polynomial_design.h"
#include "models/regression_report.h"

namespace errmap::models {

/// Columns 0 .. p-1.
std::vector<Eigen::Index> AllColumns(const data::Dataset& dataset);

/// The form that terms are fitted in.
struct FormOptions {
  Centring centring = Centring::kAll;
  bool intercept = true;
};

/// The part that every recipe of a polynomial shares.
class PolynomialRecipe : public ModelRecipe {
 public:
  /// `guarded`: what FitTerms gives is clipped (Guards).
  PolynomialRecipe(std::string name, bool guarded)
      : name_(std::move(name)), guarded_(guarded) {}
  std::string name() const override { return name_; }
  ModelKind kind() const override { return ModelKind::kPolynomial; }
  std::vector<EffectiveOption> options() const override { return {}; }
  std::optional<std::string> WhatIsMissing(
      const data::Dataset& /*dataset*/) const override {
    return std::nullopt;
  }

 protected:
  /// A fit that says where it comes from, without a model yet.
  FittedModel NewModel(const data::Dataset& training) const;

  /// Least squares of intercept and `terms` in the columns `inputs` of
  /// `training`; terms that follow from those before them are left out and
  /// named. Coefficients are refined in 106 bits where the condition leaves
  /// double fewer than 13 digits. With context.explain there is the report,
  /// which a caller that chose the terms completes; the map is the same. Throws
  /// std::invalid_argument where there are fewer rows than coefficients.
  FittedModel FitTerms(const data::Dataset& training,
                       const std::vector<Eigen::Index>& inputs,
                       const std::vector<TermPowers>& terms,
                       const FitContext& context,
                       const FormOptions& form_options = {},
                       RegressionReport* report = nullptr) const;

 private:
  std::string name_;
  bool guarded_;
};

/// The terms `chosen` of a design over all inputs, over only those inputs that
/// one of them has.
struct UsedTerms {
  std::vector<Eigen::Index> inputs;
  std::vector<TermPowers> terms;
};
UsedTerms KeepUsedInputs(const std::vector<TermPowers>& terms,
                         const std::vector<Eigen::Index>& chosen);

/// Why `column` (n) adds nothing to `intercept` (n; 0: ones) and `others`
/// (n x k), terms of these names: "is constant", "repeats t1_degC",
/// "follows from ...".
std::string WhyAliased(const Eigen::VectorXd& column,
                       const Eigen::MatrixXd& others,
                       const std::vector<std::string>& names,
                       const Eigen::VectorXd& intercept);

/// The lines of the coefficient table in the inputs' own units, and their
/// centres; `fit` is in scaled terms.
void FillCoefficientTable(const PolynomialDesign& design,
                          RegressionReport* report);

}  // namespace errmap::models
