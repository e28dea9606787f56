#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "fitting/selection/stepwise_selection.h"
#include "models/history/fit_in_view.h"
#include "models/history/view_options.h"
#include "models/inner_folds.h"
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

constexpr std::int64_t kDefaultBootstrap = 200;
// Rows times terms; that many repetitions take seconds there, and beyond it the
// rows leave the caches.
constexpr Index kMostBootstrappedValues = 1'000'000;

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

// Converts the options to those of the selection.
fitting::StepwiseOptions RulesOf(const StepwiseOptions& options) {
  fitting::StepwiseOptions rules;
  rules.select = options.select.value_or(options.criterion);
  rules.stop = options.stop.value_or(options.criterion);
  rules.choose = options.choose.value_or(options.criterion);
  rules.direction = options.direction;
  rules.heredity = options.heredity;
  rules.enter = options.enter.value_or(rules.enter);
  rules.remove = options.remove.value_or(std::max(rules.remove, rules.enter));
  if (options.max_terms) rules.max_terms = *options.max_terms;
  if (options.sigma2) rules.sigma2 = *options.sigma2;
  return rules;
}

// With what is left open filled in: one criterion, or three.
StepwiseOptions Resolved(StepwiseOptions options) {
  const fitting::StepwiseOptions rules = RulesOf(options);
  options.select.reset();
  options.stop.reset();
  options.choose.reset();
  if (rules.select == rules.stop && rules.stop == rules.choose) {
    options.criterion = rules.select;
  } else {
    options.select = rules.select;
    options.stop = rules.stop;
    options.choose = rules.choose;
  }
  if (rules.Uses(Criterion::kPValue)) {
    options.enter = rules.enter;
    options.remove = rules.remove;
  }
  return options;
}

