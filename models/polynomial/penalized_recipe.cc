#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "models/inner_folds.h"
#include "models/polynomial/penalized_candidates.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/polynomial/selection_recipe.h"
#include "models/polynomial/term_dictionary.h"
#include "models/regression_report.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;
using fitting::Penalty;

// All terms of a basis, their coefficients shrunk.
class PenalizedRecipe final : public PolynomialRecipe {
 public:
  explicit PenalizedRecipe(const ModelSpec& spec)
      : PolynomialRecipe(spec.text),
        penalty_(spec.type == "poly:ridge" ? Penalty::kRidge
                                           : Penalty::kLasso) {
    SpecOptions options(spec);
    choices_ = PenalizedChoices::Take(&options);
    const double strength =
        options.TakeNumber("penalty",
                           std::numeric_limits<double>::quiet_NaN(),
                           0.0,
                           std::numeric_limits<double>::max());
    if (!std::isnan(strength)) choices_.rule.strength = strength;
    choices_.rule.one_standard_error =
        options.TakeChoice("rule", 0, {"min", "1se"}) == 1;
    if (choices_.rule.strength) {
      if (choices_.rule.one_standard_error) {
        throw std::invalid_argument(fmt::format(
            "model '{}': rule= chooses the penalty, which penalty= fixes",
            spec.text));
      }
      if (choices_.chooses_basis()) {
        throw std::invalid_argument(fmt::format(
            "model '{}': penalty= is of one basis; name view= and terms= too",
            spec.text));
      }
    }
    options.RefuseOthers();
  }

  std::vector<EffectiveOption> options() const override {
    std::vector<EffectiveOption> options;
    if (choices_.rule.strength) {
      options.push_back({"penalty", *choices_.rule.strength});
    } else {
      options.push_back(
          {"rule",
           std::string(choices_.rule.one_standard_error ? "1se" : "min")});
    }
    choices_.Describe(&options);
    return options;
  }

  std::optional<std::string> WhatIsMissing(
      const Dataset& dataset) const override {
    if (dataset.num_inputs() > 0) return std::nullopt;
    return "inputs: there is nothing to penalise";
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
    const InnerFolds folds = choices_.rule.strength
                                 ? InnerFolds()
                                 : MakeInnerFolds(training, context);
    const std::vector<BasisCandidate> candidates =
        JudgeBases(training, choices_, {penalty_}, folds, context);
    const BasisCandidate& best =
        *std::ranges::min_element(candidates, [](const auto& a, const auto& b) {
          return a.fit->candidate.held_out_rmse <
                 b.fit->candidate.held_out_rmse;
        });
    const PenalizedCandidate& chosen = best.fit->candidate;
    const PolynomialDesign design = best.fit->DesignOf(*best.viewed);
    FittedModel fitted = MapOfCandidate(
        name(), training, *best.viewed, design, chosen, best.guarded);
    fitted.summary.message = fmt::format(
        "penalty {:.3g}{}, {:.1f} effective parameters, {} of {} terms up to "
        "degree {}",
        chosen.strength,
        folds.text.empty() ? "" : " by cross-validation over " + folds.text,
        chosen.degrees_of_freedom,
        (chosen.coefficients.array() != 0.0).count(),
        chosen.coefficients.size(),
        best.degree);
    if (choices_.view.given) {
      fitted.choices.push_back(
          {"view", std::string(ToString(best.viewed->view))});
      if (best.viewed->sine_and_cosine) {
        fitted.choices.push_back({"angles", std::string("sincos")});
      }
    }
    if (choices_.chooses_basis()) {
      fitted.choices.push_back({"terms", std::string(ToString(best.terms))});
      fitted.remarks.push_back(
          fmt::format("{} by cross-validation over {} of {} bases",
                      best.label,
                      folds.text,
                      candidates.size()));
    }
    if (penalty_ == Penalty::kLasso) {
      fitted.remarks.push_back("chosen: " + ChosenNames(design, chosen));
    }
    if (context.explain) Explain(training, design, best, folds, &fitted);
    return fitted;
  }

 private:
  static std::string ChosenNames(const PolynomialDesign& design,
                                 const PenalizedCandidate& fit) {
    const std::vector<std::string> names = design.TermNames();
    std::string chosen;
    for (Index j = 0; j < fit.coefficients.size(); ++j) {
      if (fit.coefficients[j] == 0.0) continue;
      if (!chosen.empty()) chosen += ", ";
      chosen += names[static_cast<std::size_t>(j)];
    }
    return chosen.empty() ? "none" : chosen;
  }

  void Explain(const Dataset& training,
               const PolynomialDesign& design,
               const BasisCandidate& best,
               const InnerFolds& folds,
               FittedModel* fitted) const {
    auto report = std::make_shared<RegressionReport>();
    const PenalizedCandidate& fit = best.fit->candidate;
    report->method = fmt::format(
        "{} over {} terms up to degree {}, penalty {:.6g}{} on columns of "
        "variance 1",
        fitting::ToString(penalty_),
        design.num_terms() - best.num_excluded,
        best.degree,
        fit.strength,
        folds.text.empty() ? "" : " by cross-validation over " + folds.text);
    report->penalised = true;
    report->weighted = training.weights().size() != 0;
    report->candidates = design.num_terms();
    report->cross_validation = folds.text;
    report->strength = fit.strength;
    report->degrees_of_freedom = fit.degrees_of_freedom;
    report->strengths = fit.strengths;
    report->mean_squared_errors = fit.mean_squared_errors;
    report->standard_errors = fit.standard_errors;
    // The table needs estimates only, so the fit is filled by hand.
    const Eigen::VectorXd residual =
        training.target_values() - fitted->Predict(training);
    report->fit.observations = static_cast<double>(design.rows());
    report->fit.residual_sum_of_squares =
        report->weighted ? residual.cwiseAbs2().dot(training.weights())
                         : residual.squaredNorm();
    report->fit.intercept.estimate = fit.intercept;
    report->fit.coefficients.resize(
        static_cast<std::size_t>(fit.coefficients.size()));
    for (Index j = 0; j < fit.coefficients.size(); ++j) {
      report->fit.coefficients[static_cast<std::size_t>(j)].estimate =
          fit.coefficients[j];
    }
    FillCoefficientTable(design, report.get());
    std::erase_if(report->terms, [](const ReportTerm& term) {
      return term.numbers.estimate == 0.0;
    });
    fitted->regression = std::move(report);
  }

  Penalty penalty_;
  PenalizedChoices choices_;
};

}  // namespace

std::unique_ptr<ModelRecipe> MakePenalizedRecipe(const ModelSpec& spec) {
  return std::make_unique<PenalizedRecipe>(spec);
}

}  // namespace errmap::models
