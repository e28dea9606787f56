#include "models/net/net_recipe.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "models/averaged_model.h"
#include "models/history/fit_in_view.h"
#include "models/history/view.h"
#include "models/history/with_history.h"
#include "models/net/feedforward_net.h"
#include "models/net/net_effective_parameters.h"
#include "models/net/net_fit.h"
#include "models/net/net_trainer.h"
#include "models/option_list.h"
#include "models/shared_work.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

using data::Dataset;
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

std::int64_t Share(std::int64_t iterations, std::int64_t parts) {
  return (iterations + parts - 1) / parts;
}

// Single precision suffices to compare wfactors and views, in half the time.
// Empty if the method has none, or all is in it.
NetTrainer InSinglePrecision(const NetOptions& options,
                             const fitting::StoppingRules& rules) {
  const auto* scg = std::get_if<ScgTraining>(&options.method);
  if (scg == nullptr || scg->is_single ||
      scg->variant != fitting::ScgVariant::kMoller) {
    return {};
  }
  return MakeNetTrainer(ScgTraining{.is_single = true}, rules);
}

NetTrainers TrainersOf(const NetOptions& options) {
  // Brief enough to try all wfactors, and as good a guide as fits five times as
  // long (README.md).
  constexpr std::int64_t kBriefFits = 5;
  fitting::StoppingRules rules = options.stopping();
  NetTrainers trainers;
  if (*options.path) {  // the steps of a path share the iterations of a fit
    rules.iterations = Share(rules.iterations, std::ssize(WfactorPath()));
  }
  trainers.full_iterations = rules.iterations;
  trainers.full = MakeNetTrainer(options.method, rules);
  if (*options.path) trainers.along_path = InSinglePrecision(options, rules);
  if (options.tunes_wfactor() && !*options.path && rules.iterations > 1) {
    rules.iterations = Share(rules.iterations, kBriefFits);
    trainers.brief_iterations = rules.iterations;
    trainers.brief = MakeNetTrainer(options.method, rules);
  }
  return trainers;
}

// A one-hidden-layer net; how it is trained is its trainer's business.
class OneLayerRecipe final : public NetRecipe {
 public:
  OneLayerRecipe(const NetOptions& options, std::string name)
      : name_(CheckedName(options, std::move(name))),
        options_(options.Resolved()),
        design_(options_.design()),
        trainers_(TrainersOf(options_)) {}

  std::string name() const override { return name_; }
  ModelKind kind() const override { return ModelKind::kNet; }

  std::vector<EffectiveOption> options() const override {
    return InEffect(options_);
  }

  std::optional<std::string> WhatIsMissing(
      const Dataset& dataset) const override {
    if (dataset.num_inputs() > 0) return std::nullopt;
    return "inputs: a net needs at least one";
  }

  std::optional<Index> NumCoefficients(const Dataset& dataset) const override {
    if (options_.tunes_hidden()) return std::nullopt;
    return design_.ShapeFor(dataset).num_weights();
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    if (const auto missing = WhatIsMissing(training)) {
      throw std::invalid_argument("the data lack " + *missing);
    }
    if (context.shared == nullptr || !options_.view) {
      return FitAlone(training, context);
    }
    // A net with a memory is a blend's as well as its own.
    FittedModel fitted = *context.shared->Get<FittedModel>(name_, [&] {
      FitContext traced = context;
      traced.keep_trace = true;  // whoever asks first
      return std::make_shared<const FittedModel>(FitAlone(training, traced));
    });
    if (!context.keep_trace) fitted.summary.trace.clear();
    return fitted;
  }

  std::unique_ptr<NetRecipe> WithChoicesOf(
      const FittedModel& fitted) const override {
    return std::make_unique<OneLayerRecipe>(FixedTo(fitted));
  }

  double EffectiveParametersOf(const FittedModel& fitted,
                               const Dataset& training) const override {
    const OneLayerRecipe fixed = FixedTo(fitted);
    const Dataset sample = Sample(training, options_.rows);
    const Dataset viewed = fitted.history != nullptr
                               ? DeriveDataset(sample, *fitted.history)
                               : sample;
    const NetRows rows = ScaleRows(fixed.design_, viewed);
    const ModelDescription description = fitted.model->Describe();
    // The first of the averaged starts represents the others.
    const auto* blend = std::get_if<BlendForm>(&description);
    const NetForm& form = blend != nullptr
                              ? std::get<NetForm>(blend->members.front().form)
                              : std::get<NetForm>(description);
    NetTraining at_minimum = rows.training;
    at_minimum.wfactor = fixed.options_.given_wfactor();
    return EffectiveParameters(at_minimum, rows.WeightsOf(form));
  }

