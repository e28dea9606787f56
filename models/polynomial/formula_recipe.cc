#include <stdexcept>

#include <fmt/format.h>

#include "models/history/fit_in_view.h"
#include "models/polynomial/formula.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/polynomial/selection_recipe.h"
#include "models/regression_report.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;

// The terms that are written down. They are products of the inputs as they
// are, moved only where that leaves the set of maps the same.
class FormulaRecipe final : public PolynomialRecipe {
 public:
  explicit FormulaRecipe(const ModelSpec& spec) : PolynomialRecipe(spec.text) {
    SpecOptions options(spec);
    formula_ = options.TakeText("formula", "");
    try {
      terms_ = ParseTerms(formula_, "formula");
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(
          fmt::format("model '{}': {}", spec.text, error.what()));
    }
    form_.centring = options.TakeChoice("centred", 0, {"harmless", "no"}) == 0
                         ? Centring::kHarmless
                         : Centring::kNone;
    // Moving an input needs the intercept to take up what it leaves.
    form_.intercept = options.TakeChoice("intercept", 0, {"yes", "no"}) == 0;
    if (!form_.intercept) form_.centring = Centring::kNone;
    view_ = ViewOptions::Take(&options);
    options.RefuseOthers();
    if (view_.given && !view_.view) {
      throw std::invalid_argument(
          fmt::format("model '{}': a formula is written for one view; name it, "
                      "such as view=history:history=600",
                      spec.text));
    }
  }

  std::vector<EffectiveOption> options() const override {
    std::vector<EffectiveOption> options = {{"formula", formula_}};
    if (!form_.intercept) options.push_back({"intercept", std::string("no")});
    view_.Describe(&options);
    return options;
  }

  std::optional<std::string> WhatIsMissing(
      const Dataset& dataset) const override {
    for (const NamedTerm& term : terms_) {
      for (const NamedTerm::Factor& factor : term.factors) {
        // A derived input is known when its view is made.
        const bool derived = view_.given && factor.input.ends_with(')');
        if (!derived && dataset.FindInput(factor.input) < 0) {
          return "an input '" + factor.input + "'";
        }
      }
    }
    return std::nullopt;
  }

  std::optional<Index> NumCoefficients(const Dataset&) const override {
    return static_cast<Index>(terms_.size()) + (form_.intercept ? 1 : 0);
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    if (!view_.given) return FitRows(training, context);
    return FitInView(training,
                     view_,
                     false,
                     context,
                     [&](const Dataset& rows, const FitContext& inner) {
                       return FitRows(rows, inner);
                     });
  }

 private:
  FittedModel FitRows(const Dataset& training,
                      const FitContext& context) const {
    std::vector<std::string> names;
    for (const data::ColumnInfo& input : training.inputs()) {
      names.push_back(input.name);
    }
    const std::vector<TermPowers> terms =
        ResolveTerms(terms_, names, "formula");
    std::vector<Index> all;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      all.push_back(static_cast<Index>(i));
    }
    const UsedTerms used = KeepUsedInputs(terms, all);
    return FitTerms(training, used.inputs, used.terms, context, form_);
  }

  std::string formula_;
  std::vector<NamedTerm> terms_;
  FormOptions form_;
  ViewOptions view_;
};

}  // namespace

std::unique_ptr<ModelRecipe> MakeFormulaRecipe(const ModelSpec& spec) {
  return std::make_unique<FormulaRecipe>(spec);
}

std::unique_ptr<ModelRecipe> MakeSelectionRecipe(const ModelSpec& spec) {
  if (spec.type == "poly:stepwise") return MakeStepwiseRecipe(spec);
  if (spec.type == "poly:best") return MakeBestSubsetRecipe(spec);
  if (spec.type == "poly:ridge" || spec.type == "poly:lasso") {
    return MakePenalizedRecipe(spec);
  }
  const bool has_formula =
      !spec.options.empty() && spec.options.front().first == "formula";
  if (spec.type == "poly" && has_formula) return MakeFormulaRecipe(spec);
  return nullptr;
}

}  // namespace errmap::models
