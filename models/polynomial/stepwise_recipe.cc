#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fitting/selection/stepwise_selection.h"
#include "models/history/fit_in_view.h"
#include "models/inner_folds.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/polynomial/selection_bootstrap.h"
#include "models/polynomial/selection_recipe.h"
#include "models/polynomial/term_dictionary.h"
#include "models/regression_report.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;
using Eigen::VectorXd;
using fitting::Criterion;
using fitting::StepwiseOptions;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kDefaultBootstrap = 200;
constexpr std::int64_t kByDefault = -1;

std::string Upper(std::string_view word) {
  std::string upper(word);
  for (char& c : upper) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return upper == "ADJR2" ? "adjusted R2" : upper;
}

const std::vector<std::string>& Directions() {
  static const std::vector<std::string> words = {"forward", "backward", "both"};
  return words;
}

const std::vector<std::string>& Heredities() {
  static const std::vector<std::string> words = {"none", "weak", "strong"};
  return words;
}

// Terms chosen one by one.
class StepwiseRecipe final : public PolynomialRecipe {
 public:
  explicit StepwiseRecipe(const ModelSpec& spec) : PolynomialRecipe(spec.text) {
    const auto refuse = [&](const std::string& why) {
      throw std::invalid_argument(
          fmt::format("model '{}': {}", spec.text, why));
    };
    SpecOptions options(spec);
    try {
      terms_ = TermOptions::Take(&options, true);
    } catch (const std::invalid_argument& error) {
      if (std::string_view(error.what()).starts_with("model ")) throw;
      refuse(error.what());
    }
    const std::vector<std::string>& all = fitting::CriterionWords();
    const std::vector<std::string> criteria(all.begin(), all.end() - 1);
    constexpr auto kDefault = static_cast<std::size_t>(Criterion::kBic);
    const std::size_t criterion =
        options.TakeChoice("criterion", kDefault, criteria);
    const auto take = [&](const char* key,
                          const std::vector<std::string>& words) {
      return static_cast<Criterion>(options.TakeChoice(key, criterion, words));
    };
    rules_.select = take("select", criteria);
    rules_.stop = take("stop", all);
    rules_.choose = take("choose", criteria);
    rules_.direction = static_cast<fitting::Direction>(
        options.TakeChoice("direction", 0, Directions()));
    rules_.heredity = static_cast<fitting::Heredity>(
        options.TakeChoice("heredity", 0, Heredities()));
    constexpr double kNotGiven = -1.0;
    const double enter = options.TakeNumber("enter", kNotGiven, 0.0, 1.0);
    const double remove = options.TakeNumber("remove", kNotGiven, 0.0, 1.0);
    if (enter >= 0.0) rules_.enter = enter;
    rules_.remove =
        remove >= 0.0 ? remove : std::max(rules_.remove, rules_.enter);
    if ((enter >= 0.0 || remove >= 0.0) &&
        rules_.select != Criterion::kPValue &&
        rules_.stop != Criterion::kPValue) {
      refuse(
          "enter and remove are p-values; they need criterion=p, select=p "
          "or stop=p");
    }
    if (rules_.remove < rules_.enter) {
      refuse(fmt::format(
          "remove ({}) is below enter ({}): a term could enter and leave for "
          "ever; give remove >= enter",
          rules_.remove,
          rules_.enter));
    }
    for (const auto& [key, value] :
         {std::pair("enter", rules_.enter), {"remove", rules_.remove}}) {
      if (!(value > 0.0 && value < 1.0)) {
        refuse(fmt::format(
            "{} must be above 0 and below 1, found {}", key, value));
      }
    }
    constexpr std::int64_t kMostTerms = 1'000'000;
    if (options.IsWord("max_terms", "none")) {
      share_of_rows_ = false;
    } else {
      rules_.max_terms =
          options.TakeInteger("max_terms", kByDefault, 0, kMostTerms);
      share_of_rows_ = rules_.max_terms == kByDefault;
    }
    rules_.sigma2 = options.TakeNumber(
        "sigma2", kNan, 0.0, std::numeric_limits<double>::max());
    if (rules_.sigma2 == 0.0) refuse("sigma2 must be above 0");
    constexpr std::int64_t kMostRepetitions = 1'000'000;
    bootstrap_ =
        options.TakeInteger("bootstrap", kByDefault, 0, kMostRepetitions);
    view_ = ViewOptions::Take(&options);
    guarded_ = view_.TakeClip(&options);
    if (view_.never_intercept) refuse("intercept=no is for ridge and lasso");
    options.RefuseOthers();
    rules_.Validate();
  }

