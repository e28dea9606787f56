// Maps compared as they are after re-zeroing, or after probes of a session.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/commands/promise_days.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class RezeroedMaps : public CliPromise {};

TEST_F(RezeroedMaps, ComparesMapsThatAreRezeroed) {
  const std::vector<std::string> words = {"compare",
                                          "train.csv",
                                          "--models",
                                          "zero,poly:full:degree=2",
                                          "--rezero",
                                          "15min:noise=0.01um",
                                          "--quiet"};
  std::vector<std::string> as_json = words;
  as_json.insert(as_json.end(), {"--format", "json"});
  const Json record = RunJson(as_json);
  const Json component = record["components"][0];
  const Json& rezero = component["rezero"];
  EXPECT_EQ(rezero["interval"], 900.0);
  EXPECT_NEAR(rezero["noise"].get<double>(), 0.01, 1e-12);
  EXPECT_EQ(record["provenance"]["configuration"]["rezero"],
            "15min:noise=0.01um");
  // Of what this map leaves, each day has an offset of its own.
  const Json& map = rezero["models"][1];
  EXPECT_EQ(map["model"], "poly:full:degree=2");
  EXPECT_LT(map["rmse"], 0.8 * map["never"].get<double>()) << map;
  EXPECT_LT(map["rmse"], rezero["no_map"]);
  EXPECT_NEAR(component["recommendation"]["rmse"].get<double>(),
              map["rmse"].get<double>(),
              1e-9);
  const std::string text = OneLine(Run(words).out);
  EXPECT_THAT(text,
              AllOf(HasSubstr("re-zeroed every 15 min"),
                    HasSubstr("; without re-zeroing "),
                    HasSubstr("no re-zero")));
}

TEST_F(RezeroedMaps, RefusesToRezeroWithoutTimesOrRows) {
  const auto refusal = [&](const char* file, const char* rule, int status) {
    return RefusalOf(
        Run({"compare", file, "--models", "mean", "--rezero", rule, "--quiet"}),
        status);
  };
  EXPECT_THAT(refusal("train.csv", "2x", kWrongCommandLine),
              HasSubstr("--rezero must be an interval such as 2h"));
  EXPECT_THAT(refusal("train.csv", "1s", kUnusable),
              HasSubstr("leaves no row of a fold"));
  Write("bare.csv",
        "day,position_mm,error_mm\n1,1,1\n1,2,3\n1,3,2\n2,1,2\n2,2,1\n2,3,2"
        "\n3,1,5\n3,3,2\n3,4,1\n");
  EXPECT_THAT(refusal("bare.csv", "2h", kUnusable),
              HasSubstr("name their column with --time"));
}

}  // namespace
}  // namespace errmap