// Terms chosen one by one.
class StepwiseRecipe final : public PolynomialRecipeWith<StepwiseOptions> {
 public:
  StepwiseRecipe(const StepwiseOptions& options, std::string name)
      : PolynomialRecipeWith(options, std::move(name), options.clip),
        rules_(RulesOf(options)) {
    options_ = Resolved(options);
    rules_.Validate();
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
  // Storage of the rows for the selection, and number of its repetitions.
  struct Plan {
    bool by_triangle = false;
    bool is_large = false;  // too large to bootstrap unasked
    std::int64_t repetitions = 0;
    bool group_parts = false;  // a triangle a group
  };

  // With many rows a bootstrap runs only on request. By triangles it draws
  // whole groups, each of which is a triangle.
  Plan PlanFor(const Dataset& training,
               Index num_terms,
               const FitContext& context) const {
    Plan plan;
    plan.by_triangle = NeedsTriangle(
        training.num_rows(), num_terms, context.most_design_values);
    if (plan.by_triangle && rules_.Uses(Criterion::kPress)) {
      throw std::invalid_argument(fmt::format(
          "PRESS of every step needs the rows, and {} rows of {} terms are "
          "too many to hold; choose by aic, aicc, bic or cv (the fitted "
          "map's PRESS is reported)",
          training.num_rows(),
          num_terms));
    }
    plan.is_large = plan.by_triangle ||
                    training.num_rows() * num_terms > kMostBootstrappedValues;
    const bool unasked = !plan.is_large && context.default_bootstraps;
    if (context.explain) {
      plan.repetitions =
          options_.bootstrap.value_or(unasked ? kDefaultBootstrap : 0);
    }
    plan.group_parts =
        plan.by_triangle && plan.repetitions > 0 && training.has_groups();
    return plan;
  }

  DesignRows RowsOf(const TermDictionary& dictionary,
                    const Plan& plan,
                    const InnerFolds& folds,
                    const FitContext& context) const {
    const bool rows_are_read =
        rules_.Uses(Criterion::kPress) || plan.repetitions > 0;
    return CollectRows(
        dictionary.design,
        plan.group_parts ? dictionary.design.dataset().groups().codes
                         : folds.folds.codes,
        rows_are_read
            ? context
            : PreferTriangle(
                  dictionary.design, kMostBootstrappedValues, context));
  }

  FittedModel FitRows(const Dataset& training,
                      const FitContext& context) const {
    if (training.num_rows() < 3) {
      throw std::invalid_argument(
          fmt::format("needs at least 3 rows, found {}", training.num_rows()));
    }
    const TermDictionary dictionary(training, options_.terms);
    const Plan plan = PlanFor(training, dictionary.design.num_terms(), context);
    InnerFolds folds;
    if (rules_.Uses(Criterion::kCv)) {
      folds = MakeInnerFolds(training, context);
    }
    const DesignRows rows = RowsOf(dictionary, plan, folds, context);
    fitting::TermRules rules{dictionary.include,
                             dictionary.excluded,
                             {},
                             FoldOf(folds, rows, training, plan.group_parts)};
    if (rules_.heredity != fitting::Heredity::kNone) {
      rules.parents = dictionary.Parents();
    }
    const fitting::StepwiseOptions how = RulesFor(training, rules);
    const auto select = [&](const fitting::RegressionProblem& problem) {
      return fitting::SelectStepwise(problem, rules, how);
    };
    const fitting::SelectionResult selection = select(rows.Problem());
    RegressionRecord report;
    if (context.explain) {
      report.least_squares.value.emplace();
      Explain(dictionary, rows, selection, &report);
      Bootstrap(
          dictionary, rows, selection.chosen, plan, select, context, &report);
    }
    const UsedTerms used =
        KeepUsedInputs(dictionary.design.terms(), selection.chosen);
    FittedModel fitted = FitTerms(training,
                                  used.inputs,
                                  used.terms,
                                  context,
                                  {options_.terms.centring},
                                  &report);
    Remark(dictionary, selection, how, &fitted);
    return fitted;
  }

  // Among enough candidates there are always some that follow the noise, and
  // no criterion stops at them once few rows are left to judge by: of 100
  // columns of noise BIC took 58 for 60 rows.
  fitting::StepwiseOptions RulesFor(const Dataset& training,
                                    const fitting::TermRules& rules) const {
    fitting::StepwiseOptions how = rules_;
    if (options_.max_terms) return how;
    constexpr Index kRowsPerTerm = 5;
    how.max_terms = std::max({training.num_rows() / kRowsPerTerm,
                              std::ssize(rules.include),
                              Index{1}});
    return how;
  }

  const std::string& DirectionWord() const {
    return Directions()[static_cast<std::size_t>(rules_.direction)];
  }

  // The fold of each row that the engine sees; groups are whole in folds.
  static fitting::FoldCodes FoldOf(const InnerFolds& inner,
                                   const DesignRows& rows,
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
               const DesignRows& rows,
               const fitting::SelectionResult& selection,
               RegressionRecord* report) const {
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
    report->candidates = dictionary.design.num_terms();
    report->chosen_step = static_cast<std::int64_t>(selection.chosen_step);
    report->ended = selection.ended;
    for (const fitting::SelectionStep& step : selection.steps) {
      std::optional<std::string> term;
      if (step.candidate >= 0) term = dictionary.design.NameOf(step.candidate);
      report->steps.push_back({.term = std::move(term),
                               .entered = step.entered,
                               .terms = step.terms,
                               .f = step.f,
                               .p = step.p,
                               .rss = step.residual_sum_of_squares,
                               .aic = step.aic,
                               .aicc = step.aicc,
                               .bic = step.bic,
                               .adjusted_r2 = step.adjusted_r2,
                               .press = step.press,
                               .cp = step.cp,
                               .cv = step.cv});
    }
    report->least_squares.value->after_selection = true;
    ReportExcluded(
        dictionary, rows, selection.chosen, &*report->least_squares.value);
  }

  template <typename Select>
  void Bootstrap(const TermDictionary& dictionary,
                 const DesignRows& rows,
                 const std::vector<Index>& chosen,
                 const Plan& plan,
                 const Select& select,
                 const FitContext& context,
                 RegressionRecord* report) const {
    const Dataset& training = dictionary.design.dataset();
    if (plan.repetitions > 0 && (training.has_groups() || !plan.by_triangle)) {
      ReportInclusion(
          dictionary,
          rows,
          plan.by_triangle ? rows.parts : training.groups().codes,
          chosen,
          static_cast<int>(plan.repetitions),
          [&](const fitting::RegressionProblem& drawn) {
            return select(drawn).chosen;
          },
          context,
          report);
    } else if (plan.by_triangle || (plan.is_large && !options_.bootstrap)) {
      report->least_squares.value->notes.push_back(
          "no bootstrap at this size; bootstrap=N draws whole groups, if there "
          "are groups");
    }
  }

  // Records a fold's choice, part of its result, and why it ended.
  void Remark(const TermDictionary& dictionary,
              const fitting::SelectionResult& selection,
              const fitting::StepwiseOptions& how,
              FittedModel* fitted) const {
    fitted->summary.message =
        fmt::format("{} of {} candidate terms up to degree {} chosen by {} {}",
                    selection.chosen.size(),
                    dictionary.design.num_terms(),
                    dictionary.degree,
                    DirectionWord(),
                    Upper(ToString(rules_.choose)));
    if (selection.ended == "interrupted") {
      fitted->summary.termination = fitting::Termination::kInterrupted;
    }
    fitted->remarks.push_back(ChosenTerms(dictionary, selection.chosen));
    for (const Index term : selection.aliased_includes) {
      fitted->remarks.push_back(
          fmt::format("{} was to be included but follows from the terms "
                      "before it",
                      dictionary.design.NameOf(term)));
    }
    if (!selection.at_most_terms) return;
    fitted->remarks.push_back(fmt::format(
        "max_terms ends the selection at {} terms{}; {}",
        how.max_terms,
        !options_.max_terms
            ? fmt::format(", a fifth of {} rows",
                          dictionary.design.dataset().num_rows())
            : "",
        !options_.max_terms ? "max_terms=none continues like R's step()"
                            : "a larger one lets it continue"));
  }

  fitting::StepwiseOptions rules_;
};

std::string StepwiseContradiction(const StepwiseOptions& options) {
  const fitting::StepwiseOptions rules = RulesOf(options);
  if ((options.enter || options.remove) && rules.select != Criterion::kPValue &&
      rules.stop != Criterion::kPValue) {
    return "enter and remove are p-values; they need criterion=p, select=p or "
           "stop=p";
  }
  if (rules.remove < rules.enter) {
    return fmt::format(
        "remove ({}) is below enter ({}): a term could enter and leave for "
        "ever; give remove >= enter",
        rules.remove,
        rules.enter);
  }
  for (const auto& [key, value] :
       {std::pair("enter", rules.enter), {"remove", rules.remove}}) {
    if (!(value > 0.0 && value < 1.0)) {
      return fmt::format(
          "{} must be above 0 and below 1, found {}", key, value);
    }
  }
  if (options.sigma2 == 0.0) return "sigma2 must be above 0";
  if (options.view && !options.view->intercept) {
    return "intercept=no is for ridge and lasso";
  }
  return "";
}

OptionList<StepwiseOptions> StepwiseList() {
  using Options = StepwiseOptions;
  constexpr std::int64_t kMost = 1'000'000;
  const std::vector<std::string>& all = fitting::CriterionWords();
  const auto criteria = EnumWords<Criterion>({all.begin(), all.end() - 1});
  OptionList<Options> list = {
      OptionFor("criterion",
                "what select, stop and choose go by",
                &Options::criterion,
                criteria)
          .When([](const Options& options) { return !options.select; }),
      OptionFor("select",
                "what the next term is judged by",
                &Options::select,
                criteria),
      OptionFor("stop",
                "what ends the moves",
                &Options::stop,
                EnumWords<Criterion>(all)),
      OptionFor("choose",
                "what chooses among the models passed through",
                &Options::choose,
                criteria),
      OptionFor("direction",
                "how terms come and go",
                &Options::direction,
                EnumWords<fitting::Direction>(Directions()))
          .Always(),
      OptionFor("heredity",
                "products need their parts: one, or all",
                &Options::heredity,
                EnumWords<fitting::Heredity>(Heredities())),
      OptionFor("enter",
                "the largest p of a term that enters",
                &Options::enter,
                Number{0.0, 1.0}),
      OptionFor("remove",
                "the largest p of a term that stays",
                &Options::remove,
                Number{0.0, 1.0}),
      OptionFor("max_terms",
                "the most terms",
                &Options::max_terms,
                WordOr<std::int64_t, IntegerRange>{
                    "none", Options::kNoLimit, IntegerRange{0, kMost}})
          .Always()};
  list.back().write = [write = list.back().write](const Options& options) {
    return options.max_terms ? write(options)
                             : OptionText(std::string("rows/5"));
  };
  list.push_back(OptionFor("sigma2",
                           "variance of the error, for cp",
                           &Options::sigma2,
                           Number{0.0, std::numeric_limits<double>::max()}));
  list.push_back(OptionFor("bootstrap",
                           "repetitions that show how stable each term is",
                           &Options::bootstrap,
                           IntegerRange{0, kMost})
                     .Never());
  AddWithin(TermOptionList(), &Options::terms, &list);
  AddWithin(ViewOptionList(), &Options::view, &list);
  list.push_back(ClipOption<Options>());
  return list;
}

}  // namespace

template <>
const std::vector<ListedModel<StepwiseOptions>>& ListedModels() {
  static const std::vector<ListedModel<StepwiseOptions>> models = {
      {.name = "poly:stepwise",
       .about = "terms added and removed by a criterion",
       .defaults = {},
       .options = StepwiseList,
       .contradiction = StepwiseContradiction,
       .complete = NameTheViewOf}};
  return models;
}

void StepwiseOptions::Validate() const { ValidateOptions(*this); }

std::unique_ptr<ModelRecipe> MakeRecipe(const StepwiseOptions& options,
                                        std::string name) {
  return std::make_unique<StepwiseRecipe>(options, std::move(name));
}

template StepwiseOptions OptionsOf(std::string_view spec);
template std::string SpecOf(const StepwiseOptions& options);

}  // namespace errmap::models
