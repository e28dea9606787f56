#include "cli/report/figures/figures.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/figures/held_out_rows.h"
#include "tests/cli/report/report_document.h"

namespace errmap::report {
namespace {

using ::testing::HasSubstr;

const Figure* FigureNamed(const FigureSet& set, const std::string& name) {
  for (const ComponentFigures& component : set.components) {
    for (const Figure& figure : component.figures) {
      if (figure.plot.name == name) return &figure;
    }
  }
  return nullptr;
}

TEST(MakeFigures, MakesEveryFigureOfTheReport) {
  const FigureSet set = MakeFigures(Recorded(MakeReportDocument()));
  for (const char* name : {"c1-gap",
                           "c1-time",
                           "c1-compensation",
                           "c1-units",
                           "c1-cost",
                           "c1-surface-measured",
                           "c1-surface-mapped",
                           "c1-surface-left",
                           "c1-both",
                           "c1-best-predicted",
                           "c1-best-position",
                           "c1-best-group",
                           "c1-best-map",
                           "c1-best-histogram",
                           "c1-best-normal",
                           "c1-best-input-2",
                           "c1-training-1"}) {
    const Figure* figure = FigureNamed(set, name);
    ASSERT_NE(figure, nullptr) << name;
    EXPECT_EQ(figure->missing, "") << name;
  }
}

TEST(MakeFigures, AreAtMostTwentyOfAComponent) {
  DocumentSpec spec;
  spec.models.emplace_back("poly:eq9");
  EXPECT_LE(MakeFigures(Recorded(MakeReportDocument(spec)))
                .components[0]
                .figures.size(),
            20U);
}

TEST(MakeFigures, GivesEveryAxisAUnitAndEveryFigureAlternativeText) {
  const FigureSet set = MakeFigures(Recorded(MakeReportDocument()));
  std::set<std::string> names;
  for (const Figure& figure : set.components.at(0).figures) {
    EXPECT_TRUE(names.insert(figure.plot.name).second) << figure.plot.name;
    EXPECT_GT(figure.description.size(), 20U) << figure.plot.name;
    EXPECT_EQ(figure.description.find("nan"), std::string::npos)
        << figure.description;
    for (const Axis* axis : {&figure.plot.x, &figure.plot.y}) {
      EXPECT_NE(axis->quantity, "") << figure.plot.name;
    }
  }
}

TEST(MakeFigures, ShowsWhatAMapWouldBeWithoutASensor) {
  models::StudyRecord record = Recorded(MakeReportDocument());
  EXPECT_EQ(FigureNamed(MakeFigures(record), "c1-importance"), nullptr);
  record.components[0].recommendation->importance = models::SensorImportance{
      .rows = 60,
      .rmse = 0.001,
      .alike = 0.9,
      .one_by_one = {{{"t3"}, 0.0013}, {{"t1"}, 0.0011}},
      .together = {{{"t1", "t3"}, 0.004}}};
  const FigureSet set = MakeFigures(record);
  const Figure* figure = FigureNamed(set, "c1-importance");
  ASSERT_NE(figure, nullptr);
  EXPECT_THAT(figure->description,
              HasSubstr("with every sensor; without t1, t3 "));
  std::vector<std::string> names;
  for (const auto& [name, place] : figure->plot.y.names) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"all 2 sensors", "t3", "t1"}));
}

TEST(MakeFigures, ShowsLengthsInMicrometres) {
  const FigureSet set = MakeFigures(Recorded(MakeReportDocument()));
  const Figure* figure = FigureNamed(set, "c1-best-predicted");
  ASSERT_NE(figure, nullptr);
  EXPECT_EQ(figure->plot.y.Label(), "predicted error, µm");
  const Json document = MakeReportDocument();
  const double first =
      document["components"][0]["figures"]["tables"][0]["target"][0]
          .get<double>();
  EXPECT_DOUBLE_EQ(figure->plot.series.back().columns[0][0], first * 1000.0);
}

