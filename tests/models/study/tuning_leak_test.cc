// Whatever a model tunes, it tunes inside the training rows of a fold: nothing
// there depends on rows held out, and noise is not made to look like skill.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/recipe_catalog.h"
#include "models/study/study.h"
#include "stats/indices.h"
#include "stats/random.h"
#include "tests/decompositions.h"
#include "tests/models/history/history_data.h"
#include "tests/models/model_test_data.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using ::testing::HasSubstr;

using Recipes = std::vector<std::unique_ptr<ModelRecipe>>;

// Every model that chooses something.
Recipes RecipesThatTune() {
  const std::string net = "net:scg:iterations=15:";
  std::vector<std::string> specs = {
      "poly:temperature",
      "poly:eq7",
      "poly:eq8",
      "poly:eq9",
      "poly:ridge:degree=2",
      "poly:ridge:degree=2:rule=1se",
      "poly:lasso:degree=2",
      "poly:lasso:degree=2:rule=1se",
      net + "hidden=4:wfactor=cv",
      net + "hidden=cv",
      net + "hidden=cv:wfactor=cv",
      net + "hidden=4:discrepancy=0.002",
      net + "hidden=4:starts=3",
      net + "hidden=4:starts=3:choose=cv",
      net + "hidden=cv:wfactor=cv:starts=2:choose=cv",
  };
  for (const std::string criterion :
       {"p", "aic", "aicc", "bic", "adjr2", "press", "cp", "cv"}) {
    specs.push_back("poly:stepwise:degree=2:choose=" + criterion +
                    ":stop=none");
    specs.push_back("poly:stepwise:degree=2:criterion=" + criterion);
  }
  for (const std::string criterion : {"aic", "aicc", "bic", "adjr2", "cp"}) {
    specs.push_back("poly:best:degree=2:criterion=" + criterion);
  }
  Recipes recipes;
  for (const std::string& spec : specs) recipes.push_back(MakeRecipe(spec));
  return recipes;
}

data::Dataset::Parts PartsOfInTuningLeak(const data::Dataset& dataset) {
  return {.source = dataset.source(),
          .inputs = dataset.inputs(),
          .input_values = dataset.input_values(),
          .target = dataset.target(),
          .target_values = dataset.target_values(),
          .groups = dataset.groups(),
          .weights = dataset.weights(),
          .rows = dataset.rows()};
}

// Rows of 9 days in order, 7 each: the quadratic and a little noise.
data::Dataset DaysInTuningLeak() {
  constexpr Index kDays = 9;
  constexpr Index kRows = 7;
  data::Dataset::Parts parts =
      PartsOfInTuningLeak(errmap::testing::QuadraticData(kDays * kRows));
  stats::Random random(17);
  parts.groups.column = "day";
  for (Index day = 0; day < kDays; ++day) {
    parts.groups.labels.push_back(std::to_string(day));
    for (Index i = 0; i < kRows; ++i) {
      parts.groups.codes.push_back(day);
      parts.target_values[day * kRows + i] += 2e-3 * (random.Uniform() - 0.5);
    }
  }
  return data::Dataset(std::move(parts));
}

data::Dataset WithWildRows(const data::Dataset& dataset,
                           const std::vector<Index>& rows) {
  data::Dataset::Parts parts = PartsOfInTuningLeak(dataset);
  for (const Index row : rows) {
    const double wild = row % 2 == 0 ? 1e6 : -1e5;
    parts.input_values.row(row).setConstant(wild + static_cast<double>(row));
    parts.target_values[row] = -wild;
  }
  return data::Dataset(std::move(parts));
}

// One fold of a hold-out, judged on rows of their own, which show the map.
Holdout OnProbe(const Holdout& holdout, std::size_t fold) {
  static const auto probe =
      std::make_shared<const data::Dataset>(errmap::testing::QuadraticData(31));
  Holdout one = holdout;
  one.folds = {holdout.folds[fold]};
  one.folds.front().test = stats::AllIndices(probe->num_rows());
  one.test_data = probe;
  return one;
}

