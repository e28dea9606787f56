#include "models/net/net_options.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace errmap::models {
namespace {

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

WfactorOption TakeWfactor(const ModelSpec& spec, SpecOptions* options) {
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

void DescribeWfactor(const WfactorOption& option,
                     std::vector<EffectiveOption>* all) {
  switch (option.rule) {
    case WfactorRule::kGiven:
      all->push_back({"wfactor", option.wfactor});
      break;
    case WfactorRule::kCrossValidation:
      all->push_back({"wfactor", std::string("cv")});
      break;
    case WfactorRule::kDiscrepancy:
      all->push_back({"discrepancy", option.delta});
      break;
  }
}

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

// Of those that each have a meaning by themselves.
void RefuseContradictions(const ModelSpec& spec, const NetOptions& taken) {
  if (taken.tunes_hidden && taken.wfactor.rule == WfactorRule::kDiscrepancy) {
    throw std::invalid_argument(fmt::format(
        "model '{}': discrepancy= needs a number of hidden nodes; choose it "
        "with wfactor=cv first",
        spec.text));
  }
  if (taken.starts > 1 && taken.wfactor.rule == WfactorRule::kDiscrepancy) {
    throw std::invalid_argument(fmt::format(
        "model '{}': discrepancy= follows one start; take its wfactor to "
        "starts=",
        spec.text));
  }
  if (taken.members > 1 &&
      (taken.starts > 1 || taken.wfactor.rule == WfactorRule::kDiscrepancy)) {
    throw std::invalid_argument(
        fmt::format("model '{}': members= averages several starts; starts= and "
                    "discrepancy= choose one",
                    spec.text));
  }
  if (taken.walks_path && taken.wfactor.rule == WfactorRule::kDiscrepancy) {
    throw std::invalid_argument(fmt::format(
        "model '{}': discrepancy= walks a path of its own", spec.text));
  }
}

}  // namespace

NetOptions TakeNetOptions(const ModelSpec& spec) {
  constexpr double kLeastSlope = 1e-3;
  constexpr double kMostSlope = 1e3;
  constexpr std::int64_t kMostStarts = 10'000;
  constexpr std::int64_t kMostMembers = 100;
  constexpr std::int64_t kFewestRows = 100;
  SpecOptions options(spec);
  NetOptions taken;
  taken.tunes_hidden = options.IsWord("hidden", "cv");
  taken.view = ViewOptions::Take(&options);
  taken.clips = options.TakeChoice("clip", 0, {"auto", "none"}) == 0;
  // A net with a view is to hold where it was not trained.
  constexpr std::int64_t kFewNodes = 10;
  constexpr std::int64_t kFewSteps = 750;
  constexpr std::int64_t kSomeMembers = 3;
  if (taken.view.given) taken.design.hidden = kFewNodes;
  const bool one_start =
      options.Has("starts") || options.Has("discrepancy") || !taken.view.given;
  taken.members = options.TakeInteger(
      "members", one_start ? 1 : kSomeMembers, 1, kMostMembers);
  if (!taken.tunes_hidden) {
    taken.design.hidden =
        options.TakeInteger("hidden", taken.design.hidden, 1, 10'000);
  }
  taken.wfactor = TakeWfactor(spec, &options);
  if (taken.view.given && !options.Has("wfactor") &&
      !options.Has("discrepancy")) {
    taken.wfactor.rule = WfactorRule::kCrossValidation;
  }
  const std::size_t path = options.TakeChoice("path", 0, PathWords());
  taken.walks_path = path == 0
                         ? taken.wfactor.rule == WfactorRule::kCrossValidation
                         : path == 1;
  fitting::StoppingRules defaults = DefaultStoppingRules(spec.type);
  if (taken.view.given) {
    defaults.iterations = std::min(defaults.iterations, kFewSteps);
  }
  taken.stopping = TakeStoppingRules(defaults, &options);
  taken.design.scaling = static_cast<InputScaling>(
      options.TakeChoice("scale", 0, InputScalingNames()));
  taken.design.output = static_cast<OutputFunction>(
      options.TakeChoice("output", 0, {"sigmoid", "linear"}));
  taken.design.slope =
      options.TakeNumber("slope", taken.design.slope, kLeastSlope, kMostSlope);
  taken.starts = options.TakeInteger("starts", 1, 1, kMostStarts);
  const std::string choose = options.TakeText("choose", "");
  taken.chooses_start_by_cv =
      options.TakeChoice("choose", 0, StartRules()) == 1;
  if (!choose.empty() && taken.starts < 2) {
    throw std::invalid_argument(fmt::format(
        "model '{}': choose= chooses among several starts; give starts=N",
        spec.text));
  }
  RefuseContradictions(spec, taken);
  if (options.IsWord("rows", "all")) {
    taken.most_rows = std::numeric_limits<Index>::max();
    options.TakeText("rows", "");
  } else {
    taken.most_rows = options.TakeInteger("rows",
                                          NetOptions::kMostRows,
                                          kFewestRows,
                                          std::numeric_limits<Index>::max());
  }
  taken.trainer = MakeNetTrainer(
      spec.type,
      taken.walks_path ? RulesOfAStep(taken.stopping) : taken.stopping,
      &options);
  options.RefuseOthers();
  return taken;
}

std::vector<EffectiveOption> NetOptions::Describe() const {
  std::vector<EffectiveOption> all;
  if (tunes_hidden) {
    all.push_back({"hidden", std::string("cv")});
  } else {
    all.push_back({"hidden", design.hidden});
  }
  DescribeWfactor(wfactor, &all);
  if (walks_path) all.push_back({"path", std::string("yes")});
  all.push_back({"iterations", stopping.iterations});
  all.push_back({"egoal", stopping.cost_goal});
  all.push_back({"gwgoal", stopping.gradient_goal});
  all.push_back(
      {"scale", InputScalingNames()[static_cast<std::size_t>(design.scaling)]});
  all.push_back({"output", std::string(ToString(design.output))});
  all.push_back({"slope", design.slope});
  const fitting::StoppingRules unlimited;
  if (stopping.evaluations != unlimited.evaluations) {
    all.push_back({"evaluations", stopping.evaluations});
  }
  if (stopping.slow_ratio != unlimited.slow_ratio) {
    all.push_back({"errdel", stopping.slow_ratio});
    all.push_back({"nfreq", stopping.progress_interval});
  }
  if (stopping.seconds != unlimited.seconds) {
    all.push_back({"seconds", stopping.seconds});
  }
  if (starts > 1) {
    all.push_back({"starts", starts});
    all.push_back({"choose", StartRules()[chooses_start_by_cv ? 1 : 0]});
  }
  if (members > 1) all.push_back({"members", members});
  if (most_rows == std::numeric_limits<Index>::max()) {
    all.push_back({"rows", std::string("all")});
  } else if (most_rows != kMostRows) {
    all.push_back({"rows", most_rows});
  }
  view.Describe(&all);
  if (view.given && !clips) {
    all.push_back({"clip", std::string("none")});
  }
  std::ranges::move(trainer->options(), std::back_inserter(all));
  return all;
}

}  // namespace errmap::models
