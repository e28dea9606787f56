#include "cli/report/figures/svg.h"

#include <cmath>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/report/report_document.h"

namespace errmap::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Plot SimplePlotInSvg() {
  Plot plot;
  plot.name = "c1-x";
  plot.x = {.quantity = "position", .unit = "mm"};
  plot.y = {.quantity = "residual", .unit = "µm"};
  plot.series = {{.columns = {{0.0, 5.0, 10.0}, {-1.0, 0.0, 1.0}}}};
  return plot;
}

// What stands at the horizontal axis: place and text, from left to right.
std::vector<std::pair<double, std::string>> TicsBelow(const std::string& svg) {
  std::vector<std::pair<double, std::string>> tics;
  const std::regex text(
      "<text x=\"([0-9.]+)\" y=\"[0-9.]+\" text-anchor=\"middle\">([^<]*)<");
  for (std::sregex_iterator at(svg.begin(), svg.end(), text), end; at != end;
       ++at) {
    tics.emplace_back(std::stod((*at)[1]), (*at)[2]);
  }
  tics.pop_back();  // the axis' label
  return tics;
}

std::vector<std::string> Texts(
    const std::vector<std::pair<double, std::string>>& tics) {
  std::vector<std::string> texts;
  for (const auto& tic : tics) texts.push_back(tic.second);
  return texts;
}

TEST(Svg, IsWholeWithTitleDescriptionAndBothAxesUnits) {
  const std::string svg = Svg(SimplePlotInSvg(), "a title", "what it shows");
  EXPECT_TRUE(svg.starts_with("<svg viewBox="));
  EXPECT_TRUE(svg.ends_with("</svg>"));
  EXPECT_EQ(SvgFile(svg),
            "<svg xmlns=\"http://www.w3.org/2000/svg\"" + svg.substr(4) + "\n");
  EXPECT_THAT(svg, HasSubstr("aria-labelledby=\"c1-x-t c1-x-d\""));
  EXPECT_THAT(svg, HasSubstr("<title id=\"c1-x-t\">a title</title>"));
  EXPECT_THAT(svg, HasSubstr("<desc id=\"c1-x-d\">what it shows</desc>"));
  EXPECT_THAT(svg, HasSubstr(">position (mm)</text>"));
  EXPECT_THAT(svg, HasSubstr(">residual (µm)</text>"));
}

TEST(Svg, PutsTicsAtRoundNumbersInProportion) {
  const auto tics = TicsBelow(Svg(SimplePlotInSvg(), "t", "d"));
  EXPECT_THAT(Texts(tics),
              ::testing::ElementsAre("0", "2", "4", "6", "8", "10"));
  for (std::size_t i = 1; i < tics.size(); ++i) {
    EXPECT_NEAR(tics[i].first - tics[i - 1].first,
                (tics.back().first - tics.front().first) / 5.0,
                0.11);
  }
}

TEST(Svg, WritesAsManyDigitsAsNeighboursNeed) {
  Plot plot = SimplePlotInSvg();
  plot.series[0].columns[0] = {20.0, 20.02, 20.05};
  EXPECT_THAT(Texts(TicsBelow(Svg(plot, "t", "d"))),
              ::testing::ElementsAre(
                  "20.00", "20.01", "20.02", "20.03", "20.04", "20.05"));
  plot.series[0].columns[0] = {-3e-8, 0.0, 3e-8};
  EXPECT_THAT(Texts(TicsBelow(Svg(plot, "t", "d"))),
              ::testing::ElementsAre("−2e-08", "0", "2e-08"));
  plot.series[0].columns[0] = {1.0e9, 1.0e9, 1.0e9 + 40.0};
  const auto large = Texts(TicsBelow(Svg(plot, "t", "d")));
  EXPECT_EQ(std::set<std::string>(large.begin(), large.end()).size(),
            large.size());
}

TEST(Svg, NamesOneTwoAndFiveOfEachDecadeAlongLogarithms) {
  Plot plot = SimplePlotInSvg();
  plot.x.logarithmic = true;
  plot.series[0].columns[0] = {0.0, 0.3, 15.0};
  EXPECT_THAT(Texts(TicsBelow(Svg(plot, "t", "d"))),
              ::testing::ElementsAre("0.5", "1", "2", "5", "10"));
  plot.series[0].columns[0] = {-1.0, 1e-9, 1e9};
  const auto tics = TicsBelow(Svg(plot, "t", "d"));
  EXPECT_GE(tics.size(), 3U);
  EXPECT_LE(tics.size(), 9U);
  plot.series[0].columns[0] = {1.2, 1.3, 1.7};
  EXPECT_GE(TicsBelow(Svg(plot, "t", "d")).size(), 2U);
}