// Fits the whole data set, whatever it is given: what must not happen.
class LeakingRecipe final : public ModelRecipe {
 public:
  explicit LeakingRecipe(const data::Dataset& all) : all_(all) {}
  std::string name() const override { return "leaking"; }
  ModelKind kind() const override { return ModelKind::kPolynomial; }
  std::vector<EffectiveOption> options() const override { return {}; }
  std::optional<std::string> WhatIsMissing(
      const data::Dataset&) const override {
    return std::nullopt;
  }
  std::optional<Index> NumCoefficients(const data::Dataset&) const override {
    return std::nullopt;
  }
  FittedModel Fit(const data::Dataset&,
                  const FitContext& context) const override {
    return MakeRecipe("poly:temperature")->Fit(all_, context);
  }

 private:
  const data::Dataset& all_;
};

TEST(Tuning, NoFittedMapDependsOnTheRowsHeldOut) {
  const data::Dataset clean = DaysInTuningLeak();
  for (const char* spec : {"groups:3", "every:3", "forward:2"}) {
    const Holdout holdout = MakeHoldout(stats::ParseHoldout(spec), clean, 1);
    const std::size_t fold = holdout.folds.size() - 1;
    const data::Dataset wild = WithWildRows(clean, holdout.folds[fold].test);
    const auto study = [&](const data::Dataset& dataset) {
      Recipes recipes = RecipesThatTune();
      recipes.push_back(std::make_unique<LeakingRecipe>(dataset));
      return RunStudy(dataset, {OnProbe(holdout, fold)}, recipes, {.jobs = 2});
    };
    const StudyResult a = study(clean);
    const StudyResult b = study(wild);
    ASSERT_EQ(a.models.back().name, "leaking");
    for (std::size_t m = 0; m < a.models.size(); ++m) {
      const HoldoutResult& on_clean = a.models[m].holdouts[0];
      const HoldoutResult& on_wild = b.models[m].holdouts[0];
      const std::string what = std::string(spec) + " " + a.models[m].name;
      ASSERT_EQ(on_clean.why_failed, "") << what;
      ASSERT_EQ(on_wild.why_failed, "") << what;
      const FoldResult& x = on_clean.folds[0];
      const FoldResult& y = on_wild.folds[0];
      if (a.models[m].name == "leaking") {
        EXPECT_NE(x.test_predictions, y.test_predictions);
        continue;
      }
      EXPECT_EQ(x.test_predictions, y.test_predictions) << what;
      EXPECT_EQ(x.train_rmse, y.train_rmse) << what;
      EXPECT_EQ(x.remarks, y.remarks) << what;
      EXPECT_EQ(x.summary.message, y.summary.message) << what;
      ASSERT_EQ(x.choices.size(), y.choices.size()) << what;
      for (std::size_t i = 0; i < x.choices.size(); ++i) {
        EXPECT_EQ(x.choices[i].key, y.choices[i].key) << what;
        EXPECT_EQ(x.choices[i].value, y.choices[i].value) << what;
      }
    }
  }
}

// Six runs of 20 rows whose error follows a filtered temperature.
data::Dataset::Parts Runs() {
  constexpr Index kRuns = 6;
  constexpr Index kRows = 20;
  const Index rows = kRuns * kRows;
  MatrixXd values(rows, 3);
  VectorXd time(rows);
  std::vector<Index> codes;
  VectorXd target(rows);
  stats::Random random(5);
  double slow = 0.0;
  for (Index row = 0; row < rows; ++row) {
    const Index run = row / kRows;
    const double k = static_cast<double>(row % kRows);
    const double warmth = 3.0 * random.Uniform();
    slow = row % kRows == 0 ? warmth : slow + 0.2 * (warmth - slow);
    values.row(row) << 50.0 * static_cast<double>(row % 4),
        20.0 + static_cast<double>(run) + warmth, 21.0 + std::sin(0.7 * k);
    time[row] = 9000.0 * static_cast<double>(run) + 100.0 * k;
    target[row] = 4.0 * slow + 0.02 * values(row, 0) * slow + random.Uniform();
    codes.push_back(run);
  }
  const data::Dataset dataset =
      errmap::testing::WithLog({errmap::testing::ColumnNamed("position_mm"),
                                errmap::testing::ColumnNamed("t1_degC"),
                                errmap::testing::ColumnNamed("t2_degC")},
                               values,
                               time,
                               codes);
  data::Dataset::Parts parts = PartsOfInTuningLeak(dataset);
  parts.target_values = target;
  parts.log = dataset.log();
  parts.log_rows = dataset.log_rows();
  return parts;
}