TEST(MakeFigures, DrawsWhatAResidualIs) {
  const models::StudyRecord record = Recorded(MakeReportDocument());
  const ReportView view = ViewOf(record.components[0]);
  const HeldOutRows rows = HeldOutRowsOf(view, "net:scg", "every:3");
  // Every third row is held out.
  ASSERT_EQ(rows.residual.size(), 20U);
  for (std::size_t i = 0; i < rows.residual.size(); ++i) {
    EXPECT_DOUBLE_EQ(rows.row[i], 3.0 * static_cast<double>(i) + 2.0);
    EXPECT_NEAR(rows.residual[i], rows.target[i] - rows.predicted[i], 1e-12);
  }
}

TEST(MakeFigures, ShowsSurfacesOnOneScale) {
  const FigureSet set = MakeFigures(Recorded(MakeReportDocument()));
  const double high = FigureNamed(set, "c1-surface-measured")->plot.colour.high;
  EXPECT_EQ(FigureNamed(set, "c1-surface-mapped")->plot.colour.high, high);
  // What is left has a scale of its own: the whole error's leaves it blank.
  const Plot& left = FigureNamed(set, "c1-surface-left")->plot;
  double largest = 0.0;
  for (const double value : left.series.front().columns[4]) {
    largest = std::max(largest, std::abs(value));
  }
  EXPECT_DOUBLE_EQ(left.colour.high, largest);
}

TEST(MakeFigures, DrawsNoBarsTooThinToBeSeen) {
  DocumentSpec spec;
  const auto units = [&](std::size_t groups) {
    spec.groups = groups;
    spec.rows = 2 * groups;
    return FigureNamed(MakeFigures(Recorded(MakeReportDocument(spec))),
                       "c1-units")
        ->plot;
  };
  EXPECT_EQ(units(6).series.size(), 3U);
  const Plot some = units(70);
  EXPECT_EQ(some.series.size(), 1U);
  EXPECT_EQ(some.series.front().mark, Mark::kBars);
  EXPECT_EQ(units(300).series.front().mark, Mark::kLine);
}

TEST(MakeFigures, MarksRowsOutsideTheTrainedRange) {
  const FigureSet set = MakeFigures(Recorded(MakeReportDocument()));
  const Figure* figure = FigureNamed(set, "c1-time");
  ASSERT_NE(figure, nullptr);
  EXPECT_EQ(figure->plot.series.front().label, "outside the trained range");
  EXPECT_EQ(figure->plot.series.front().columns[0].size(), 2U);
  EXPECT_THAT(figure->note, HasSubstr("Of 60 rows 2 lie outside"));
}

TEST(MakeFigures, PartsSessions) {
  Json document = MakeReportDocument();
  Json& table = document["components"][0]["figures"]["tables"][0];
  table["session_labels"] = {"Monday", "Tuesday"};
  table["sessions"] = Json::array();
  for (int i = 0; i < 60; ++i) table["sessions"].push_back(i / 30);
  const FigureSet set = MakeFigures(Recorded(document));
  EXPECT_EQ(FigureNamed(set, "c1-time")->plot.series.front().label,
            "a session begins");
}

TEST(MakeFigures, LeavesOutWhatTheMapHasNoSensorsFor) {
  Json document = MakeReportDocument();
  document["components"][0]["recommendation"]["sensors"] = Json::array();
  const FigureSet set = MakeFigures(Recorded(document));
  EXPECT_EQ(FigureNamed(set, "c1-surface-measured"), nullptr);
  EXPECT_NE(FigureNamed(set, "c1-time"), nullptr);
}

TEST(MakeFigures, SaysWhatIsNotThere) {
  Json document = MakeReportDocument();
  document["components"][0].erase("figures");
  const FigureSet set = MakeFigures(Recorded(document));
  const Figure* histogram = FigureNamed(set, "c1-best-histogram");
  ASSERT_NE(histogram, nullptr);
  EXPECT_THAT(histogram->missing, HasSubstr("no rows for figures"));
  EXPECT_EQ(FigureNamed(set, "c1-gap")->missing, "");
}

TEST(MakeFigures, NeedsNoGroupsAndNoPosition) {
  Json document = MakeReportDocument();
  Json& figures = document["components"][0]["figures"];
  figures["position"] = nullptr;
  figures["group"] = nullptr;
  figures["tables"][0]["groups"] = Json::array();
  const FigureSet set = MakeFigures(Recorded(document));
  EXPECT_THAT(FigureNamed(set, "c1-best-position")->missing,
              HasSubstr("no position"));
  EXPECT_THAT(FigureNamed(set, "c1-best-group")->missing,
              HasSubstr("no groups"));
  EXPECT_EQ(FigureNamed(set, "c1-best-histogram")->missing, "");
}

