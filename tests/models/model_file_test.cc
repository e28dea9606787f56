#include "models/model_file.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "data/input_error.h"
#include "models/history/history.h"
#include "models/history/with_history.h"
#include "models/map_experience.h"
#include "models/recipe_catalog.h"
#include "models/uncertainty/add_uncertainty.h"
#include "tests/models/history/history_data.h"
#include "tests/models/model_test_data.h"

namespace errmap::models {
namespace {

using errmap::testing::ShippedMeasurements;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

std::string SavedModel(const std::string& spec) {
  return ModelToJson(MakeRecipe(spec)->Fit(ShippedMeasurements(), {}),
                     {{"data", "shipped"}});
}

// Of a file that may be changed at will.
Json WithoutChecksum(const std::string& text) {
  Json document = Json::parse(text);
  document.erase("checksum");
  return document;
}

TEST(ModelFile, ReproducesEveryPredictionBitForBit) {
  const data::Dataset dataset = ShippedMeasurements();
  for (const std::string spec : {"zero",
                                 "mean",
                                 "poly:eq8",
                                 "poly:full:degree=6",
                                 "poly:stepwise",
                                 "net:scg:iterations=30",
                                 "net:lm:iterations=5"}) {
    const FittedModel fitted = MakeRecipe(spec)->Fit(dataset, {.seed = 3});
    const FittedModel loaded =
        ModelFromJson(ModelToJson(fitted, {}), "saved.json");
    EXPECT_EQ(loaded.Predict(dataset), fitted.Predict(dataset)) << spec;
    EXPECT_EQ(loaded.name, spec);
    EXPECT_EQ(loaded.kind, fitted.kind);
    EXPECT_EQ(loaded.target, fitted.target);
    EXPECT_EQ(loaded.equation, fitted.equation);
    // And saving what was loaded changes nothing.
    EXPECT_EQ(ModelToJson(loaded, {}), ModelToJson(fitted, {})) << spec;
  }
}

// What loading says after `damage` has been done to a saved model.
std::string Refusal(const std::string& spec,
                    const std::function<void(Json*)>& damage) {
  Json document = WithoutChecksum(SavedModel(spec));
  damage(&document);
  try {
    ModelFromJson(document.dump(), "saved.json");
  } catch (const data::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ModelFile, LoadsWhatIsWhole) {
  EXPECT_EQ(Refusal("poly:eq8", [](Json*) {}), "");
}

TEST(ModelFile, RefusesAnUnknownVersion) {
  const std::string message = Refusal(
      "poly:eq8", [](Json* json) { (*json)["schema"] = "errmap-model-9"; });
  EXPECT_THAT(message, HasSubstr("saved.json: key 'schema'"));
  EXPECT_THAT(message, HasSubstr("reads errmap-model-1"));
}

TEST(ModelFile, RefusesWrongShapesMissingKeysAndNonFiniteNumbers) {
  using Damage = std::function<void(Json*)>;
  struct Case {
    std::string spec;
    Damage damage;
    std::string expected;
  };
  const std::string net = "net:scg:iterations=3";
  const std::vector<Case> cases = {
      {"poly:eq8",
       [](Json* j) { (*j)["polynomial"]["input_scale"].push_back(1.0); },
       "input_offset and input_scale differ"},
      {"poly:eq8",
       [](Json* j) { (*j)["polynomial"]["terms"][1]["powers"].push_back(1); },
       "3 powers for 2 inputs"},
      {"poly:eq8",
       [](Json* j) { (*j)["polynomial"]["terms"][1]["coefficient"] = nullptr; },
       "polynomial.terms[1].coefficient': must be a finite number"},
      {"poly:eq8",
       [](Json* j) { (*j)["polynomial"]["terms"][0]["powers"][0] = -1; },
       "must be a whole number"},
      {"poly:eq8", [](Json* j) { j->erase("polynomial"); }, "'polynomial'"},
      {"poly:eq8", [](Json* j) { (*j)["kind"] = "spline"; }, "'spline'"},
      {"poly:eq8", [](Json* j) { (*j)["inputs"].erase(1); }, "names 1 inputs"},
      {"poly:eq8", [](Json* j) { (*j)["inputs"][0]["min"] = "low"; }, "min"},
      {"poly:eq8",
       [](Json* j) { (*j)["inputs"][1]["name"] = (*j)["inputs"][0]["name"]; },
       "inputs[1].name': 'position_mm' stands there twice"},
      {"poly:eq8",
       [](Json* j) { (*j)["inputs"][0]["min"] = 1e9; },
       "inputs[0].min': is above max"},
      {"poly:eq8",
       [](Json* j) { (*j)["inputs"][0]["sd"] = -1.0; },
       "inputs[0].sd': must be at least 0"},
      {net, [](Json* j) { (*j)["net"]["nodes"][1] = 7; }, "nodes"},
      {net, [](Json* j) { (*j)["net"]["w1"][2].erase(0); }, "w1[2]"},
      {net, [](Json* j) { (*j)["net"]["output"] = "tanh"; }, "'tanh'"},
      {net, [](Json* j) { (*j)["net"]["target_slope"][0] = 0.0; }, "slope"},
      {net, [](Json* j) { (*j)["parameters"] = 80; }, "is 80, the model has"}};
  for (const Case& c : cases) {
    EXPECT_THAT(Refusal(c.spec, c.damage), HasSubstr(c.expected));
  }
}

// A map with filters, a zero and guards.
FittedModel MapWithMemoryInModelFile(const data::Dataset& dataset) {
  const History history{
      .time_unit = "s",
      .session = "day",
      .time = "time_s",
      .derived = {Ema(dataset.inputs()[0], 600.0, "s"),
                  Zeroed(dataset.inputs()[1])},
      .form_inputs = {"ema(t1_degC,600s)", "zeroed(t2_degC)"}};
  const data::Dataset derived = DeriveDataset(dataset, history);
  FittedModel fitted = MakeRecipe(
                           "poly:formula=\"ema(t1_degC,600s)\"+\"zeroed(t2_"
                           "degC)\"")
                           ->Fit(derived, {});
  fitted.guards = MakeClampLimits(fitted.inputs, dataset.target_values());
  return WithHistory(std::move(fitted), dataset, history);
}

TEST(ModelFile, ReproducesAMapWithAMemory) {
  const data::Dataset dataset = errmap::testing::WanderingDays();
  FittedModel fitted = MapWithMemoryInModelFile(dataset);
  fitted.align = data::Alignment::kFirst;
  const std::string text = ModelToJson(fitted, {});
  const FittedModel loaded = ModelFromJson(text, "saved.json");
  EXPECT_EQ(loaded.Predict(dataset), fitted.Predict(dataset));
  EXPECT_EQ(loaded.align, data::Alignment::kFirst);
  EXPECT_EQ(ModelToJson(loaded, {}), text);
  const Json document = Json::parse(text);
  EXPECT_EQ(loaded.history->time, "time_s");
  EXPECT_EQ(document["history"]["derived"][0]["tau"], 600.0);
  EXPECT_EQ(document["history"]["form_inputs"].size(), 2U);
  EXPECT_EQ(document["guards"]["input_margin"], 2.0);
  EXPECT_EQ(document["inputs"][0]["name"], "t1_degC");
}

TEST(ModelFile, KeepsWhatAMapPromises) {
  FittedModel fitted =
      MakeRecipe("poly:eq8")->Fit(errmap::testing::QuadraticData(40), {});
  fitted.interval = PredictionInterval{.holdout = "sessions:4",
                                       .unit = "day",
                                       .units = 12,
                                       .levels = {{.coverage = 0.9,
                                                   .half_width = 1.25e-3,
                                                   .inside = 1e-3,
                                                   .outside = 1.5e-3},
                                                  {.coverage = 0.95,
                                                   .half_width = 2.5e-3,
                                                   .inside = 2.5e-3,
                                                   .outside = 2.5e-3,
                                                   .at_least = true}}};
  const FittedModel read =
      ModelFromJson(ModelToJson(fitted, {}), "memory.json");
  ASSERT_TRUE(read.interval.has_value());
  EXPECT_EQ(read.interval->holdout, "sessions:4");
  EXPECT_EQ(read.interval->unit, "day");
  EXPECT_EQ(read.interval->units, 12);
  ASSERT_EQ(read.interval->levels.size(), 2U);
  EXPECT_EQ(read.interval->levels[0].half_width, 1.25e-3);
  EXPECT_EQ(read.interval->levels[0].inside, 1e-3);
  EXPECT_EQ(read.interval->levels[0].outside, 1.5e-3);
  EXPECT_EQ(read.interval->levels[1].inside, 2.5e-3);
  EXPECT_EQ(read.interval->levels[1].outside, 2.5e-3);
  EXPECT_FALSE(read.interval->levels[0].at_least);
  EXPECT_EQ(read.interval->levels[1].half_width, 2.5e-3);
  EXPECT_TRUE(read.interval->levels[1].at_least);
  std::string spoilt = WithoutChecksum(ModelToJson(fitted, {})).dump();
  spoilt.replace(spoilt.find("0.00125"), 7, "-1.0000");
  EXPECT_THROW(ModelFromJson(spoilt, "memory.json"), data::InputError);
}

// A map with sensors and held-out errors, as `fit` writes it.
Json MapWithExperience() {
  const data::Dataset days = errmap::testing::WanderingDays();
  FittedModel fitted = MakeRecipe("poly:full:degree=1")->Fit(days, {});
  AddExperience(days, &fitted);
  AddUncertainty(days, MakeRecipe("poly:full:degree=1"), {}, &fitted);
  return WithoutChecksum(ModelToJson(fitted, {}));
}

std::string RefusalOf(const Json& document) {
  try {
    ModelFromJson(document.dump(), "map.json");
  } catch (const data::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ModelFile, RefusesReadingsWhosePrecisionIsIndefinite) {
  Json map = MapWithExperience();
  ASSERT_EQ(RefusalOf(map), "");
  Json& precision = map["applicability"]["sessions"]["precision"];
  ASSERT_GE(precision.size(), 2U);
  const double beyond =
      2.0 * (precision[0][0].get<double>() + precision[1][1].get<double>());
  precision[0][1] = precision[1][0] = beyond;
  EXPECT_THAT(RefusalOf(map), HasSubstr("must be positive definite"));
}

// The first starts of sessions were of single rows.
TEST(ModelFile, ReadsFilesWhoseStartsHaveNoChanges) {
  Json map = MapWithExperience();
  Json& sessions = map["applicability"]["sessions"];
  sessions["starts"] = {{"mean", sessions["scatter"]},
                        {"covariance", sessions["precision"]},
                        {"sessions", 4}};
  const FittedModel read = ModelFromJson(map.dump(), "old.json");
  ASSERT_TRUE(read.applicability->sessions.has_value());
  EXPECT_FALSE(read.applicability->sessions->starts.has_value());
}

TEST(ModelFile, RefusesHeldOutErrorsThatGoBackInTime) {
  Json map = MapWithExperience();
  Json& elapsed = map["held_out"]["units"][0]["elapsed"];
  ASSERT_GE(elapsed.size(), 2U);
  elapsed[0] = elapsed[1].get<double>() + 1.0;
  EXPECT_THAT(RefusalOf(map), HasSubstr("elapsed': must not fall"));
}

TEST(ModelFile, ReadsFilesFromBeforeThereWereMemories) {
  Json document = WithoutChecksum(SavedModel("poly:eq8"));
  document.erase("history");
  document.erase("guards");
  EXPECT_EQ(ModelFromJson(document.dump(), "old.json").history, nullptr);
}

TEST(ModelFile, RefusesAHistoryThatCannotRun) {
  const std::string text = ModelToJson(
      MapWithMemoryInModelFile(errmap::testing::WanderingDays()), {});
  const auto refusal = [&](const std::function<void(Json*)>& damage) {
    Json document = WithoutChecksum(text);
    damage(&document);
    try {
      ModelFromJson(document.dump(), "saved.json");
    } catch (const data::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  using Damage = std::function<void(Json*)>;
  const std::vector<std::pair<Damage, std::string>> cases = {
      {[](Json* j) { (*j)["history"]["derived"][0]["tau"] = 0.0; },
       "must be above 0"},
      {[](Json* j) { (*j)["history"]["derived"][0]["of"] = "t9"; },
       "no column or earlier derived input 't9'"},
      {[](Json* j) { (*j)["history"]["derived"][0]["filter"] = "iir"; },
       "found 'iir'"},
      {[](Json* j) { (*j)["history"]["time_unit"] = "h"; },
       "must be 's' or 'rows'"},
      {[](Json* j) { (*j)["history"]["form_inputs"].erase(1); },
       "names 1 inputs, the model reads 2"},
      {[](Json* j) { (*j)["guards"]["input_min"].erase(1); },
       "needs 2 numbers"}};
  for (const auto& [damage, expected] : cases) {
    EXPECT_THAT(refusal(damage), HasSubstr(expected));
  }
}

TEST(ModelFile, RefusesWhatIsNoJson) {
  const std::string whole = SavedModel("poly:eq8");
  EXPECT_THROW(ModelFromJson(whole.substr(0, whole.size() / 2), "cut.json"),
               data::InputError);
  EXPECT_THROW(ModelFromJson("", "empty.json"), data::InputError);
  EXPECT_THROW(ModelFromJson("[1, 2]", "list.json"), data::InputError);
  EXPECT_THROW(LoadModel("/nonexistent/map.json"), data::InputError);
}

TEST(ModelFile, SaysWhereAFileBreaks) {
  const auto reading = [](const std::string& text) {
    return [text] { ModelFromJson(text, "map.json"); };
  };
  EXPECT_THAT(
      reading("{\"schema\": 1"),
      ::testing::ThrowsMessage<data::InputError>(
          "map.json: is not a complete map: its JSON is invalid at byte 12 of "
          "12; use another copy, or run errmap fit again"));
  EXPECT_THAT(reading("{\"schema\": 1e999}"),
              ::testing::ThrowsMessage<data::InputError>(
                  "map.json: has a number that is too large"));
}

// Where a digit is changed: in the mantissa, the exponent, a name, the
// checksum.
TEST(ModelFile, RefusesAFileOfWhichADigitWasChanged) {
  const std::string whole =
      ModelToJson(MapWithMemoryInModelFile(errmap::testing::WanderingDays()),
                  {{"data", "shipped"}});
  EXPECT_TRUE(ModelFromJson(whole, "map.json").remarks.empty());
  int digits = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    if (whole[at] < '0' || whole[at] > '9') continue;
    std::string changed = whole;
    changed[at] = changed[at] == '9' ? '0' : static_cast<char>(whole[at] + 1);
    EXPECT_THAT([&] { ModelFromJson(changed, "map.json"); },
                ::testing::ThrowsMessage<data::InputError>(
                    ::testing::Not(::testing::HasSubstr("\n"))))
        << whole.substr(at > 20 ? at - 20 : 0, 40);
    ++digits;
  }
  EXPECT_GT(digits, 300);
}

TEST(ModelFile, TakesAnIndentedCopy) {
  const std::string whole = SavedModel("poly:eq8");
  std::string copy = Json::parse(whole).dump(4);
  for (std::size_t at = 0; (at = copy.find('\n', at)) != std::string::npos;) {
    copy.insert(at, "\r");
    at += 2;
  }
  EXPECT_TRUE(ModelFromJson(copy, "map.json").remarks.empty());
}

TEST(ModelFile, SaysWhatAFileWithoutChecksumLacks) {
  const std::string text = WithoutChecksum(SavedModel("poly:eq8")).dump();
  EXPECT_THAT(
      ModelFromJson(text, "old.json").remarks,
      ::testing::ElementsAre(
          "old.json has no checksum: a changed number would go unnoticed"));
}

TEST(ModelFile, RefusesAKeyThatStandsTwiceInOneObject) {
  std::string text = SavedModel("poly:eq8");
  const std::size_t intercept = text.find("\"intercept\"");
  text.insert(intercept, "\"\\u0069ntercept\": 1e9, ");
  EXPECT_THAT([&] { ModelFromJson(text, "map.json"); },
              ::testing::ThrowsMessage<data::InputError>(
                  HasSubstr("map.json: has the key 'intercept' twice")));
}

TEST(ModelFile, RefusesNestingThatEndsTheStack) {
  constexpr int kDepth = 300'000;
  EXPECT_THAT([&] { ModelFromJson(std::string(kDepth, '['), "map.json"); },
              ::testing::ThrowsMessage<data::InputError>(
                  HasSubstr("map.json: is nested deeper than 64")));
}

}  // namespace
}  // namespace errmap::models