  std::vector<EffectiveOption> options() const override {
    std::vector<EffectiveOption> options;
    const auto add = [&](const char* key, std::string_view value) {
      options.push_back({key, std::string(value)});
    };
    if (rules_.select == rules_.stop && rules_.stop == rules_.choose) {
      add("criterion", ToString(rules_.select));
    } else {
      add("select", ToString(rules_.select));
      add("stop", ToString(rules_.stop));
      add("choose", ToString(rules_.choose));
    }
    add("direction", DirectionWord());
    if (rules_.heredity != fitting::Heredity::kNone) {
      add("heredity", Heredities()[static_cast<std::size_t>(rules_.heredity)]);
    }
    if (rules_.Uses(Criterion::kPValue)) {
      options.push_back({"enter", rules_.enter});
      options.push_back({"remove", rules_.remove});
    }
    if (rules_.max_terms >= 0) {
      options.push_back({"max_terms", std::int64_t{rules_.max_terms}});
    } else {
      add("max_terms", share_of_rows_ ? "rows/5" : "none");
    }
    if (!std::isnan(rules_.sigma2)) {
      options.push_back({"sigma2", rules_.sigma2});
    }
    terms_.Describe(&options);
    view_.Describe(&options);
    if (view_.given && !guarded_) add("clip", "none");
    return options;
  }

  std::optional<Index> NumCoefficients(const Dataset&) const override {
    return std::nullopt;
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    if (!view_.given) return FitRows(training, context);
    return FitInView(training,
                     view_,
                     guarded_,
                     context,
                     [&](const Dataset& rows, const FitContext& inner) {
                       return FitRows(rows, inner);
                     });
  }

 private:
  FittedModel FitRows(const Dataset& training,
                      const FitContext& context) const {
    if (training.num_rows() < 3) {
      throw std::invalid_argument(
          fmt::format("needs at least 3 rows, found {}", training.num_rows()));
    }
    const TermDictionary dictionary(training, terms_);
    const bool by_triangle = NeedsTriangle(training.num_rows(),
                                           dictionary.design.num_terms(),
                                           context.most_design_values);
    if (by_triangle && rules_.Uses(Criterion::kPress)) {
      throw std::invalid_argument(fmt::format(
          "PRESS of every step needs the rows, and {} rows of {} terms are "
          "too many to hold; choose by aic, aicc, bic or cv (the fitted "
          "map's PRESS is reported)",
          training.num_rows(),
          dictionary.design.num_terms()));
    }
    InnerFolds folds;
    if (rules_.Uses(Criterion::kCv)) {
      folds = MakeInnerFolds(training, context);
    }
    // At many rows a bootstrap is made only where it is asked for, and then
    // over whole groups, each of which is a triangle.
    const std::int64_t repetitions =
        !context.explain                             ? 0
        : bootstrap_ >= 0                            ? bootstrap_
        : by_triangle || !context.default_bootstraps ? 0
                                                     : kDefaultBootstrap;
    const bool group_parts =
        by_triangle && repetitions > 0 && training.has_groups();
    const DictionaryRows rows = CollectDictionary(
        dictionary,
        group_parts ? training.groups().codes : folds.folds.codes,
        context);
    fitting::TermRules rules{dictionary.include,
                             dictionary.excluded,
                             {},
                             FoldOf(folds, rows, training, group_parts)};
    if (rules_.heredity != fitting::Heredity::kNone) {
      rules.parents = dictionary.Parents();
    }
    const fitting::SelectionProblem problem = rows.Problem();
    const StepwiseOptions how = RulesFor(training, rules);
    const fitting::SelectionResult selection =
        fitting::SelectStepwise(problem, rules, how, context.stop);

    const UsedTerms used =
        KeepUsedInputs(dictionary.design.terms(), selection.chosen);
    RegressionReport report;
    if (context.explain) {
      Explain(dictionary, rows, selection, folds, context, &report);
      const bool by_group = training.has_groups();
      if (repetitions > 0 && (by_group || !by_triangle)) {
        report.bootstrap = static_cast<int>(repetitions);
        report.bootstrap_unit = by_group ? training.groups().column : "row";
        const VectorXd shares = BootstrapInclusion(
            rows,
            by_triangle ? rows.parts : training.groups().codes,
            report.bootstrap,
            [&](const fitting::SelectionProblem& drawn) {
              return fitting::SelectStepwise(drawn, rules, how, context.stop)
                  .chosen;
            },
            context);
        ReportInclusion(dictionary, selection.chosen, shares, &report);
      } else if (by_triangle) {
        report.notes.push_back(
            "no bootstrap at this size; bootstrap=N draws whole groups, where "
            "there are groups");
      }
    }
    FittedModel fitted = FitTerms(
        training, used.inputs, used.terms, context, {terms_.centring}, &report);
    fitted.summary.message =
        fmt::format("{} of {} candidate terms up to degree {} chosen by {} {}",
                    used.terms.size(),
                    dictionary.design.num_terms(),
                    dictionary.degree,
                    DirectionWord(),
                    Upper(ToString(rules_.choose)));
    if (selection.ended == "interrupted") {
      fitted.summary.termination = fitting::Termination::kInterrupted;
    }
    AddTermRemark(dictionary, selection, &fitted);
    if (selection.at_most_terms) {
      fitted.remarks.push_back(fmt::format(
          "max_terms ends the selection at {} terms{}; {}",
          how.max_terms,
          share_of_rows_
              ? fmt::format(", a fifth of {} rows", training.num_rows())
              : "",
          share_of_rows_ ? "max_terms=none goes on as R's step() does"
                         : "a larger one would let it go on"));
    }
    return fitted;
  }

