#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/commands/studies/compare_arguments.h"
#include "cli/study_setup/study_config.h"
#include "tests/places.h"

namespace errmap::cli {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

study_setup::StudyPlan PlanOf(const std::vector<std::string>& models) {
  study_setup::StudyConfig config;
  config.models = models;
  study_setup::ComponentConfig component;
  component.data =
      tests::SourceDir() + "/data/sets/turning_centre/x_displacement_down.csv";
  config.components = {component};
  return study_setup::PlanStudy(config);
}

TEST(LongRun, IsAnnouncedWithTheModelsThatAreFast) {
  const study_setup::StudyPlan plan =
      PlanOf({"mean", "poly:eq8", "net:scg:hidden=90:iterations=100000"});
  EXPECT_THAT(LongRunLines(plan, 2, false),
              ElementsAre(AllOf(StartsWith("this takes about "),
                                HasSubstr(" min on 2 jobs")),
                          AllOf(StartsWith("about a second without"),
                                HasSubstr("--models mean,poly:eq8,"))));
}

TEST(LongRun, NamesNoOtherModelsThanThoseAskedFor) {
  const study_setup::StudyPlan plan =
      PlanOf({"mean", "net:scg:hidden=90:iterations=100000"});
  EXPECT_THAT(LongRunLines(plan, 1, true), SizeIs(1));
}

TEST(LongRun, IsNoShortOne) {
  EXPECT_THAT(LongRunLines(PlanOf({"mean", "poly:eq8"}), 1, false), IsEmpty());
}

TEST(RoughTime, IsThatOfTheFits) {
  // 1190 rows of 41 columns: 7 s on one core in all, 4 of them for the nets.
  const std::string text = PlanText(PlanOf({}), 1, "");
  EXPECT_THAT(text, Not(HasSubstr(" min on 1 job")));
  EXPECT_THAT(text, HasSubstr(" s on 1 job"));
}

}  // namespace
}  // namespace errmap::cli
