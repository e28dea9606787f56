#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "models/history/fit_in_view.h"
#include "models/history/view_options.h"
#include "models/inner_folds.h"
#include "models/option_list.h"
#include "models/polynomial/penalized_fit.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/polynomial/polynomial_options.h"
#include "models/regression_record.h"

namespace errmap::models {
namespace {

using data::Dataset;
using fitting::Penalty;

// Over rows as they were measured there is only to choose how far to shrink,
// and runs would ask for more extrapolation than the fold outside does; a
// memory must not know a group from its neighbours.
GroupDeal DealFor(const BasisOptions& basis) {
  return !basis.view || basis.view->view == View::kRaw ? GroupDeal::kInTurn
                                                       : GroupDeal::kRuns;
}

// All terms of a basis, their coefficients shrunk.
class PenalizedRecipe final : public PolynomialRecipeWith<PenalizedOptions> {
 public:
  PenalizedRecipe(const PenalizedOptions& options, std::string name)
      : PolynomialRecipeWith(options, std::move(name), options.basis.clip) {}

  std::optional<std::string> WhatIsMissing(
      const Dataset& dataset) const override {
    if (dataset.num_inputs() > 0) return std::nullopt;
    return "inputs: there is nothing to penalise";
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    if (training.num_rows() < 3) {
      throw std::invalid_argument(
          fmt::format("needs at least 3 rows, found {}", training.num_rows()));
    }
    const InnerFolds folds =
        MakeInnerFolds(training, context, DealFor(options_.basis));
    // The folds that choose the penalty; none if it is given.
    const std::string over = options_.penalty.strength ? "" : folds.text;
    const std::vector<BasisCandidate> candidates = JudgeBases(training,
                                                              options_.basis,
                                                              options_.penalty,
                                                              {options_.family},
                                                              folds,
                                                              context);
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
        over.empty() ? "" : " by cross-validation over " + over,
        chosen.degrees_of_freedom,
        (chosen.coefficients.array() != 0.0).count(),
        chosen.coefficients.size(),
        best.degree);
    if (options_.basis.view) NoteView(*best.viewed, &fitted);
    if (options_.basis.chooses_basis()) {
      fitted.choices.push_back({"terms", std::string(ToString(best.terms))});
      fitted.remarks.push_back(
          fmt::format("{}: chosen by cross-validation over {} from {} bases",
                      best.label,
                      over,
                      candidates.size()));
    }
    if (options_.family == Penalty::kLasso) {
      fitted.remarks.push_back("chosen: " + ChosenNames(design, chosen));
    }
    if (context.explain) Explain(design, best, over, &fitted);
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

  void Explain(const PolynomialDesign& design,
               const BasisCandidate& best,
               const std::string& over,
               FittedModel* fitted) const {
    auto report = std::make_shared<RegressionRecord>();
    const PenalizedCandidate& fit = best.fit->candidate;
    report->method = fmt::format(
        "{} over {} terms up to degree {}, penalty {:.6g}{} on columns of "
        "variance 1",
        fitting::ToString(options_.family),
        design.num_terms() - best.num_excluded,
        best.degree,
        fit.strength,
        over.empty() ? "" : " by cross-validation over " + over);
    report->candidates = design.num_terms();
    report->penalised.value = PenaltyRecord{
        .penalty = fit.strength,
        .effective_parameters = fit.degrees_of_freedom,
        .cross_validation = {.holdout = over,
                             .penalty = fit.strengths,
                             .mse = fit.mean_squared_errors,
                             .standard_error = fit.standard_errors}};
    // The table needs estimates only.
    fitting::RegressionDiagnostics estimates;
    estimates.intercept.estimate = fit.intercept;
    for (const double estimate : fit.coefficients) {
      estimates.coefficients.push_back({.estimate = estimate});
    }
    FillCoefficientTable(design, estimates, report.get());
    std::erase_if(report->coefficients, [](const CoefficientRecord& line) {
      return line.of_term.value && line.estimate == 0.0;
    });
    fitted->regression = std::move(report);
  }
};

std::string PenalizedContradiction(const PenalizedOptions& options) {
  if (!options.penalty.strength) return "";
  if (options.penalty.one_standard_error) {
    return "rule= chooses the penalty, which penalty= fixes";
  }
  if (options.basis.chooses_basis()) {
    return "penalty= needs one basis; name view= and terms= too";
  }
  return "";
}

OptionList<PenalizedOptions> PenalizedList() {
  using Options = PenalizedOptions;
  OptionList<Options> list = {
      OptionFor<Options>(
          "penalty",
          "its strength; without it by inner hold-outs",
          [](auto& options) { return &options.penalty.strength; },
          Number{0.0, std::numeric_limits<double>::max()}),
      OptionFor<Options>(
          "rule",
          "the penalty of lowest error, or the strongest near it",
          [](auto& options) { return &options.penalty.one_standard_error; },
          OneOf<bool>{{{"min", false}, {"1se", true}}})
          .When([](const Options& options) {
            return !options.penalty.strength;
          })};
  AddWithin(BasisOptionList(), &Options::basis, &list);
  return list;
}

}  // namespace

template <>
const std::vector<ListedModel<PenalizedOptions>>& ListedModels() {
  static const std::vector<ListedModel<PenalizedOptions>> models = {
      {.name = "poly:ridge",
       .about = "all terms, large coefficients penalised",
       .defaults = {},
       .options = PenalizedList,
       .contradiction = PenalizedContradiction,
       .complete = NameTheViewOf},
      {.name = "poly:lasso",
       .about = "few terms, by a penalty that drops them",
       .defaults = {.family = Penalty::kLasso},
       .options = PenalizedList,
       .contradiction = PenalizedContradiction,
       .complete = NameTheViewOf}};
  return models;
}

std::string_view PenalizedOptions::type() const {
  return family == Penalty::kRidge ? "poly:ridge" : "poly:lasso";
}

void PenalizedOptions::Validate() const { ValidateOptions(*this); }

std::unique_ptr<ModelRecipe> MakeRecipe(const PenalizedOptions& options,
                                        std::string name) {
  return std::make_unique<PenalizedRecipe>(options, std::move(name));
}

template PenalizedOptions OptionsOf(std::string_view spec);
template std::string SpecOf(const PenalizedOptions& options);

}  // namespace errmap::models
