#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fitting/selection/best_subset.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/polynomial/selection_bootstrap.h"
#include "models/polynomial/selection_recipe.h"
#include "models/polynomial/term_dictionary.h"
#include "models/regression_report.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;
using fitting::Criterion;

constexpr Index kPracticalTerms = 40;
constexpr Index kMostTerms = 48;

// The best of all subsets.
class BestSubsetRecipe final : public PolynomialRecipe {
 public:
  explicit BestSubsetRecipe(const ModelSpec& spec)
      : PolynomialRecipe(spec.text) {
    SpecOptions options(spec);
    terms_ = TermOptions::Take(&options, true);
    constexpr std::size_t kBic = 2;
    static const std::vector<Criterion> criteria = {Criterion::kAic,
                                                    Criterion::kAicc,
                                                    Criterion::kBic,
                                                    Criterion::kAdjustedR2,
                                                    Criterion::kCp};
    rules_.criterion = criteria[options.TakeChoice(
        "criterion", kBic, {"aic", "aicc", "bic", "adjr2", "cp"})];
    constexpr std::int64_t kNoLimit = -1;
    rules_.max_terms =
        options.TakeInteger("max_terms", kNoLimit, 0, kMostTerms);
    rules_.sigma2 = options.TakeNumber("sigma2",
                                       std::numeric_limits<double>::quiet_NaN(),
                                       std::numeric_limits<double>::min(),
                                       std::numeric_limits<double>::max());
    constexpr std::int64_t kMostRepetitions = 1'000'000;
    bootstrap_ = static_cast<int>(
        options.TakeInteger("bootstrap", 0, 0, kMostRepetitions));
    options.RefuseOthers();
  }

  std::vector<EffectiveOption> options() const override {
    std::vector<EffectiveOption> options{
        {"criterion", std::string(ToString(rules_.criterion))}};
    if (rules_.max_terms >= 0) {
      options.push_back({"max_terms", std::int64_t{rules_.max_terms}});
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
    TermOptions terms = terms_;
    if (terms.degree == 0 && terms.set == TermSet::kFull) {
      terms.degree = DegreeFor(training.num_inputs());
    }
    const TermDictionary dictionary(training, terms);
    if (dictionary.NumOpen() > kMostTerms) {
      throw std::invalid_argument(fmt::format(
          "best subset is practical up to about {} candidate terms, and degree "
          "{} in {} inputs makes {}; use a lower degree, exclude=, fewer "
          "inputs or poly:stepwise",
          kPracticalTerms,
          dictionary.degree,
          training.num_inputs(),
          dictionary.NumOpen()));
    }
    const DictionaryRows rows = CollectDictionary(dictionary, {}, context);
    const fitting::BestSubsetResult best =
        fitting::SelectBestSubset(rows.Problem(),
                                  dictionary.include,
                                  dictionary.excluded,
                                  rules_,
                                  context.stop);
    const UsedTerms used =
        KeepUsedInputs(dictionary.design.terms(), best.chosen);
    RegressionReport report;
    if (context.explain) {
      report.method = fmt::format(
          "best of all subsets of {} terms up to degree {} by {} ({} of 2^{} "
          "branches looked at)",
          dictionary.NumOpen(),
          dictionary.degree,
          ToString(rules_.criterion),
          best.nodes,
          dictionary.NumOpen());
      report.selected = true;
      report.candidates = dictionary.design.num_terms();
      ReportExcluded(
          dictionary, rows, best.chosen, rules_.collinearity, context, &report);
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
    const std::vector<std::string> names = dictionary.design.TermNames();
    std::vector<std::string> chosen;
    for (const Index term : best.chosen) {
      chosen.push_back(names[static_cast<std::size_t>(term)]);
    }
    fitted.remarks.push_back(
        chosen.empty() ? "no term was chosen"
                       : fmt::format("chosen: {}", fmt::join(chosen, ", ")));
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
                 const DictionaryRows& rows,
                 const fitting::BestSubsetResult& best,
                 const FitContext& context,
                 RegressionReport* report) const {
    if (bootstrap_ == 0 || !rows.are_observations()) return;
    const Dataset& training = dictionary.design.dataset();
    report->bootstrap = bootstrap_;
    report->bootstrap_unit =
        training.has_groups() ? training.groups().column : "row";
    ReportInclusion(dictionary,
                    best.chosen,
                    BootstrapInclusion(
                        rows,
                        training.groups().codes,
                        bootstrap_,
                        [&](const fitting::SelectionProblem& drawn) {
                          return fitting::SelectBestSubset(drawn,
                                                           dictionary.include,
                                                           dictionary.excluded,
                                                           rules_,
                                                           context.stop)
                              .chosen;
                        },
                        context),
                    report);
  }

  TermOptions terms_;
  fitting::BestSubsetOptions rules_;
  int bootstrap_ = 0;
};

}  // namespace

std::unique_ptr<ModelRecipe> MakeBestSubsetRecipe(const ModelSpec& spec) {
  return std::make_unique<BestSubsetRecipe>(spec);
}

}  // namespace errmap::models
