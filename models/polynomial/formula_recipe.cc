#include <stdexcept>
#include <utility>

#include "models/history/fit_in_view.h"
#include "models/history/view_options.h"
#include "models/option_list.h"
#include "models/polynomial/formula.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/polynomial/polynomial_options.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

using data::Dataset;
// The terms as written: products of the inputs as they are, centred only if
// that leaves the set of maps the same.
class FormulaRecipe final : public PolynomialRecipeWith<FormulaOptions> {
 public:
  FormulaRecipe(const FormulaOptions& options, std::string name)
      : PolynomialRecipeWith(options, std::move(name), options.clip),
        terms_(ParseTerms(options.formula, "formula")),
        form_{.centring = options.centring, .intercept = options.intercept} {
    // Moving an input needs the intercept to take up what it leaves.
    if (!form_.intercept) form_.centring = Centring::kNone;
    if (!form_.intercept && !options_.view) {
      options_.view = ViewOptions{.view = View::kRaw};
    }
  }

  std::optional<std::string> WhatIsMissing(
      const Dataset& dataset) const override {
    for (const NamedTerm& term : terms_) {
      for (const NamedTerm::Factor& factor : term.factors) {
        // A derived input is known when its view is made.
        const bool derived = options_.view && factor.input.ends_with(')');
        if (!derived && dataset.FindInput(factor.input) < 0) {
          return "an input '" + factor.input + "'";
        }
      }
    }
    return std::nullopt;
  }

  std::optional<Index> NumCoefficients(const Dataset&) const override {
    return std::ssize(terms_) + (form_.intercept ? 1 : 0);
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    return FitInView(training,
                     options_.view,
                     context,
                     [&](const Dataset& rows, const FitContext& inner) {
                       return FitRows(rows, inner);
                     });
  }

 private:
  FittedModel FitRows(const Dataset& training,
                      const FitContext& context) const {
    const std::vector<std::string> names = training.InputNames();
    const std::vector<TermPowers> terms =
        ResolveTerms(terms_, names, "formula");
    const UsedTerms used =
        KeepUsedInputs(terms, stats::AllIndices(std::ssize(terms)));
    return FitTerms(training, used.inputs, used.terms, context, form_);
  }

  std::vector<NamedTerm> terms_;
  FormOptions form_;
};

std::string FormulaContradiction(const FormulaOptions& options) {
  try {
    ParseTerms(options.formula, "formula");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  if (options.view && !options.view->view) {
    return "a formula is written for one view; name it, such as "
           "view=history:history=600";
  }
  return "";
}

OptionList<FormulaOptions> FormulaList() {
  OptionList<FormulaOptions> list = {
      OptionFor("formula",
                "its terms, such as x+x^2+x*t",
                &FormulaOptions::formula,
                Words()),
      OptionFor("centred",
                "inputs moved where that leaves the maps the same",
                &FormulaOptions::centring,
                OneOf<Centring>{{{"harmless", Centring::kHarmless},
                                 {"no", Centring::kNone}}})
          .Never(),
      OptionFor("intercept",
                "a constant besides the terms",
                &FormulaOptions::intercept,
                OneOf<bool>{{{"yes", true}, {"no", false}}})};
  AddWithin(ViewOptionList(), &FormulaOptions::view, &list);
  std::erase_if(list, [seen = false](const auto& option) mutable {
    return option.name == "intercept" && std::exchange(seen, true);
  });
  list.push_back(ClipOption<FormulaOptions>());
  return list;
}

}  // namespace

template <>
const std::vector<ListedModel<FormulaOptions>>& ListedModels() {
  static const std::vector<ListedModel<FormulaOptions>> models = {
      {.name = "poly",
       .about = "the terms as written",
       .defaults = {},
       .options = FormulaList,
       .contradiction = FormulaContradiction,
       .complete = [](ModelSpec* spec) { NameTheView(spec, false); },
       .is_compared = false}};
  return models;
}

void FormulaOptions::Validate() const { ValidateOptions(*this); }

std::unique_ptr<ModelRecipe> MakeRecipe(const FormulaOptions& options,
                                        std::string name) {
  return std::make_unique<FormulaRecipe>(options, std::move(name));
}

template FormulaOptions OptionsOf(std::string_view spec);
template std::string SpecOf(const FormulaOptions& options);

}  // namespace errmap::models