TEST(Svg, LeavesRoomBetweenTicsWhateverTheirNumber) {
  for (const double range : {1e-12, 1e-5, 0.7, 3.0, 1234.0, 7.7e8, 1e299}) {
    Plot plot = SimplePlotInSvg();
    plot.width = 300;
    plot.series[0].columns[0] = {0.0, 0.5 * range, range};
    const auto tics = TicsBelow(Svg(plot, "t", "d"));
    EXPECT_GE(tics.size(), 2U) << range;
    for (std::size_t i = 1; i < tics.size(); ++i) {
      constexpr double kWidthOfADigit = 7.0;
      EXPECT_GT(tics[i].first - tics[i - 1].first,
                kWidthOfADigit * static_cast<double>(tics[i].second.size()))
          << range;
    }
  }
}

TEST(Svg, SlantsNamesWithoutRoomAndThenLeavesSomeOut) {
  Plot plot = SimplePlotInSvg();
  plot.x.names = {{"a", 0.0}, {"b", 10.0}};
  EXPECT_THAT(Svg(plot, "t", "d"), Not(HasSubstr("rotate(-45")));
  plot.x.names.clear();
  for (int i = 0; i < 100; ++i) {
    plot.x.names.emplace_back("thermocouple " + std::to_string(i), 0.1 * i);
  }
  const std::string svg = Svg(plot, "t", "d");
  EXPECT_THAT(svg, HasSubstr("rotate(-45"));
  EXPECT_THAT(svg, HasSubstr(">thermocouple 0<"));
  EXPECT_THAT(svg, Not(HasSubstr(">thermocouple 1<")));
}

TEST(Svg, LeavesOutWhatIsNotFiniteAndBreaksLinesThere) {
  Plot plot = SimplePlotInSvg();
  plot.series[0].mark = Mark::kLine;
  plot.series[0].columns = {{1.0, 2.0, 3.0, 4.0, 5.0},
                            {1.0, 2.0, std::nan(""), 4.0, HUGE_VAL}};
  const std::string svg = Svg(plot, "t", "d");
  const std::regex line(
      "<path d=\"M[0-9. ]+L[0-9. ]+M[0-9. ]+\" fill=\"none\"");
  EXPECT_TRUE(std::regex_search(svg, line)) << svg;
  EXPECT_FALSE(std::regex_search(svg, std::regex("nan|inf|NaN")));
}

TEST(Svg, DrawsPointsThatLieOnOneAnotherOnce) {
  Plot plot = SimplePlotInSvg();
  plot.series[0].columns = {std::vector<double>(1000, 1.0),
                            std::vector<double>(1000, 2.0)};
  EXPECT_LT(Svg(plot, "t", "d").size(), 3000U);
}

TEST(Svg, DrawsEveryMarkAndShape) {
  Plot plot = SimplePlotInSvg();
  plot.colour = {.quantity = "residual", .unit = "µm", .high = 1.0};
  plot.series = {
      {.label = "line",
       .mark = Mark::kLine,
       .columns = {{1.0, 2.0}, {1.0, 2.0}},
       .dashed = true},
      {.label = "bars", .mark = Mark::kBars, .columns = {{1.0}, {2.0}, {0.5}}},
      {.label = "span",
       .mark = Mark::kSpan,
       .columns = {{1.0}, {2.0}, {0.5}, {1.5}}},
      {.label = "cells",
       .mark = Mark::kCells,
       .columns = {
           {1.0, 1.0}, {4.0, 2.0}, {0.5, 0.5}, {0.5, 0.5}, {1.0, -1.0}}}};
  for (const Shape shape :
       {Shape::kDot, Shape::kCircle, Shape::kSquare, Shape::kDiamond}) {
    plot.series.push_back({.columns = {{1.0}, {1.0}}, .shape = shape});
  }
  const std::string svg = Svg(plot, "t", "d");
  for (const char* part : {"stroke-dasharray",
                           "fill-opacity",
                           "#004b7a",
                           "#8c2d04",
                           "linecap=\"round\"",
                           // A square is an area, which a printer keeps.
                           "Z\" fill=\"#0072B2\"",
                           "fill=\"#fff\" stroke=\"#0072B2\""}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
  EXPECT_THAT(svg, Not(HasSubstr("linecap=\"square\"")));
}

TEST(Svg, ShowsHostileNamesAsText) {
  for (const std::string& name : HostileNames()) {
    Plot plot = SimplePlotInSvg();
    plot.x.quantity = name;
    plot.y.names = {{name, 0.0}};
    plot.series[0].label = name;
    plot.colour = {.quantity = name, .high = 1.0};
    const std::string svg = Svg(plot, name, name);
    EXPECT_THAT(svg, Not(HasSubstr("<script"))) << svg;
    EXPECT_THAT(svg, Not(HasSubstr("<img"))) << svg;
    EXPECT_THAT(svg, Not(HasSubstr("\" onload"))) << svg;
    EXPECT_TRUE(svg.ends_with("</svg>"));
  }
}

TEST(Svg, IsEmptyOfNothing) {
  Plot plot = SimplePlotInSvg();
  plot.series[0].columns = {{}, {}};
  EXPECT_EQ(Svg(plot, "t", "d"), "");
}

}  // namespace
}  // namespace errmap::report
