#include "cli/study_setup/plan/run_files.h"

#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/study_setup/plan/study_run.h"
#include "tests/places.h"

namespace errmap::study_setup {
namespace {

using ::testing::ElementsAre;

StudyConfig Config(const std::vector<std::string>& names) {
  StudyConfig config;
  config.holdouts = {"every:3"};
  config.models = {"mean", "poly:eq8"};
  for (const std::string& name : names) {
    ComponentConfig& component = config.components.emplace_back();
    component.name = name;
    component.data =
        errmap::tests::SourceDir() + "/data/sets/nistir5367_xdisp_down.csv";
  }
  return config;
}

TEST(RunFiles, AreThoseThatThePlanSaid) {
  StudyPlan plan = PlanStudy(Config({"x down", "x/up"}));
  const std::vector<std::string> planned = RunFileNames(plan);
  const StudyRun run = RunPlan(std::move(plan));
  models::StudyRecord record = RecordOf(run);
  NameMaps(run, &record);
  std::map<std::string, std::string> written;
  WriteRunFiles(run, record, [&](const std::string& name, auto content) {
    EXPECT_TRUE(written.emplace(name, content).second) << name;
  });
  EXPECT_EQ(written.size(), planned.size());
  for (const std::string& name : planned) {
    EXPECT_NE(written[name], "") << name;
  }
  EXPECT_EQ(written["results.json"], models::ToJsonText(record));
  EXPECT_EQ(record.components[1].models[1].file, "models/x_up/poly_eq8.json");
  EXPECT_EQ(written["residuals/x_down.csv"], written["residuals/x_up.csv"]);
}

TEST(RunFiles, OfOneComponentNeedNoFolders) {
  const StudyPlan plan = PlanStudy(Config({"x"}));
  EXPECT_THAT(RunFileNames(plan),
              ElementsAre("results.json",
                          "residuals.csv",
                          "models/mean.json",
                          "models/poly_eq8.json",
                          "models/zero.json",
                          "models/poly_position.json",
                          "models/poly_temperature.json"));
}

}  // namespace
}  // namespace errmap::study_setup