  // Among enough candidates there are always some that follow the noise, and
  // no criterion stops at them once few rows are left to judge by: of 100
  // columns of noise BIC took 58 for 60 rows.
  StepwiseOptions RulesFor(const Dataset& training,
                           const fitting::TermRules& rules) const {
    StepwiseOptions how = rules_;
    if (!share_of_rows_) return how;
    constexpr Index kRowsPerTerm = 5;
    how.max_terms = std::max({training.num_rows() / kRowsPerTerm,
                              static_cast<Index>(rules.include.size()),
                              Index{1}});
    return how;
  }

  const std::string& DirectionWord() const {
    return Directions()[static_cast<std::size_t>(rules_.direction)];
  }

  // The fold of each row that the engine sees; groups are whole in folds.
  static fitting::FoldCodes FoldOf(const InnerFolds& inner,
                                   const DictionaryRows& rows,
                                   const Dataset& training,
                                   bool group_parts) {
    const fitting::FoldCodes& folds = inner.folds;
    if (folds.codes.empty()) return {};
    if (!group_parts) return {rows.parts, folds.forward};
    std::vector<Index> fold_of_group(training.groups().labels.size(), 0);
    for (std::size_t i = 0; i < folds.codes.size(); ++i) {
      fold_of_group[static_cast<std::size_t>(training.groups().codes[i])] =
          folds.codes[i];
    }
    fitting::FoldCodes of_parts{{}, folds.forward};
    for (const Index part : rows.parts) {
      of_parts.codes.push_back(fold_of_group[static_cast<std::size_t>(part)]);
    }
    return of_parts;
  }

  void Explain(const TermDictionary& dictionary,
               const DictionaryRows& rows,
               const fitting::SelectionResult& selection,
               const InnerFolds& folds,
               const FitContext& context,
               RegressionReport* report) const {
    report->method = fmt::format(
        "{} selection over {} terms up to degree {}: select {}, stop {}, "
        "choose {}{}",
        DirectionWord(),
        dictionary.design.num_terms(),
        dictionary.degree,
        ToString(rules_.select),
        ToString(rules_.stop),
        ToString(rules_.choose),
        rules_.heredity == fitting::Heredity::kNone
            ? ""
            : fmt::format(
                  ", {} heredity",
                  Heredities()[static_cast<std::size_t>(rules_.heredity)]));
    report->selected = true;
    report->candidates = dictionary.design.num_terms();
    report->chosen_step = selection.chosen_step;
    report->ended = selection.ended;
    report->cross_validation = folds.text;
    for (const fitting::SelectionStep& step : selection.steps) {
      report->steps.push_back(
          {step.candidate < 0 ? "" : dictionary.design.NameOf(step.candidate),
           step});
    }
    ReportExcluded(dictionary,
                   rows,
                   selection.chosen,
                   rules_.collinearity,
                   context,
                   report);
  }

  // What a fold chose is part of its result.
  static void AddTermRemark(const TermDictionary& dictionary,
                            const fitting::SelectionResult& selection,
                            FittedModel* fitted) {
    std::vector<std::string> chosen;
    for (const Index term : selection.chosen) {
      chosen.push_back(dictionary.design.NameOf(term));
    }
    fitted->remarks.push_back(
        chosen.empty() ? "no term was chosen"
                       : fmt::format("chosen: {}", fmt::join(chosen, ", ")));
    for (const Index term : selection.aliased_includes) {
      fitted->remarks.push_back(
          fmt::format("{} was to be included but follows from the terms "
                      "before it",
                      dictionary.design.NameOf(term)));
    }
  }

  TermOptions terms_;
  StepwiseOptions rules_;
  bool share_of_rows_ = true;  // max_terms is a fifth of the rows
  std::int64_t bootstrap_ = kByDefault;
  ViewOptions view_;
  bool guarded_ = false;
};

}  // namespace

std::unique_ptr<ModelRecipe> MakeStepwiseRecipe(const ModelSpec& spec) {
  return std::make_unique<StepwiseRecipe>(spec);
}

}  // namespace errmap::models