 private:
  FittedModel FitAlone(const Dataset& training,
                       const FitContext& context) const {
    const bool takes_all = training.num_rows() <= options_.rows;
    const auto shared = takes_all
                            ? SharedViews(training, options_.view, context)
                            : std::make_shared<const std::vector<ViewedRows>>(
                                  MakeViews(Sample(training, options_.rows),
                                            options_.view,
                                            context.indifference));
    const std::vector<ViewedRows>& views = *shared;
    std::vector<TunedNet> tuned;
    std::vector<double> scores;
    double least = std::numeric_limits<double>::infinity();
    for (const ViewedRows& viewed : views) {
      tuned.push_back(Tune(Sample(*viewed.rows, kMostTuningRows),
                           views.size() > 1,
                           least,
                           context));
      scores.push_back(tuned.back().rmse);
      least = std::fmin(least, scores.back());
    }
    const std::size_t best = IndexOfLowest(scores);
    const ViewedRows& viewed = views[best];
    FittedModel fitted = FitView(*viewed.rows, tuned[best], context);
    if (options_.view) NoteView(viewed, &fitted);
    if (options_.clip) {
      fitted.guards = MakeClampLimits(fitted.inputs, training.target_values());
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
      fitted.choices.push_back({"rows", viewed.rows->num_rows()});
      fitted.remarks.push_back(
          fmt::format("trained on {} of {} rows from all over the data "
                      "(rows=all uses all)",
                      viewed.rows->num_rows(),
                      training.num_rows()));
    }
    return fitted;
  }

  static std::vector<TrainedInput> DescribeAllInputs(const Dataset& rows) {
    return DescribeInputs(rows, stats::AllIndices(rows.num_inputs()));
  }

  static Dataset Sample(const Dataset& rows, Index most) {
    return rows.num_rows() <= most
               ? rows
               : rows.SelectRows(StratifiedRows(rows, most));
  }

  OneLayerRecipe FixedTo(const FittedModel& fitted) const {
    NetOptions fixed = options_;
    fixed.starts = 1;
    fixed.members = 1;
    fixed.choose.reset();
    fixed.hidden = design_.hidden;
    fixed.wfactor = options_.given_wfactor();
    fixed.discrepancy.reset();
    for (const EffectiveOption& choice : fitted.choices) {
      if (choice.key == "hidden") {
        fixed.hidden = std::get<std::int64_t>(choice.value);
      } else if (choice.key == "wfactor") {
        fixed.wfactor = std::get<double>(choice.value);
      } else if (choice.key == "iterations") {
        fixed.iterations = std::get<std::int64_t>(choice.value);
      } else if (choice.key == "view") {
        fixed.view->view = ViewOf(std::get<std::string>(choice.value));
      } else if (choice.key == "angles") {
        fixed.view->sine_and_cosine = true;
      }
    }
    return {fixed, name_};
  }

  // The net, or the average of several, on rows as they stand.
  FittedModel FitView(const Dataset& training,
                      const TunedNet& tuned,
                      const FitContext& context) const {
    FittedModel fitted = NewMap(name_, ModelKind::kNet, training);
    fitted.inputs = DescribeAllInputs(training);
    NetDesign design = design_;
    design.hidden = tuned.hidden;
    DescribeTuning(tuned, training, &fitted);
    const NetRows rows = ScaleRows(design, training);
    if (*options_.members > 1) {
      AverageStarts(rows, tuned, context, &fitted);
      return fitted;
    }
    fitting::Minimum minimum =
        options_.discrepancy
            ? FitToDiscrepancy(training, rows, context, &fitted)
            : FitStarts(training, design, rows, tuned, context, &fitted);
    fitted.model = std::make_shared<FeedforwardNet>(rows.FormOf(minimum.x));
    fitted.summary = std::move(minimum.summary);
    return fitted;
  }

  const NetTrainer& TrainerOf(const TunedNet& tuned) const {
    const bool brief =
        trainers_.brief && tuned.iterations == trainers_.brief_iterations;
    return brief ? trainers_.brief : trainers_.full;
  }

