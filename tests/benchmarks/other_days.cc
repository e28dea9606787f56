// Does the recommended map hold on days that nobody saw? Simulates a turning
// centre, compares the default models on its first days, and judges each
// recommendation on the last days, beside the best model in hindsight:
//
//   other_days [TRAINING_DAYS [JUDGED_DAYS [SEEDS]]]     (default 3 2 20)
//
// One line per seed and rule (whole cycles, neighbours, whole days), then the
// geometric mean and the worst of RMSE recommended / RMSE best.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "data/csv.h"
#include "data/dataset.h"
#include "data/turning_centre/simulation_files.h"
#include "models/recipe_catalog.h"
#include "models/study/study.h"
#include "models/study/verdict.h"
#include "stats/holdout.h"

namespace errmap {
namespace {

using Eigen::Index;
using models::Holdout;

constexpr const char* kComponent = "x_displacement_down.csv";
constexpr double kMicrometres = 1e3;
// groups:5 of cycles, kfold:5 of rows, whole days left out in turn.
constexpr std::array<const char*, 3> kRules = {
    "groups:5", "kfold:5", "day by day"};

data::PreparedDataset SimulateComponent(int days, std::uint64_t seed) {
  data::turning_centre::SimulationOptions options;
  options.days = days;
  options.seed = seed;
  options.dead = {3, 4, 16, 19};
  const auto simulation = data::turning_centre::Simulate(options);
  return data::MakeDataset(data::ParseCsv(data::turning_centre::SimulationFile(
                                              simulation, {}, kComponent),
                                          kComponent),
                           {});
}

// Rows of the first days, and of the rest.
struct Days {
  data::Dataset first;
  std::shared_ptr<const data::Dataset> last;
};

Days SplitDays(const data::Dataset& dataset, int first_days, int days) {
  std::vector<Index> first;
  std::vector<Index> last;
  const auto cycles = static_cast<Index>(dataset.groups().labels.size());
  for (Index row = 0; row < dataset.num_rows(); ++row) {
    const Index cycle = dataset.groups().codes[static_cast<std::size_t>(row)];
    (cycle * days < cycles * first_days ? first : last).push_back(row);
  }
  return {dataset.SelectRows(first),
          std::make_shared<const data::Dataset>(dataset.SelectRows(last))};
}

// Rows of `dataset` with the days as groups in place of the cycles.
data::Dataset GroupByDay(const data::Dataset& dataset,
                         Index cycles_per_day,
                         int days) {
  data::Dataset::Parts parts;
  parts.source = dataset.source();
  parts.inputs = dataset.inputs();
  parts.input_values = dataset.input_values();
  parts.target = dataset.target();
  parts.target_values = dataset.target_values();
  parts.groups.column = "day";
  for (int day = 1; day <= days; ++day) {
    parts.groups.labels.push_back(std::to_string(day));
  }
  for (const Index cycle : dataset.groups().codes) {
    parts.groups.codes.push_back(cycle / cycles_per_day);
  }
  return data::Dataset(std::move(parts));
}

// The same study with one of its hold-outs only.
models::StudyResult OnlyHoldout(const models::StudyResult& study,
                                std::size_t holdout) {
  models::StudyResult one = study;
  for (models::ModelResult& model : one.models) {
    model.holdouts = {
        study.models[&model - one.models.data()].holdouts[holdout]};
  }
  return one;
}

struct Score {
  double log_sum = 0.0;          // of RMSE recommended / RMSE best
  double log_promise_sum = 0.0;  // of RMSE on the last days / promised
  double worst = 0.0;
  int above_baseline = 0;
};

void ScoreSeed(int training_days,
               int judged_days,
               std::uint64_t seed,
               std::vector<Score>* scores) {
  constexpr double kIndifference = 0.02 / kMicrometres;
  const int days = training_days + judged_days;
  const auto prepared = SimulateComponent(days, seed);
  const Days split = SplitDays(prepared.dataset, training_days, days);
  std::vector<Holdout> holdouts;
  for (const char* spec : {"groups:5", "kfold:5"}) {
    holdouts.push_back(
        models::MakeHoldout(stats::ParseHoldout(spec), split.first, seed));
  }
  const auto cycles = static_cast<Index>(split.first.groups().labels.size());
  const data::Dataset by_day =
      GroupByDay(split.first, cycles / days, training_days);
  holdouts.push_back(models::MakeHoldout(
      stats::ParseHoldout("leave-one-group-out"), by_day, seed));
  holdouts.push_back(models::MakeHoldout(
      stats::ParseHoldout("file:last"), split.first, seed, split.last));
  const auto defaults =
      models::MakeDefaultRecipes(split.first, split.first.num_rows() * 4 / 5);
  const auto study = models::RunStudy(
      split.first, holdouts, defaults.recipes, {.seed = seed, .jobs = 2});
  constexpr std::size_t kTruth = 3;
  const auto rmse = [&](std::size_t model) {
    return study.models[model].holdouts[kTruth].test.rmse;
  };
  double best = INFINITY;
  double best_baseline = INFINITY;
  std::size_t best_model = 0;
  for (std::size_t m = 0; m < study.models.size(); ++m) {
    if (!study.models[m].ok()) continue;
    if (rmse(m) < best) best_model = m;
    best = std::min(best, rmse(m));
    if (study.models[m].baseline) {
      best_baseline = std::min(best_baseline, rmse(m));
    }
  }
  for (std::size_t rule = 0; rule < kTruth; ++rule) {
    const models::Judgement judgement =
        models::JudgeStudy(rule == 2 ? by_day : split.first,
                           {holdouts[rule]},
                           OnlyHoldout(study, rule),
                           {.indifference = kIndifference, .seed = seed});
    const std::size_t model = judgement.recommendation->model;
    const double promised = study.models[model].holdouts[rule].test.rmse;
    const double ratio = rmse(model) / best;
    Score& score = (*scores)[rule];
    score.log_sum += std::log(ratio);
    score.log_promise_sum += std::log(rmse(model) / promised);
    score.worst = std::max(score.worst, ratio);
    if (rmse(model) > best_baseline) ++score.above_baseline;
    fmt::print(
        "seed {:2} {:11} {:14} promised {:6.3f} um, last days {:6.3f}, best {} "
        "{:6.3f}, best "
        "baseline {:6.3f}, ratio {:.3f}\n",
        seed,
        kRules[rule],
        study.models[model].name,
        promised * kMicrometres,
        rmse(model) * kMicrometres,
        study.models[best_model].name,
        best * kMicrometres,
        best_baseline * kMicrometres,
        ratio);
    std::fflush(stdout);
  }
}

int Main(int argc, char** argv) {
  const auto argument = [&](int at, int fallback) {
    return argc > at ? std::atoi(argv[at]) : fallback;
  };
  const int training_days = argument(1, 3);
  const int judged_days = argument(2, 2);
  const int seeds = argument(3, 20);
  std::vector<Score> scores(kRules.size());
  for (int seed = 1; seed <= seeds; ++seed) {
    ScoreSeed(
        training_days, judged_days, static_cast<std::uint64_t>(seed), &scores);
  }
  for (std::size_t rule = 0; rule < scores.size(); ++rule) {
    fmt::print(
        "{}: geometric mean {:.3f}, worst {:.3f}, above the best baseline {} "
        "of {}; last days / promised {:.2f}\n",
        kRules[rule],
        std::exp(scores[rule].log_sum / seeds),
        scores[rule].worst,
        scores[rule].above_baseline,
        seeds,
        std::exp(scores[rule].log_promise_sum / seeds));
  }
  return 0;
}

}  // namespace
}  // namespace errmap

int main(int argc, char** argv) { return errmap::Main(argc, argv); }