TEST(Tuning, NoMapWithAMemoryDependsOnSessionsHeldOut) {
  const data::Dataset clean(Runs());
  const std::string fixed = ":view=auto:history=300+1000";
  const auto recipes = [&] {
    Recipes made;
    for (const std::string& spec :
         {"poly:ridge" + fixed,
          "poly:lasso" + fixed,
          "poly:stepwise:terms=axis" + fixed,
          "net:scg:iterations=15:hidden=3" + fixed,
          std::string("blend:history=300+1000"),
          std::string("blend:net=yes:history=300+1000")}) {
      made.push_back(MakeRecipe(spec));
    }
    return made;
  };
  Holdout holdout = MakeHoldout(stats::ParseHoldout("sessions:3"), clean, 1);
  holdout.folds.resize(1);
  const std::vector<Index>& test = holdout.folds[0].test;
  data::Dataset::Parts other_targets = Runs();
  data::Dataset::Parts other_inputs = Runs();
  data::SessionLog log = *other_inputs.log;
  for (const Index row : test) {
    other_targets.target_values[row] = row % 2 == 0 ? 1e6 : -1e5;
    other_inputs.input_values.row(row).setConstant(1e6);
    log.input_values.row(row).setConstant(1e6);
  }
  other_inputs.log = std::make_shared<const data::SessionLog>(std::move(log));
  const auto study = [&](const data::Dataset& dataset) {
    return RunStudy(dataset, {holdout}, recipes(), {.jobs = 2});
  };
  const StudyResult a = study(clean);
  const StudyResult b = study(data::Dataset(std::move(other_targets)));
  const StudyResult c = study(data::Dataset(std::move(other_inputs)));
  for (std::size_t m = 0; m < a.models.size(); ++m) {
    const std::string& what = a.models[m].name;
    ASSERT_EQ(a.models[m].holdouts[0].why_failed, "") << what;
    const FoldResult& x = a.models[m].holdouts[0].folds[0];
    const FoldResult& y = b.models[m].holdouts[0].folds[0];
    const FoldResult& z = c.models[m].holdouts[0].folds[0];
    EXPECT_EQ(x.test_predictions, y.test_predictions) << what;
    EXPECT_NE(x.test_predictions, z.test_predictions) << what;
    for (const FoldResult* fold : {&y, &z}) {
      EXPECT_EQ(x.train_rmse, fold->train_rmse) << what;
      EXPECT_EQ(x.remarks, fold->remarks) << what;
      EXPECT_EQ(x.summary.message, fold->summary.message) << what;
    }
  }
}

