#include "models/file_recipe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"
#include "data/input_error.h"
#include "models/model_file.h"
#include "models/study/judgement/choice.h"
#include "tests/models/model_test_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using errmap::testing::MakeHoldouts;
using errmap::testing::MakeRecipes;
using errmap::testing::MessageOf;
using errmap::testing::QuadraticData;
using errmap::testing::ShippedMeasurements;
using errmap::testing::WriteTestFile;
using ::testing::HasSubstr;

std::string SavedMap(const std::string& spec, const data::Dataset& dataset) {
  return WriteTestFile("map.json",
                       ModelToJson(MakeRecipe(spec)->Fit(dataset, {}), {}));
}

TEST(FileRecipe, JudgesAnExistingMapAsItIs) {
  const data::Dataset dataset = ShippedMeasurements();
  const std::string path = SavedMap("poly:full:degree=3", dataset);
  const StudyResult study =
      RunStudy(dataset,
               MakeHoldouts(dataset, {"every:3", "groups:5"}),
               MakeRecipes({"file:" + path, "poly:full:degree=3"}),
               {});
  const ModelResult& map = study.models[0];
  EXPECT_TRUE(map.ok()) << map.why();
  EXPECT_EQ(map.name, "file:" + path);
  EXPECT_EQ(map.kind, ModelKind::kFile);
  EXPECT_EQ(ChoiceOf(map), Choice::kPolynomial);
  // It knows the rows held out; the model fitted to the others does not.
  EXPECT_LT(map.holdouts[1].test.rmse, study.models[1].holdouts[1].test.rmse);
  const Eigen::VectorXd predicted = map.final_fit->Predict(dataset);
  EXPECT_EQ(predicted, study.models[1].final_fit->Predict(dataset));
}

TEST(FileRecipe, KeepsANetANet) {
  const data::Dataset dataset = QuadraticData(40);
  const StudyResult study = RunStudy(
      dataset,
      MakeHoldouts(dataset, {"every:3"}),
      MakeRecipes(
          {"file:" + SavedMap("net:scg:hidden=3:iterations=9", dataset)}),
      {});
  EXPECT_EQ(ChoiceOf(study.models[0]), Choice::kNeural);
}

TEST(FileRecipe, RefusesDataInOtherUnitsOrWithoutItsInputs) {
  const data::Dataset dataset = QuadraticData(40);
  const auto recipe = MakeRecipe("file:" + SavedMap("poly:eq8", dataset));
  data::Dataset::Parts parts;
  parts.source = "other";
  parts.inputs = dataset.inputs();
  parts.input_values = dataset.input_values();
  parts.target = {"error_um", data::UnitOfColumn("error_um")};
  parts.target_values = dataset.target_values();
  const data::Dataset micrometres(parts);
  EXPECT_THAT(
      MessageOf<std::invalid_argument>([&] { recipe->Fit(micrometres, {}); }),
      HasSubstr("the target is in mm for the map and in um"));
  parts.target = dataset.target();
  parts.inputs[0].name = "place_mm";
  const data::Dataset renamed(parts);
  EXPECT_THAT(
      MessageOf<std::invalid_argument>([&] { recipe->Fit(renamed, {}); }),
      HasSubstr("lack an input 'position_mm'"));
}

TEST(FileRecipe, SaysWhereNoModelFileIs) {
  EXPECT_THROW(MakeFileRecipe("file:/no/such/map.json"), data::InputError);
  EXPECT_THAT(MessageOf<std::invalid_argument>([] { MakeFileRecipe("file:"); }),
              HasSubstr("names no file"));
  EXPECT_EQ(MakeFileRecipe("poly:eq8"), nullptr);
}

}  // namespace
}  // namespace errmap::models
