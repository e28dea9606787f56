#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "fitting/selection/best_subset.h"
#include "models/history/view_options.h"
#include "models/option_list.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/polynomial/polynomial_options.h"
#include "models/polynomial/selection_bootstrap.h"
#include "models/polynomial/term_dictionary.h"
#include "models/regression_record.h"

namespace errmap::models {
namespace {

using data::Dataset;
using fitting::Criterion;

constexpr Index kPracticalTerms = 40;
constexpr Index kMostSubsetTerms = 48;

// The best of all subsets.
class BestSubsetRecipe final : public PolynomialRecipeWith<BestSubsetOptions> {
 public:
  BestSubsetRecipe(const BestSubsetOptions& options, std::string name)
      : PolynomialRecipeWith(options, std::move(name), options.clip),
        terms_(options.terms) {
    rules_.criterion = options.criterion;
    if (options.max_terms) rules_.max_terms = *options.max_terms;
    if (options.sigma2) rules_.sigma2 = *options.sigma2;
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    if (training.num_rows() < 3) {
      throw std::invalid_argument(
          fmt::format("needs at least 3 rows, found {}", training.num_rows()));
    }
    TermOptions terms = terms_;
    if (!terms.degree && terms.set == TermSet::kFull) {
      terms.degree = DegreeFor(training.num_inputs());
    }
    const TermDictionary dictionary(training, terms);
    if (dictionary.NumOpen() > kMostSubsetTerms) {
      throw std::invalid_argument(fmt::format(
          "best subset is practical up to about {} candidate terms, and degree "
          "{} in {} inputs makes {}; use a lower degree, exclude=, fewer "
          "inputs or poly:stepwise",
          kPracticalTerms,
          dictionary.degree,
          training.num_inputs(),
          dictionary.NumOpen()));
    }
    const DesignRows rows = CollectRows(dictionary.design, {}, context);
    const fitting::BestSubsetResult best = fitting::SelectBestSubset(
        rows.Problem(), dictionary.include, dictionary.excluded, rules_);
    const UsedTerms used =
        KeepUsedInputs(dictionary.design.terms(), best.chosen);
    RegressionRecord report;
    if (context.explain) {
      report.method = fmt::format(
          "best of all subsets of {} terms up to degree {} by {} ({} of 2^{} "
          "branches examined)",
          dictionary.NumOpen(),
          dictionary.degree,
          ToString(rules_.criterion),
          best.nodes,
          dictionary.NumOpen());
      report.candidates = dictionary.design.num_terms();
      LeastSquaresRecord& fit = report.least_squares.value.emplace();
      fit.after_selection = true;
      ReportExcluded(dictionary, rows, best.chosen, &fit);
      Bootstrap(dictionary, rows, best, context, &report);
    }
    FittedModel fitted = FitTerms(
        training, used.inputs, used.terms, context, {terms_.centring}, &report);
    fitted.summary.message = fmt::format(
        "{} of {} candidate terms up to degree {} are the best subset by {}",
        used.terms.size(),
        dictionary.design.num_terms(),
        dictionary.degree,
        ToString(rules_.criterion));
    if (!best.complete) {
      fitted.summary.termination = fitting::Termination::kInterrupted;
    }
    fitted.remarks.push_back(ChosenTerms(dictionary, best.chosen));
    return fitted;
  }

 private:
  // The highest degree up to 3 with a practical number of terms.
  static int DegreeFor(Index num_inputs) {
    int degree = 1;
    while (degree < 3 &&
           *CountTerms(num_inputs, degree + 1) <= kPracticalTerms) {
      ++degree;
    }
    return degree;
  }

  void Bootstrap(const TermDictionary& dictionary,
                 const DesignRows& rows,
                 const fitting::BestSubsetResult& best,
                 const FitContext& context,
                 RegressionRecord* report) const {
    const auto repetitions = static_cast<int>(options_.bootstrap);
    if (repetitions == 0 || !rows.are_observations()) return;
    ReportInclusion(
        dictionary,
        rows,
        dictionary.design.dataset().groups().codes,
        best.chosen,
        repetitions,
        [&](const fitting::RegressionProblem& drawn) {
          return fitting::SelectBestSubset(
                     drawn, dictionary.include, dictionary.excluded, rules_)
              .chosen;
        },
        context,
        report);
  }

  TermOptions terms_;
  fitting::BestSubsetOptions rules_;
};

OptionList<BestSubsetOptions> BestSubsetList() {
  using Options = BestSubsetOptions;
  constexpr std::int64_t kMostRepetitions = 1'000'000;
  OptionList<Options> list = {
      OptionFor("criterion",
                "what the best subset is judged by",
                &Options::criterion,
                OneOf<Criterion>{{{"aic", Criterion::kAic},
                                  {"aicc", Criterion::kAicc},
                                  {"bic", Criterion::kBic},
                                  {"adjr2", Criterion::kAdjustedR2},
                                  {"cp", Criterion::kCp}}})
          .Always(),
      OptionFor("max_terms",
                "the most terms",
                &Options::max_terms,
                IntegerRange{0, kMostSubsetTerms}),
      OptionFor("sigma2",
                "variance of the error, for cp",
                &Options::sigma2,
                Number{std::numeric_limits<double>::min(),
                       std::numeric_limits<double>::max()})
          .Never(),
      OptionFor("bootstrap",
                "repetitions that show how stable each term is",
                &Options::bootstrap,
                IntegerRange{0, kMostRepetitions})
          .Never()};
  AddWithin(TermOptionList(), &Options::terms, &list);
  list.push_back(ClipOption<Options>());
  return list;
}

}  // namespace

template <>
const std::vector<ListedModel<BestSubsetOptions>>& ListedModels() {
  static const std::vector<ListedModel<BestSubsetOptions>> models = {
      {.name = "poly:best",
       .about = "the best subset of the terms",
       .defaults = {},
       .options = BestSubsetList,
       .is_compared = false}};
  return models;
}

void BestSubsetOptions::Validate() const { ValidateOptions(*this); }

std::unique_ptr<ModelRecipe> MakeRecipe(const BestSubsetOptions& options,
                                        std::string name) {
  return std::make_unique<BestSubsetRecipe>(options, std::move(name));
}

template BestSubsetOptions OptionsOf(std::string_view spec);
template std::string SpecOf(const BestSubsetOptions& options);

}  // namespace errmap::models
