#include "cli/report/report.h"

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "data/input_error.h"
#include "data/measurements/dataset.h"
#include "models/comparison/compare.h"
#include "models/record_json.h"
#include "tests/places.h"

namespace errmap::report {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

models::StudyRecord SmallRecord() {
  return MakeRecord(
      {models::CompareMaps(
          tests::SourceDir() + "/data/sets/nistir5367_xdisp_down.csv",
          {},
          {.models = {"mean", "poly:eq8"}, .seed = 7})},
      7);
}

TEST(Report, DrawsTheSameOfARecordThatWasReadAgain) {
  const models::StudyRecord record = SmallRecord();
  EXPECT_EQ(record.schema, models::kResultsSchema);
  EXPECT_EQ(record.seed, 7U);
  EXPECT_EQ(record.provenance.inputs.size(), 1U);
  EXPECT_THAT(record.provenance.compiler, HasSubstr("++"));
  const models::StudyRecord again =
      models::FromJsonText(models::ToJsonText(record));
  EXPECT_EQ(ReportHtml(again), ReportHtml(record));
  EXPECT_EQ(ReportMarkdown(again), ReportMarkdown(record));
  EXPECT_EQ(ScreenText(again, 100), ScreenText(record, 100));
  EXPECT_EQ(TableText(again, "csv"), TableText(record, "csv"));
  EXPECT_EQ(TableText(again, "md"), TableText(record, "md"));
}

TEST(Report, BeginsTheScreenWithTheVerdict) {
  const models::StudyRecord record = SmallRecord();
  const std::string verdict = VerdictText(record.components[0], 100);
  EXPECT_THAT(verdict, HasSubstr("poly:"));
  EXPECT_THAT(ScreenText(record, 100), HasSubstr("\n" + verdict + "\n"));
  EXPECT_THAT(*TableText(record, "csv"), HasSubstr("groups:5,poly:eq8"));
}

TEST(Report, SaysWhyNothingIsRecommended) {
  models::ComponentRecord nothing;
  nothing.data.rows = 60;
  EXPECT_THAT(VerdictText(nothing), HasSubstr("none could be judged"));
  nothing.interrupted = true;
  EXPECT_THAT(VerdictText(nothing), HasSubstr("interrupted"));
}

// Days, cycles, hold-outs of three kinds and maps of every kind.
models::StudyRecord RichRecord() {
  std::string text = "day,cycle,position_mm,t1_degC,error_um\n";
  int row = 0;
  for (int day = 1; day <= 4; ++day) {
    for (int cycle = 1; cycle <= 3; ++cycle) {
      for (int x = 0; x < 4; ++x, ++row) {
        const double t = 20.0 + day * 0.3 + cycle + 0.1 * ((row * 7) % 5);
        text += fmt::format("{},{},{},{:.2f},{:.3f}\n",
                            day,
                            cycle,
                            100 * x,
                            t,
                            x + 0.7 * t + 0.2 * ((row * 11) % 7));
      }
    }
  }
  const data::Dataset dataset =
      data::MakeDataset(data::ParseCsv(text, "days.csv"), {}).dataset;
  return MakeRecord(
      {models::CompareMaps(dataset,
                           {.holdouts = {"every:3", "sessions:4", "forward:2"},
                            .models = {"mean",
                                       "poly:position",
                                       "poly:ridge:view=auto",
                                       "net:scg:hidden=2:iterations=9",
                                       "blend"},
                            .goal = 1.0})},
      1);
}

// Whatever it says, it is drawn or refused.
void DrawOrRefuse(const std::string& text) {
  try {
    const models::StudyRecord record = models::FromJsonText(text);
    ReportHtml(record);
    ReportMarkdown(record);
    ScreenText(record, 100);
    TableText(record, "csv");
  } catch (const data::InputError&) {
  }
}

// "/components/0/models/3/name" becomes "/components/*/models/*/name".
std::string KindOfPlace(const std::string& path) {
  std::string kind;
  std::size_t begin = 0;
  while (begin < path.size()) {
    const std::size_t end = std::min(path.find('/', begin + 1), path.size());
    const std::string part = path.substr(begin, end - begin);
    kind += part.find_first_not_of("/0123456789") == part.npos ? "/*" : part;
    begin = end;
  }
  return kind;
}

// Every value with its place, containers too.
void ForPlaces(const models::RecordJson& json,
               const std::string& path,
               const std::function<void(const std::string&,
                                        const models::RecordJson&)>& visit) {
  if (!path.empty()) visit(path, json);
  if (!json.is_structured()) return;
  for (const auto& [key, value] : json.items()) {
    std::string escaped;
    for (const char c : key) {
      escaped += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    }
    ForPlaces(value, path + "/" + escaped, visit);
  }
}

TEST(Report, DrawsOrRefusesARecordWithAnyValueMissingOrOdd) {
  using models::RecordJson;
  const RecordJson whole = RecordJson::parse(models::ToJsonText(RichRecord()));
  std::map<std::string, int> tried;
  std::vector<std::string> places;
  ForPlaces(whole, "", [&](const std::string& path, const RecordJson&) {
    // The last of a kind is as good as the first.
    if (tried[KindOfPlace(path)]++ < 1) places.push_back(path);
  });
  EXPECT_GT(places.size(), 300U);
  // Each place without its value and, in turn, with one of these.
  const std::vector<RecordJson> odd = {RecordJson(),
                                       "odd",
                                       RecordJson::array(),
                                       RecordJson::object(),
                                       -1,
                                       1000000};
  std::size_t turn = 0;
  for (const std::string& place : places) {
    SCOPED_TRACE(place);
    const RecordJson::json_pointer at(place);
    RecordJson changed = whole;
    RecordJson& around = changed[at.parent_pointer()];
    if (around.is_array()) {
      around.erase(std::stoul(at.back()));
    } else {
      around.erase(at.back());
    }
    DrawOrRefuse(changed.dump());
    changed = whole;
    changed[at] = whole[at].is_number()  ? odd[turn++ % odd.size()]
                  : whole[at].is_array() ? odd[2]
                                         : odd[turn++ % 4];
    DrawOrRefuse(changed.dump());
  }
}

TEST(Report, NamesTheKeyWhoseValueIsOfAnotherType) {
  using models::RecordJson;
  const RecordJson whole = RecordJson::parse(models::ToJsonText(SmallRecord()));
  const auto refusal = [&](const char* place, const RecordJson& value) {
    RecordJson changed = whole;
    changed[RecordJson::json_pointer(place)] = value;
    try {
      models::FromJsonText(changed.dump());
      return std::string("read");
    } catch (const data::InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_THAT(refusal("/components/0/models/1/name", 5),
              StartsWith("components[0].models[1].name is not what"));
  EXPECT_THAT(refusal("/components/0/recommendation/goal_standing", "odd"),
              StartsWith("components[0].recommendation.goal_standing is"));
  EXPECT_THAT(refusal("/components", 5), StartsWith("components is not what"));
  EXPECT_THAT(refusal("/components/0/recommendation/goal_standing", "odd"),
              HasSubstr("errmap compare"));
  EXPECT_EQ(refusal("/components/0/models/0/predict_ns", RecordJson()), "read");
}

}  // namespace
}  // namespace errmap::report