  void AverageStarts(const NetRows& rows,
                     const TunedNet& tuned,
                     const FitContext& context,
                     FittedModel* fitted) const {
    const std::vector<Index> columns =
        stats::AllIndices(rows.training.shape.inputs);
    std::vector<std::uint64_t> seeds;
    for (std::int64_t k = 0; k < *options_.members; ++k) {
      seeds.push_back(SeedOfStart(context.seed, k));
    }
    std::vector<fitting::Minimum> minima = TrainFromStarts(
        rows, TrainerOf(tuned), Wfactors(tuned.wfactor), &seeds, context);
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
        std::ssize(columns), "equal", std::move(members));
    // The summary is that of the first start; each is in `starts`.
    fitted->summary = std::move(minima.front().summary);
  }

  // Returns the choices of inner hold-outs on rows as they are. If there is no
  // choice but it is to be `judged`, its error. `rival`: that of another view.
  TunedNet Tune(const Dataset& training,
                bool judged,
                double rival,
                const FitContext& context) const {
    const NetTuning tuning = {.hidden = options_.tunes_hidden(),
                              .wfactor = options_.tunes_wfactor(),
                              .fixed_wfactor = options_.given_wfactor(),
                              .along_path = *options_.path,
                              .rival = rival};
    if (tuning.hidden || tuning.wfactor) {
      return TuneNet(design_, tuning, trainers_, training, context);
    }
    TunedNet fixed;
    fixed.hidden = design_.hidden;
    fixed.wfactor = options_.given_wfactor();
    if (judged) {
      const InnerFolds inner = MakeInnerFolds(training, context);
      const NetTrial trial = {
          fixed.hidden, Wfactors(fixed.wfactor), context.seed};
      fixed.rmse =
          InnerHoldoutRmse(
              design_, trainers_.full, training, inner, {trial}, context)
              .front();
    }
    return fixed;
  }

  std::vector<double> Wfactors(double last) const {
    return WfactorsOf(last, *options_.path);
  }

  static void DescribeTuning(const TunedNet& tuned,
                             const Dataset& training,
                             FittedModel* fitted) {
    for (const TunedValue& value : tuned.chosen) {
      fitted->inner_rmse = value.rmse;
      fitted->choices.push_back(value.choice);
      fitted->remarks.push_back(fmt::format(
          "{} by cross-validation over {}: RMSE {} held out (tried {})",
          value.text,
          tuned.folds,
          WithUnit(value.rmse, training),
          value.scores));
    }
  }

  fitting::Minimum FitToDiscrepancy(const Dataset& training,
                                    const NetRows& rows,
                                    const FitContext& context,
                                    FittedModel* fitted) const {
    fitting::DiscrepancyChoice choice = ChooseWfactorByDiscrepancy(
        rows, trainers_.full, *options_.discrepancy, context);
    fitted->choices.push_back({"wfactor", choice.alpha});
    fitted->choices.push_back(
        {"discrepancy_reached", std::string(choice.reached ? "yes" : "no")});
    fitted->remarks.push_back(fmt::format(
        "wfactor {:.4g} by the discrepancy principle in {} fits: RMS residual "
        "{}, wanted {}{}",
        choice.alpha,
        choice.steps.size(),
        WithUnit(choice.misfit, training),
        WithUnit(*options_.discrepancy, training),
        choice.reached ? "" : " (not reached)"));
    return std::move(choice.minimum);
  }

  fitting::Minimum FitStarts(const Dataset& training,
                             const NetDesign& design,
                             const NetRows& rows,
                             const TunedNet& tuned,
                             const FitContext& context,
                             FittedModel* fitted) const {
    std::vector<std::uint64_t> seeds;
    for (std::int64_t k = 0; k < *options_.starts; ++k) {
      seeds.push_back(SeedOfStart(context.seed, k));
    }
    std::vector<fitting::Minimum> minima = TrainFromStarts(
        rows, TrainerOf(tuned), Wfactors(tuned.wfactor), &seeds, context);
    if (*options_.starts == 1) return std::move(minima.front());
    std::vector<double> costs;
    for (const fitting::Minimum& minimum : minima) {
      costs.push_back(minimum.summary.final_cost);
    }
    std::size_t best = IndexOfLowest(costs);
    fitted->starts = DescribeStarts(seeds, minima);
    if (options_.choose == StartRule::kCrossValidation ||
        (context.explain && training.num_rows() > 1)) {
      const InnerFolds inner = MakeInnerFolds(training, context);
      const std::vector<double> rmse =
          JudgeStarts(training, design, tuned, seeds, inner, context);
      for (std::size_t i = 0; i < rmse.size(); ++i) {
        fitted->starts[i].holdout_rmse = rmse[i];
      }
      if (options_.choose == StartRule::kCrossValidation) {
        best = ChooseByRmse(training, seeds, rmse, inner.text, best, fitted);
      }
    }
    fitted->starts[best].chosen = true;
    return std::move(minima[best]);
  }

  // Returns the start with the least error on inner hold-outs; `by_cost` if
  // none of them could be judged.
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
          "chosen");
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
                                  const TunedNet& tuned,
                                  const std::vector<std::uint64_t>& seeds,
                                  const InnerFolds& inner,
                                  const FitContext& context) const {
    std::vector<NetTrial> trials;
    for (const std::uint64_t seed : seeds) {
      trials.push_back({design.hidden, Wfactors(tuned.wfactor), seed});
    }
    return InnerHoldoutRmse(
        design, TrainerOf(tuned), training, inner, trials, context);
  }

  static std::vector<StartResult> DescribeStarts(
      const std::vector<std::uint64_t>& seeds,
      const std::vector<fitting::Minimum>& minima) {
    std::vector<StartResult> starts;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const fitting::FitSummary& summary = minima[i].summary;
      starts.push_back({.seed = seeds[i],
                        .final_cost = summary.final_cost,
                        .stop = summary.termination,
                        .iterations = summary.iterations});
    }
    return starts;
  }

  std::string name_;
  NetOptions options_;  // resolved
  NetDesign design_;
  NetTrainers trainers_;
};

}  // namespace

std::unique_ptr<ModelRecipe> MakeRecipe(const NetOptions& options,
                                        std::string name) {
  return std::make_unique<OneLayerRecipe>(options, std::move(name));
}

}  // namespace errmap::models
