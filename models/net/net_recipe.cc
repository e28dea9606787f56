#include "models/net/net_recipe.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "models/averaged_model.h"
#include "models/history/view.h"
#include "models/history/with_history.h"
#include "models/net/feedforward_net.h"
#include "models/net/net_effective_parameters.h"
#include "models/net/net_fit.h"
#include "models/net/net_trainer.h"
#include "models/net/net_tuning.h"
#include "models/net/net_wfactor.h"
#include "models/net/training_sample.h"
#include "models/shared_work.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;

// Budgets and stops under the report's names.
fitting::StoppingRules TakeStoppingRules(fitting::StoppingRules rules,
                                         SpecOptions* options) {
  constexpr std::int64_t kMostSteps = 1'000'000'000;
  constexpr double kMost = 1e12;
  constexpr double kLeastSeconds = 1e-3;
  rules.iterations =
      options->TakeInteger("iterations", rules.iterations, 1, kMostSteps);
  rules.evaluations =
      options->TakeInteger("evaluations",
                           rules.evaluations,
                           1,
                           std::numeric_limits<std::int64_t>::max());
  rules.seconds =
      options->TakeNumber("seconds", rules.seconds, kLeastSeconds, kMost);
  rules.cost_goal = options->TakeNumber("egoal", rules.cost_goal, 0.0, kMost);
  rules.gradient_goal =
      options->TakeNumber("gwgoal", rules.gradient_goal, 0.0, kMost);
  rules.slow_ratio =
      options->TakeNumber("errdel", rules.slow_ratio, 1e-6, kMost);
  rules.progress_interval =
      options->TakeInteger("nfreq", rules.progress_interval, 1, kMostSteps);
  return rules;
}

// How wfactor comes about.
enum class WfactorRule { kGiven, kCrossValidation, kDiscrepancy };

struct WfactorOption {
  WfactorRule rule = WfactorRule::kGiven;
  double wfactor = 1e-5;
  double delta = 0.0;  // kDiscrepancy: wanted RMS, the target's unit

  static WfactorOption Take(const ModelSpec& spec, SpecOptions* options) {
    constexpr double kMostWfactor = 1e6;
    constexpr double kLeastDelta = 1e-300;
    constexpr double kMostDelta = 1e300;
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    WfactorOption taken;
    taken.delta =
        options->TakeNumber("discrepancy", kNone, kLeastDelta, kMostDelta);
    const bool by_cv = options->IsWord("wfactor", "cv");
    if (!std::isnan(taken.delta)) {
      if (options->Has("wfactor")) {
        throw std::invalid_argument(fmt::format(
            "model '{}': discrepancy= finds the wfactor, which wfactor= fixes",
            spec.text));
      }
      taken.rule = WfactorRule::kDiscrepancy;
    } else if (by_cv) {
      taken.rule = WfactorRule::kCrossValidation;
    } else {
      taken.wfactor =
          options->TakeNumber("wfactor", taken.wfactor, 0.0, kMostWfactor);
    }
    return taken;
  }

  void Describe(std::vector<EffectiveOption>* all) const {
    switch (rule) {
      case WfactorRule::kGiven:
        all->push_back({"wfactor", wfactor});
        break;
      case WfactorRule::kCrossValidation:
        all->push_back({"wfactor", std::string("cv")});
        break;
      case WfactorRule::kDiscrepancy:
        all->push_back({"discrepancy", delta});
        break;
    }
  }
};

// What `choose=` says of several starts: lowest cost, or least error on inner
// hold-outs.
const std::vector<std::string>& StartRules() {
  static const std::vector<std::string> words = {"cost", "cv"};
  return words;
}

// What `path=` says of the way to a wfactor: down WfactorPath where it is
// tuned, always, never.
const std::vector<std::string>& PathWords() {
  static const std::vector<std::string> words = {"auto", "yes", "no"};
  return words;
}

// The iterations of a fit along the path are shared by its steps.
fitting::StoppingRules RulesOfAStep(fitting::StoppingRules rules) {
  const auto steps = static_cast<std::int64_t>(WfactorPath().size());
  rules.iterations = (rules.iterations + steps - 1) / steps;
  return rules;
}

// The first of the lowest; one that is not a number loses.
std::size_t IndexOfLowest(const std::vector<double>& values) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!std::isnan(values[i]) && !(values[i] >= values[best])) best = i;
  }
  return best;
}