TEST(Tuning, HoldsOutInsideAsOutside) {
  const data::Dataset dataset = DaysInTuningLeak();
  const std::string net = "net:scg:iterations=5:";
  Recipes recipes;
  for (const std::string& spec : {std::string("poly:ridge:degree=2"),
                                  std::string("poly:lasso:degree=2"),
                                  net + "wfactor=cv",
                                  net + "hidden=cv",
                                  net + "starts=2:choose=cv"}) {
    recipes.push_back(MakeRecipe(spec));
  }
  std::vector<Holdout> holdouts;
  const std::vector<std::pair<std::string, std::string>> kinds = {
      {"groups:3", "groups:5 of day"},
      {"groups:3:repeats=1", "groups:5 of day"},
      {"leave-one-group-out", "groups:5 of day"},
      {"every:3", "kfold:5"},
      {"kfold:3", "kfold:5"},
      {"random:0.3", "kfold:5"},
      {"forward:1", "forward:4 of day"}};
  for (const auto& [outside, inside] : kinds) {
    holdouts.push_back(MakeHoldout(stats::ParseHoldout(outside), dataset, 1));
  }
  const StudyResult study = RunStudy(dataset, holdouts, recipes, {});
  for (const ModelResult& model : study.models) {
    for (std::size_t h = 0; h < kinds.size(); ++h) {
      ASSERT_EQ(model.holdouts[h].why_failed, "") << model.name;
      for (const FoldResult& fold : model.holdouts[h].folds) {
        const std::string said =
            fold.remarks.empty() || model.name.starts_with("poly")
                ? fold.summary.message
                : fold.remarks.back();
        EXPECT_THAT(said, HasSubstr("over " + kinds[h].second))
            << model.name << " " << kinds[h].first;
      }
    }
  }
}

// --- noise

// Thirty inputs that drift from day to day with nothing in common with the
// target, which has its days too: with 12 days some of them agree by chance.
data::Dataset NoiseByDays(std::uint64_t seed) {
  constexpr Index kDays = 12;
  constexpr Index kRows = 5;
  constexpr Index kInputs = 30;
  constexpr double kWithinDay = 0.3;
  stats::Random random(seed);
  const auto draw = [&] {  // mean 0, variance 1
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += random.Uniform();
    return sum;
  };
  data::Dataset::Parts parts;
  parts.source = "noise";
  parts.target = {"error_mm", {}};
  parts.groups.column = "day";
  parts.input_values.resize(kDays * kRows, kInputs);
  parts.target_values.resize(kDays * kRows);
  for (Index j = 0; j < kInputs; ++j) {
    parts.inputs.push_back({"t" + std::to_string(j) + "_degC", {}});
  }
  for (Index day = 0; day < kDays; ++day) {
    parts.groups.labels.push_back(std::to_string(day));
    const auto fill = [&](auto column) {
      const double of_day = draw();
      for (Index i = 0; i < kRows; ++i) {
        column[day * kRows + i] = of_day + kWithinDay * draw();
      }
    };
    for (Index j = 0; j < kInputs; ++j) fill(parts.input_values.col(j));
    fill(parts.target_values.col(0));
    parts.groups.codes.insert(parts.groups.codes.end(), kRows, day);
  }
  return data::Dataset(std::move(parts));
}

// RMSE on held-out days of a linear fit in the three inputs that go best with
// the target - over all rows, those held out among them.
double LeakingRmse(const data::Dataset& all, const Holdout& holdout) {
  constexpr Index kChosen = 3;
  const VectorXd target =
      all.target_values().array() - all.target_values().mean();
  std::vector<std::pair<double, Index>> order;
  for (Index j = 0; j < all.num_inputs(); ++j) {
    const VectorXd input =
        all.input_values().col(j).array() - all.input_values().col(j).mean();
    order.emplace_back(-std::abs(input.dot(target)) / input.norm(), j);
  }
  std::sort(order.begin(), order.end());
  MatrixXd design = MatrixXd::Ones(all.num_rows(), kChosen + 1);
  for (Index k = 0; k < kChosen; ++k) {
    design.col(k) =
        all.input_values().col(order[static_cast<std::size_t>(k)].second);
  }
  double sum = 0.0;
  for (const stats::Fold& fold : holdout.folds) {
    const MatrixXd train = design(fold.train, Eigen::all);
    const VectorXd coefficients =
        testing::LeastSquares(train, all.target_values()(fold.train));
    sum += (all.target_values()(fold.test) -
            design(fold.test, Eigen::all) * coefficients)
               .squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(all.num_rows()));
}

