#include "cli/report/figures/figures.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/figures/figure_parts.h"
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
                           "c1-temperatures",
                           "c1-time",
                           "c1-compensation",
                           "c1-clock",
                           "c1-units",
                           "c1-best-predicted",
                           "c1-best-position",
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
  EXPECT_EQ(figure->plot.y.Label(), "predicted error (µm)");
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

TEST(MakeFigures, DrawsNoBarsTooThinToBeSeen) {
  DocumentSpec spec;
  const auto units = [&](std::size_t groups) {
    spec.groups = groups;
    spec.rows = 2 * groups;
    return FigureNamed(MakeFigures(Recorded(MakeReportDocument(spec))),
                       "c1-units")
        ->plot;
  };
  const Plot some = units(70);
  EXPECT_EQ(some.series.front().mark, Mark::kBars);
  // The worst has a colour of its own.
  EXPECT_EQ(some.series.back().columns[0].size(), 1U);
  EXPECT_EQ(units(300).series.front().mark, Mark::kLine);
}

TEST(MakeFigures, SaysWhatDiffersOnTheWorstDay) {
  Json document = MakeReportDocument();
  Json& component = document["components"][0];
  Json& figures = component["figures"];
  Json& table = figures["tables"][0];
  const auto note = [&] {
    return FigureNamed(MakeFigures(Recorded(document)), "c1-units")->note;
  };
  const Json labels = component["holdouts"][1]["unit_labels"];
  component["models"][1]["results"]["groups:5"]["unit_rmse"] = {
      0.001, 0.001, 0.005, 0.001, 0.001, 0.001};
  EXPECT_THAT(note(),
              HasSubstr("Worst (orange): cycle " +
                        labels[2].get<std::string>() + ", 5.000 µm."));
  for (std::size_t row = 0; row < table["groups"].size(); ++row) {
    const bool worst = table["groups"][row] == 2;
    table["inputs"][1][row] =
        worst ? 30.0 : 20.0 + 0.1 * table["groups"][row].get<double>();
  }
  EXPECT_THAT(
      note(),
      HasSubstr(" There t12 is 30 on average, elsewhere 20 to 20.5 °C."));
}

TEST(MakeFigures, NamesSessionsAndPutsThemOneAfterAnother) {
  Json document = MakeReportDocument();
  Json& table = document["components"][0]["figures"]["tables"][0];
  table["session_labels"] = {"Monday", "Tuesday"};
  table["sessions"] = Json::array();
  table["time"] = Json::array();
  for (int i = 0; i < 60; ++i) {
    table["sessions"].push_back(i / 30);
    table["time"].push_back(3600.0 * (i + (i < 30 ? 0 : 1000)));
  }
  const FigureSet set = MakeFigures(Recorded(document));
  const Plot& plot = FigureNamed(set, "c1-time")->plot;
  ASSERT_EQ(plot.x.names.size(), 2U);
  EXPECT_EQ(plot.x.names[1].first, "Tuesday");
  // The night between them takes no room.
  EXPECT_DOUBLE_EQ(plot.series.back().columns[0].back(), 58.0);
}

TEST(MakeFigures, DrawsNoTemperaturesWithoutAThermometer) {
  Json document = MakeReportDocument();
  document["components"][0]["figures"]["inputs"][1]["unit"] = "bar";
  const FigureSet set = MakeFigures(Recorded(document));
  EXPECT_EQ(FigureNamed(set, "c1-temperatures"), nullptr);
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
  EXPECT_THAT(FigureNamed(set, "c1-best-map")->missing,
              HasSubstr("no position"));
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