TEST(MakeFigures, DrawsNothingOfEqualOrOfTooFewResiduals) {
  DocumentSpec spec;
  spec.rows = 4;
  spec.groups = 2;
  const FigureSet few = MakeFigures(Recorded(MakeReportDocument(spec)));
  EXPECT_THAT(FigureNamed(few, "c1-best-normal")->missing,
              HasSubstr("Too few"));
  Json document = MakeReportDocument();
  Json& figures = document["components"][0]["figures"];
  figures["holdouts"][1]["predictions"]["poly:eq8"] =
      figures["tables"][0]["target"];
  const FigureSet equal = MakeFigures(Recorded(document));
  EXPECT_THAT(FigureNamed(equal, "c1-best-normal")->missing,
              HasSubstr("equal"));
}

TEST(MakeFigures, SurvivesNullsEverywhere) {
  Json document = MakeReportDocument();
  Json flat = document.flatten();
  for (const auto& [path, value] : flat.items()) {
    Json changed = document;
    changed[Json::json_pointer(path)] = nullptr;
    EXPECT_EQ(MakeFigures(Recorded(changed)).components.size(), 1U) << path;
    // The rows come last, and all alike.
    if (path.find("/figures/") != std::string::npos) break;
  }
  for (const Json& odd : {Json(), Json(3), Json::array({1}), Json::object()}) {
    EXPECT_TRUE(MakeFigures(Recorded(odd)).components.empty());
  }
}

TEST(MakeFigures, DrawsLessOfManyComponents) {
  DocumentSpec spec;
  spec.components = 7;
  const FigureSet seven = MakeFigures(Recorded(MakeReportDocument(spec)));
  EXPECT_EQ(seven.components[0].detail, FigureDetail::kBrief);
  EXPECT_EQ(seven.components[6].figures.size(), 3U);
}

TEST(FigureSvg, DrawsEachWithIdsOfItsOwnTitleAndDescription) {
  const FigureSet set = MakeFigures(Recorded(MakeReportDocument()));
  std::set<std::string> ids;
  const std::regex id(" id=\"([^\"]*)\"");
  for (const Figure& figure : set.components[0].figures) {
    if (!figure.missing.empty()) continue;
    const std::string svg = FigureSvg(figure);
    EXPECT_TRUE(svg.starts_with("<svg ")) << figure.plot.name;
    EXPECT_THAT(svg, HasSubstr("role=\"img\""));
    EXPECT_THAT(svg, HasSubstr("<title "));
    EXPECT_THAT(svg, HasSubstr("<desc "));
    EXPECT_EQ(svg.find("href"), std::string::npos);
    for (auto found = std::sregex_iterator(svg.begin(), svg.end(), id);
         found != std::sregex_iterator();
         ++found) {
      EXPECT_TRUE(ids.insert((*found)[1]).second) << (*found)[1];
    }
  }
}

TEST(MakeFigures, CountsAModelThatFailedAsAbsent) {
  Json document = MakeReportDocument();
  Json& component = document["components"][0];
  component["models"][2]["status"] = "failed";
  component["models"][2]["results"] = Json::object();
  component["figures"]["holdouts"][1]["predictions"].erase("net:scg");
  const models::StudyRecord record = Recorded(document);
  const ReportView view = ViewOf(record.components[0]);
  EXPECT_EQ(view.models.back()->name, "net:scg");
  EXPECT_TRUE(std::isnan(TestRmse(*view.models.back(), "groups:5")));
  EXPECT_EQ(FigureNamed(MakeFigures(Recorded(document)), "c1-gap")->missing,
            "");
}

TEST(Shortened, CutsTheMiddleAndNoCharacter) {
  EXPECT_EQ(Shortened("abcdef", 6), "abcdef");
  EXPECT_EQ(Shortened("abcdefgh", 5), "ab…gh");
  EXPECT_EQ(Shortened("µµµµµµµµ", 5), "µµ…µµ");
  EXPECT_EQ(Shortened("", 5), "");
}

}  // namespace
}  // namespace errmap::report