TEST(Tuning, FindsNothingInNoiseThatALeakWouldFind) {
  constexpr std::uint64_t kSeeds = 12;
  // Geometric means over the seeds of RMSE over the mean's RMSE. A leak of
  // three inputs out of thirty gives a fifth away; honest tuning gains nothing,
  // whose chance over twelve sets is far less than the margin.
  constexpr double kVisible = 0.85;
  constexpr double kChance = 0.98;
  const std::string net = "net:scg:iterations=15:";
  Recipes recipes;
  for (const std::string& spec : {std::string("mean"),
                                  std::string("poly:temperature"),
                                  std::string("poly:stepwise:degree=1"),
                                  std::string("poly:stepwise:degree=1:"
                                              "criterion=cv"),
                                  std::string("poly:stepwise:degree=1:"
                                              "criterion=press:max_terms=5"),
                                  std::string("poly:best:degree=1:"
                                              "max_terms=3"),
                                  std::string("poly:ridge:degree=1"),
                                  std::string("poly:lasso:degree=1"),
                                  net + "hidden=3:wfactor=cv",
                                  net + "hidden=cv",
                                  net + "hidden=3:starts=4:choose=cv"}) {
    recipes.push_back(MakeRecipe(spec));
  }
  std::vector<double> log_ratio(recipes.size(), 0.0);
  double leaking = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const data::Dataset noise = NoiseByDays(seed);
    const Holdout holdout =
        MakeHoldout(stats::ParseHoldout("groups:5"), noise, seed);
    const StudyResult study =
        RunStudy(noise, {holdout}, recipes, {.seed = seed, .jobs = 2});
    const double mean = study.models[0].holdouts[0].test.rmse;
    for (std::size_t m = 0; m < recipes.size(); ++m) {
      ASSERT_EQ(study.models[m].holdouts[0].why_failed, "")
          << study.models[m].name;
      log_ratio[m] += std::log(study.models[m].holdouts[0].test.rmse / mean) /
                      static_cast<double>(kSeeds);
    }
    leaking += std::log(LeakingRmse(noise, holdout) / mean) /
               static_cast<double>(kSeeds);
  }
  EXPECT_LT(std::exp(leaking), kVisible);
  for (std::size_t m = 1; m < recipes.size(); ++m) {
    EXPECT_GT(std::exp(log_ratio[m]), kChance) << recipes[m]->name();
    RecordProperty(recipes[m]->name(), std::to_string(std::exp(log_ratio[m])));
  }
  RecordProperty("leaking", std::to_string(std::exp(leaking)));
}

// Rows of a day resemble each other, so a choice judged on other rows of the
// same days takes what does harm on new ones.
TEST(Tuning, ByWholeGroupsIsNotFooledByRowsOfTheSameDay) {
  constexpr std::uint64_t kSeeds = 6;
  Recipes recipes;
  recipes.push_back(MakeRecipe("poly:lasso:degree=1"));
  recipes.push_back(MakeRecipe("poly:ridge:degree=1"));
  recipes.push_back(MakeRecipe("poly:stepwise:degree=1:criterion=cv"));
  std::vector<double> log_ratio(recipes.size(), 0.0);
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const data::Dataset noise = NoiseByDays(seed);
    Holdout by_groups =
        MakeHoldout(stats::ParseHoldout("groups:5"), noise, seed);
    Holdout by_rows = by_groups;
    by_rows.inner = InnerHoldout::kRows;
    const StudyResult study = RunStudy(
        noise, {by_groups, by_rows}, recipes, {.seed = seed, .jobs = 2});
    for (std::size_t m = 0; m < recipes.size(); ++m) {
      log_ratio[m] += std::log(study.models[m].holdouts[1].test.rmse /
                               study.models[m].holdouts[0].test.rmse);
    }
  }
  for (std::size_t m = 0; m < recipes.size(); ++m) {
    EXPECT_GT(log_ratio[m], 0.0) << recipes[m]->name();
  }
}

}  // namespace
}  // namespace errmap::models
