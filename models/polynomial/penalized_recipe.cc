#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "fitting/least_squares/penalized_regression.h"
#include "models/inner_folds.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/polynomial/selection_recipe.h"
#include "models/polynomial/term_dictionary.h"
#include "models/regression_report.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;

// All terms, their coefficients shrunk.
class PenalizedRecipe final : public PolynomialRecipe {
 public:
  explicit PenalizedRecipe(const ModelSpec& spec)
      : PolynomialRecipe(spec.text) {
    rules_.penalty = spec.type == "poly:ridge" ? fitting::Penalty::kRidge
                                               : fitting::Penalty::kLasso;
    SpecOptions options(spec);
    terms_ = TermOptions::Take(&options, false);
    rules_.strength =
        options.TakeNumber("penalty",
                           std::numeric_limits<double>::quiet_NaN(),
                           0.0,
                           std::numeric_limits<double>::max());
    rules_.one_standard_error =
        options.TakeChoice("rule", 0, {"min", "1se"}) == 1;
    if (rules_.one_standard_error && !std::isnan(rules_.strength)) {
      throw std::invalid_argument(fmt::format(
          "model '{}': rule= chooses the penalty, which penalty= fixes",
          spec.text));
    }
    options.RefuseOthers();
  }

  std::vector<EffectiveOption> options() const override {
    std::vector<EffectiveOption> options;
    if (std::isnan(rules_.strength)) {
      options.push_back(
          {"rule", std::string(rules_.one_standard_error ? "1se" : "min")});
    } else {
      options.push_back({"penalty", rules_.strength});
    }
    terms_.Describe(&options);
    return options;
  }

  std::optional<Index> NumCoefficients(const Dataset&) const override {
    return std::nullopt;
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    if (training.num_rows() < 3) {
      throw std::invalid_argument(
          fmt::format("needs at least 3 rows, found {}", training.num_rows()));
    }
    const int degree = terms_.degree > 0 ? terms_.degree
                                         : DefaultDegree(training.num_inputs());
    const TermDictionary dictionary(training, degree, terms_);
    InnerFolds folds;
    if (std::isnan(rules_.strength)) {
      folds = MakeInnerFolds(training, context);
    }
    DesignRows rows = CollectRows(dictionary.design,
                                  folds.folds.codes,
                                  context.most_design_values,
                                  context.threads);
    // A column of zeros takes no part.
    for (Index j = 0; j < rows.terms.cols(); ++j) {
      if (dictionary.excluded[static_cast<std::size_t>(j)]) {
        rows.terms.col(j).setZero();
      }
    }
    const fitting::RegressionProblem problem{rows.terms,
                                             rows.response,
                                             rows.weights,
                                             rows.intercept,
                                             rows.observations};
    const fitting::PenalizedFit fit = fitting::FitPenalized(
        problem, {rows.parts, folds.folds.forward}, rules_);
    FittedModel fitted =
        MapOf(dictionary.design, fit.intercept, fit.coefficients);
    fitted.summary.final_cost = 0.5 * fit.residual_sum_of_squares;
    fitted.summary.message = fmt::format(
        "penalty {:.3g}{}, {:.1f} effective parameters, {} of {} terms up to "
        "degree {}",
        fit.strength,
        folds.text.empty() ? "" : " by cross-validation over " + folds.text,
        fit.degrees_of_freedom,
        (fit.coefficients.array() != 0.0).count(),
        fit.coefficients.size(),
        degree);
    if (rules_.penalty == fitting::Penalty::kLasso) {
      fitted.remarks.push_back("chosen: " + ChosenNames(dictionary, fit));
    }
    if (context.explain) Explain(dictionary, rows, folds, fit, &fitted);
    return fitted;
  }

 private:
  static std::string ChosenNames(const TermDictionary& dictionary,
                                 const fitting::PenalizedFit& fit) {
    const std::vector<std::string> names = dictionary.design.TermNames();
    std::string chosen;
    for (Index j = 0; j < fit.coefficients.size(); ++j) {
      if (fit.coefficients[j] == 0.0) continue;
      if (!chosen.empty()) chosen += ", ";
      chosen += names[static_cast<std::size_t>(j)];
    }
    return chosen.empty() ? "none" : chosen;
  }

  void Explain(const TermDictionary& dictionary,
               const DesignRows& rows,
               const InnerFolds& folds,
               const fitting::PenalizedFit& fit,
               FittedModel* fitted) const {
    auto report = std::make_shared<RegressionReport>();
    const bool ridge = rules_.penalty == fitting::Penalty::kRidge;
    report->method = fmt::format(
        "{} over {} terms up to degree {}, penalty {:.6g}{} on columns of "
        "variance 1",
        ridge ? "ridge" : "lasso",
        dictionary.NumOpen(),
        dictionary.degree,
        fit.strength,
        folds.text.empty() ? "" : " by cross-validation over " + folds.text);
    report->penalised = true;
    report->weighted = dictionary.design.dataset().weights().size() != 0;
    report->candidates = dictionary.design.num_terms();
    report->cross_validation = folds.text;
    report->strength = fit.strength;
    report->degrees_of_freedom = fit.degrees_of_freedom;
    report->strengths = fit.strengths;
    report->mean_squared_errors = fit.mean_squared_errors;
    report->standard_errors = fit.standard_errors;
    // The table needs estimates only, so the fit is filled by hand.
    report->fit.observations = rows.observations;
    report->fit.residual_sum_of_squares = fit.residual_sum_of_squares;
    report->fit.intercept.estimate = fit.intercept;
    report->fit.coefficients.resize(
        static_cast<std::size_t>(fit.coefficients.size()));
    for (Index j = 0; j < fit.coefficients.size(); ++j) {
      report->fit.coefficients[static_cast<std::size_t>(j)].estimate =
          fit.coefficients[j];
    }
    FillCoefficientTable(dictionary.design, report.get());
    std::erase_if(report->terms, [](const ReportTerm& term) {
      return term.numbers.estimate == 0.0;
    });
    fitted->regression = std::move(report);
  }

  TermOptions terms_;
  fitting::PenalizedOptions rules_;
};

}  // namespace

std::unique_ptr<ModelRecipe> MakePenalizedRecipe(const ModelSpec& spec) {
  return std::make_unique<PenalizedRecipe>(spec);
}

}  // namespace errmap::models