std::string WithUnit(double value, const data::Dataset& dataset) {
  const std::string& unit = dataset.target().unit.symbol;
  return unit.empty() ? fmt::format("{:.4g}", value)
                      : fmt::format("{:.4g} {}", value, unit);
}

// A one-hidden-layer net; how it is trained is its trainer's business.
class SpecNetRecipe final : public NetRecipe {
 public:
  explicit SpecNetRecipe(const ModelSpec& spec) : name_(spec.text) {
    constexpr double kLeastSlope = 1e-3;
    constexpr double kMostSlope = 1e3;
    constexpr std::int64_t kMostStarts = 10'000;
    constexpr std::int64_t kMostMembers = 100;
    SpecOptions options(spec);
    tunes_hidden_ = options.IsWord("hidden", "cv");
    view_ = ViewOptions::Take(&options);
    clips_ = options.TakeChoice("clip", 0, {"auto", "none"}) == 0;
    // A net with a view is to hold where it was not trained.
    constexpr std::int64_t kFewNodes = 10;
    constexpr std::int64_t kFewSteps = 750;
    constexpr std::int64_t kSomeMembers = 3;
    if (view_.given) design_.hidden = kFewNodes;
    const bool one_start =
        options.Has("starts") || options.Has("discrepancy") || !view_.given;
    members_ = options.TakeInteger(
        "members", one_start ? 1 : kSomeMembers, 1, kMostMembers);
    if (!tunes_hidden_) {
      design_.hidden = options.TakeInteger("hidden", design_.hidden, 1, 10'000);
    }
    wfactor_ = WfactorOption::Take(spec, &options);
    if (view_.given && !options.Has("wfactor") && !options.Has("discrepancy")) {
      wfactor_.rule = WfactorRule::kCrossValidation;
    }
    const std::size_t path = options.TakeChoice("path", 0, PathWords());
    walks_path_ =
        path == 0 ? wfactor_.rule == WfactorRule::kCrossValidation : path == 1;
    fitting::StoppingRules defaults = DefaultStoppingRules(spec.type);
    if (view_.given) {
      defaults.iterations = std::min(defaults.iterations, kFewSteps);
    }
    stopping_ = TakeStoppingRules(defaults, &options);
    design_.scaling = static_cast<InputScaling>(
        options.TakeChoice("scale", 0, InputScalingNames()));
    design_.output = static_cast<OutputFunction>(
        options.TakeChoice("output", 0, {"sigmoid", "linear"}));
    design_.slope =
        options.TakeNumber("slope", design_.slope, kLeastSlope, kMostSlope);
    starts_ = options.TakeInteger("starts", 1, 1, kMostStarts);
    const std::string choose = options.TakeText("choose", "");
    chooses_start_by_cv_ = options.TakeChoice("choose", 0, StartRules()) == 1;
    if (!choose.empty() && starts_ < 2) {
      throw std::invalid_argument(fmt::format(
          "model '{}': choose= chooses among several starts; give starts=N",
          spec.text));
    }
    if (tunes_hidden_ && wfactor_.rule == WfactorRule::kDiscrepancy) {
      throw std::invalid_argument(fmt::format(
          "model '{}': discrepancy= needs a number of hidden nodes; choose it "
          "with wfactor=cv first",
          spec.text));
    }
    if (starts_ > 1 && wfactor_.rule == WfactorRule::kDiscrepancy) {
      throw std::invalid_argument(fmt::format(
          "model '{}': discrepancy= follows one start; take its wfactor to "
          "starts=",
          spec.text));
    }
    if (members_ > 1 &&
        (starts_ > 1 || wfactor_.rule == WfactorRule::kDiscrepancy)) {
      throw std::invalid_argument(fmt::format(
          "model '{}': members= averages several starts; starts= and "
          "discrepancy= choose one",
          spec.text));
    }
    if (walks_path_ && wfactor_.rule == WfactorRule::kDiscrepancy) {
      throw std::invalid_argument(fmt::format(
          "model '{}': discrepancy= walks a path of its own", spec.text));
    }
    if (options.IsWord("rows", "all")) {
      most_rows_ = std::numeric_limits<Index>::max();
      options.TakeText("rows", "");
    } else {
      most_rows_ = options.TakeInteger(
          "rows", kMostRows, kFewestRows, std::numeric_limits<Index>::max());
    }
    trainer_ = MakeNetTrainer(
        spec.type, walks_path_ ? RulesOfAStep(stopping_) : stopping_, &options);
    options.RefuseOthers();
  }

  std::string name() const override { return name_; }
  ModelKind kind() const override { return ModelKind::kNet; }

  std::vector<EffectiveOption> options() const override {
    std::vector<EffectiveOption> all;
    if (tunes_hidden_) {
      all.push_back({"hidden", std::string("cv")});
    } else {
      all.push_back({"hidden", design_.hidden});
    }
    wfactor_.Describe(&all);
    if (walks_path_) all.push_back({"path", std::string("yes")});
    all.push_back({"iterations", stopping_.iterations});
    all.push_back({"egoal", stopping_.cost_goal});
    all.push_back({"gwgoal", stopping_.gradient_goal});
    all.push_back(
        {"scale",
         InputScalingNames()[static_cast<std::size_t>(design_.scaling)]});
    all.push_back({"output", std::string(ToString(design_.output))});
    all.push_back({"slope", design_.slope});
    const fitting::StoppingRules unlimited;
    if (stopping_.evaluations != unlimited.evaluations) {
      all.push_back({"evaluations", stopping_.evaluations});
    }
    if (stopping_.slow_ratio != unlimited.slow_ratio) {
      all.push_back({"errdel", stopping_.slow_ratio});
      all.push_back({"nfreq", stopping_.progress_interval});
    }
    if (stopping_.seconds != unlimited.seconds) {
      all.push_back({"seconds", stopping_.seconds});
    }
    if (starts_ > 1) {
      all.push_back({"starts", starts_});
      all.push_back({"choose", StartRules()[chooses_start_by_cv_ ? 1 : 0]});
    }
    if (members_ > 1) all.push_back({"members", members_});
    if (most_rows_ == std::numeric_limits<Index>::max()) {
      all.push_back({"rows", std::string("all")});
    } else if (most_rows_ != kMostRows) {
      all.push_back({"rows", most_rows_});
    }
    view_.Describe(&all);
    if (view_.given && !clips_) {
      all.push_back({"clip", std::string("none")});
    }
    std::ranges::move(trainer_->options(), std::back_inserter(all));
    return all;
  }

  std::optional<std::string> WhatIsMissing(
      const Dataset& dataset) const override {
    if (dataset.num_inputs() > 0) return std::nullopt;
    return "inputs: a net needs at least one";
  }

  std::optional<Index> NumCoefficients(const Dataset& dataset) const override {
    if (tunes_hidden_) return std::nullopt;
    return design_.ShapeFor(dataset).num_weights();
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    if (const auto missing = WhatIsMissing(training)) {
      throw std::invalid_argument("the data lack " + *missing);
    }
    // A net with a memory is a blend's as well as its own.
    if (context.shared == nullptr || !view_.given || context.keep_trace) {
      return FitAlone(training, context);
    }
    return *context.shared->Get<FittedModel>(name_, [&] {
      return std::make_shared<const FittedModel>(FitAlone(training, context));
    });
  }

  std::unique_ptr<NetRecipe> WithChoicesOf(
      const FittedModel& fitted) const override {
    return std::make_unique<SpecNetRecipe>(FixedTo(fitted));
  }

  double EffectiveParametersOf(const FittedModel& fitted,
                               const Dataset& training) const override {
    const SpecNetRecipe fixed = FixedTo(fitted);
    const Dataset sample = Sample(training, most_rows_);
    const Dataset viewed = fitted.history != nullptr
                               ? DeriveDataset(sample, *fitted.history)
                               : sample;
    const NetRows rows = ScaleRows(fixed.design_, viewed);
    const ModelDescription description = fitted.model->Describe();
    // Of averaged starts the first speaks for the others.
    const auto* blend = std::get_if<BlendForm>(&description);
    const NetForm& form = blend != nullptr
                              ? std::get<NetForm>(blend->members.front().form)
                              : std::get<NetForm>(description);
    NetTraining at_minimum = rows.training;
    at_minimum.wfactor = fixed.wfactor_.wfactor;
    return EffectiveParameters(at_minimum, rows.WeightsOf(form));
  }

 private:
  FittedModel FitAlone(const Dataset& training,
                       const FitContext& context) const {
    const bool takes_all = training.num_rows() <= most_rows_;
    const auto shared =
        takes_all
            ? SharedViews(training, view_, context)
            : std::make_shared<const std::vector<ViewedRows>>(MakeViews(
                  Sample(training, most_rows_), view_, context.indifference));
    const std::vector<ViewedRows>& views = *shared;
    std::vector<TunedNet> tuned;
    std::vector<double> scores;
    for (const ViewedRows& viewed : views) {
      tuned.push_back(Tune(
          Sample(*viewed.rows, kMostTuningRows), views.size() > 1, context));
      scores.push_back(tuned.back().rmse);
    }
    const std::size_t best = IndexOfLowest(scores);
    const ViewedRows& viewed = views[best];
    FittedModel fitted = FitView(*viewed.rows, tuned[best], context);
    if (view_.given) {
      fitted.choices.push_back({"view", std::string(ToString(viewed.view))});
      if (viewed.sine_and_cosine) {
        fitted.choices.push_back({"angles", std::string("sincos")});
      }
      if (clips_) {
        fitted.guards = MakeGuards(fitted.inputs, training.target_values());
      }
    }
    if (views.size() > 1) {
      std::string tried;
      for (std::size_t i = 0; i < views.size(); ++i) {
        if (i > 0) tried += ", ";
        tried += fmt::format("{}: {:.4g}", views[i].label(), scores[i]);
      }
      fitted.remarks.push_back(fmt::format(
          "view {} by inner hold-outs (tried {})", viewed.label(), tried));
    }
    if (viewed.history != nullptr) {
      fitted = WithHistory(std::move(fitted), training, *viewed.history);
    } else {
      fitted.inputs = DescribeAllInputs(training);
    }
    if (!takes_all) {
      fitted.remarks.push_back(
          fmt::format("trained on {} of {} rows, drawn from all over them "
                      "(rows=all takes all)",
                      viewed.rows->num_rows(),
                      training.num_rows()));
    }
    return fitted;
  }

  static std::vector<Index> AllColumns(Index count) {
    std::vector<Index> columns(static_cast<std::size_t>(count));
    std::iota(columns.begin(), columns.end(), Index{0});
    return columns;
  }

  static std::vector<TrainedInput> DescribeAllInputs(const Dataset& rows) {
    return DescribeInputs(rows, AllColumns(rows.num_inputs()));
  }

  static Dataset Sample(const Dataset& rows, Index most) {
    return rows.num_rows() <= most
               ? rows
               : rows.SelectRows(StratifiedRows(rows, most));
  }

  SpecNetRecipe FixedTo(const FittedModel& fitted) const {
    SpecNetRecipe fixed = *this;
    fixed.starts_ = 1;
    fixed.members_ = 1;
    fixed.chooses_start_by_cv_ = false;
    fixed.tunes_hidden_ = false;
    fixed.wfactor_.rule = WfactorRule::kGiven;
    for (const EffectiveOption& choice : fitted.choices) {
      if (choice.key == "hidden") {
        fixed.design_.hidden = std::get<std::int64_t>(choice.value);
      } else if (choice.key == "wfactor") {
        fixed.wfactor_.wfactor = std::get<double>(choice.value);
      } else if (choice.key == "view") {
        fixed.view_.view = ViewOf(std::get<std::string>(choice.value));
      } else if (choice.key == "angles") {
        fixed.view_.sine_and_cosine = true;
      }
    }
    return fixed;
  }

  // The net, or the average of several, on rows as they stand.
  FittedModel FitView(const Dataset& training,
                      const TunedNet& tuned,
                      const FitContext& context) const {
    FittedModel fitted;
    fitted.name = name_;
    fitted.kind = ModelKind::kNet;
    fitted.target = training.target();
    fitted.align = training.align();
    fitted.inputs = DescribeAllInputs(training);
    NetDesign design = design_;
    design.hidden = tuned.hidden;
    DescribeTuning(tuned, training, &fitted);
    const NetRows rows = ScaleRows(design, training);
    if (members_ > 1) {
      AverageStarts(rows, tuned.wfactor, context, &fitted);
      return fitted;
    }
    fitting::Minimum minimum =
        wfactor_.rule == WfactorRule::kDiscrepancy
            ? FitToDiscrepancy(training, rows, context, &fitted)
            : FitStarts(
                  training, design, rows, tuned.wfactor, context, &fitted);
    fitted.model = std::make_shared<FeedforwardNet>(rows.FormOf(minimum.x));
    fitted.summary = std::move(minimum.summary);
    return fitted;
  }

  void AverageStarts(const NetRows& rows,
                     double wfactor,
                     const FitContext& context,
                     FittedModel* fitted) const {
    const std::vector<Index> columns = AllColumns(rows.training.shape.inputs);
    std::vector<std::uint64_t> seeds;
    for (std::int64_t k = 0; k < members_; ++k) {
      seeds.push_back(SeedOfStart(context.seed, k));
    }
    std::vector<fitting::Minimum> minima =
        TrainFromStarts(rows, *trainer_, Wfactors(wfactor), &seeds, context);
    fitted->starts = DescribeStarts(seeds, minima);
    std::vector<AveragedMember> members;
    for (std::size_t i = 0; i < minima.size(); ++i) {
      fitted->starts[i].chosen = true;
      members.push_back({.name = fmt::format("start {}", i + 1),
                         .weight = 1.0,
                         .inputs = columns,
                         .lowest = -std::numeric_limits<double>::infinity(),
                         .highest = std::numeric_limits<double>::infinity(),
                         .model = std::make_shared<FeedforwardNet>(
                             rows.FormOf(minima[i].x))});
    }
    fitted->model = std::make_shared<AveragedModel>(
        static_cast<Index>(columns.size()), "equal", std::move(members));
    // What the first start did stands for all; each is in `starts`.
    fitted->summary = std::move(minima.front().summary);
  }

  // What inner hold-outs choose on rows as they stand; where nothing is to be
  // chosen but is to be `judged`, its error.
  TunedNet Tune(const Dataset& training,
                bool judged,
                const FitContext& context) const {
    const NetTuning tuning = {
        .hidden = tunes_hidden_,
        .wfactor = wfactor_.rule == WfactorRule::kCrossValidation,
        .fixed_wfactor = wfactor_.wfactor,
        .along_path = walks_path_};
    if (tuning.hidden || tuning.wfactor) {
      return TuneNet(design_, tuning, *trainer_, training, context);
    }
    TunedNet fixed;
    fixed.hidden = design_.hidden;
    fixed.wfactor = wfactor_.wfactor;
    if (judged) {
      const InnerFolds inner = MakeInnerFolds(training, context);
      const NetTrial trial = {
          fixed.hidden, Wfactors(fixed.wfactor), context.seed};
      fixed.rmse = InnerHoldoutRmse(
                       design_, *trainer_, training, inner, {trial}, context)
                       .front();
    }
    return fixed;
  }

  std::vector<double> Wfactors(double last) const {
    return WfactorsOf(last, walks_path_);
  }

  static void DescribeTuning(const TunedNet& tuned,
                             const Dataset& training,
                             FittedModel* fitted) {
    for (const TunedValue& value : tuned.chosen) {
      fitted->inner_rmse = value.rmse;
      const bool is_hidden = value.choice.key == "hidden";
      fitted->choices.push_back(value.choice);
      fitted->remarks.push_back(fmt::format(
          "{} by cross-validation over {}: RMSE {} held out (tried {})",
          is_hidden ? fmt::format("{} hidden nodes", tuned.hidden)
                    : fmt::format("wfactor {:.4g}", tuned.wfactor),
          tuned.folds,
          WithUnit(value.rmse, training),
          value.scores));
    }
  }

  fitting::Minimum FitToDiscrepancy(const Dataset& training,
                                    const NetRows& rows,
                                    const FitContext& context,
                                    FittedModel* fitted) const {
    fitting::DiscrepancyChoice choice =
        ChooseWfactorByDiscrepancy(rows, *trainer_, wfactor_.delta, context);
    fitted->choices.push_back({"wfactor", choice.alpha});
    fitted->choices.push_back(
        {"discrepancy_reached", std::string(choice.reached ? "yes" : "no")});
    fitted->remarks.push_back(fmt::format(
        "wfactor {:.4g} by the discrepancy principle in {} fits: RMS residual "
        "{}, wanted {}{}",
        choice.alpha,
        choice.steps.size(),
        WithUnit(choice.misfit, training),
        WithUnit(wfactor_.delta, training),
        choice.reached ? "" : " (not reached)"));
    return std::move(choice.minimum);
  }

  fitting::Minimum FitStarts(const Dataset& training,
                             const NetDesign& design,
                             const NetRows& rows,
                             double wfactor,
                             const FitContext& context,
                             FittedModel* fitted) const {
    std::vector<std::uint64_t> seeds;
    for (std::int64_t k = 0; k < starts_; ++k) {
      seeds.push_back(SeedOfStart(context.seed, k));
    }
    std::vector<fitting::Minimum> minima =
        TrainFromStarts(rows, *trainer_, Wfactors(wfactor), &seeds, context);
    if (starts_ == 1) return std::move(minima.front());
    std::vector<double> costs;
    for (const fitting::Minimum& minimum : minima) {
      costs.push_back(minimum.summary.final_cost);
    }
    std::size_t best = IndexOfLowest(costs);
    fitted->starts = DescribeStarts(seeds, minima);
    if (chooses_start_by_cv_ || (context.explain && training.num_rows() > 1)) {
      const InnerFolds inner = MakeInnerFolds(training, context);
      const std::vector<double> rmse =
          JudgeStarts(training, design, wfactor, seeds, inner, context);
      for (std::size_t i = 0; i < rmse.size(); ++i) {
        fitted->starts[i].holdout_rmse = rmse[i];
      }
      if (chooses_start_by_cv_) {
        best = ChooseByRmse(training, seeds, rmse, inner.text, best, fitted);
      }
    }
    fitted->starts[best].chosen = true;
    return std::move(minima[best]);
  }

  // The start that errs least on inner hold-outs; `by_cost` where none of them
  // could be judged.
  static std::size_t ChooseByRmse(const Dataset& training,
                                  const std::vector<std::uint64_t>& seeds,
                                  const std::vector<double>& rmse,
                                  const std::string& folds,
                                  std::size_t by_cost,
                                  FittedModel* fitted) {
    const std::size_t best = IndexOfLowest(rmse);
    if (std::isnan(rmse[best])) {
      fitted->remarks.push_back(
          "no start could be judged on inner hold-outs: the lowest cost was "
          "taken");
      return by_cost;
    }
    fitted->choices.push_back(
        {"start_seed", static_cast<std::int64_t>(seeds[best])});
    fitted->remarks.push_back(fmt::format(
        "start {} of {} by cross-validation over {}: RMSE {} held out",
        best + 1,
        seeds.size(),
        folds,
        WithUnit(rmse[best], training)));
    return best;
  }

  std::vector<double> JudgeStarts(const Dataset& training,
                                  const NetDesign& design,
                                  double wfactor,
                                  const std::vector<std::uint64_t>& seeds,
                                  const InnerFolds& inner,
                                  const FitContext& context) const {
    std::vector<NetTrial> trials;
    for (const std::uint64_t seed : seeds) {
      trials.push_back({design.hidden, Wfactors(wfactor), seed});
    }
    return InnerHoldoutRmse(
        design, *trainer_, training, inner, trials, context);
  }

  static std::vector<StartResult> DescribeStarts(
      const std::vector<std::uint64_t>& seeds,
      const std::vector<fitting::Minimum>& minima) {
    std::vector<StartResult> starts;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const fitting::FitSummary& summary = minima[i].summary;
      starts.push_back({.seed = seeds[i],
                        .final_cost = summary.final_cost,
                        .termination = summary.termination,
                        .iterations = summary.iterations});
    }
    return starts;
  }

  // Time grows with the rows, accuracy beyond these hardly.
  static constexpr std::int64_t kMostRows = 20'000;
  static constexpr Index kMostTuningRows = 5'000;
  static constexpr std::int64_t kFewestRows = 100;

  std::string name_;
  ViewOptions view_;
  Index most_rows_ = kMostRows;
  bool clips_ = true;
  std::int64_t members_ = 1;
  NetDesign design_;
  WfactorOption wfactor_;
  bool walks_path_ = false;
  bool tunes_hidden_;
  std::int64_t starts_;
  bool chooses_start_by_cv_;
  fitting::StoppingRules stopping_;
  std::shared_ptr<const NetTrainer> trainer_;
};

}  // namespace

std::unique_ptr<ModelRecipe> MakeNetRecipe(const ModelSpec& spec) {
  const std::vector<std::string>& types = NetTypes();
  if (std::ranges::find(types, spec.type) == types.end()) return nullptr;
  return std::make_unique<SpecNetRecipe>(spec);
}

}  // namespace errmap::models
