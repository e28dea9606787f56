
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/machine/record/machine_record.h"
#include "cli/report/figures/svg.h"
#include "tests/numbers.h"

namespace errmap::machine {
namespace {

using report::Figure;
using report::Series;
using report::Svg;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// 0.03 mm before and 0.002 mm after in the first of three cells; nothing in the
// second, and the third has no figures.
MachineRecord Lathe() {
  MachineRecord machine;
  machine.name = "lathe";
  machine.unit = "mm";
  machine.sensitive = "XZ";
  machine.later = {"6", "7"};
  machine.plane = PlaneRecord{
      .across = "Z", .up = "X", .cell_width = 100.0, .cell_height = 50.0};
  for (const auto& [name, size] :
       {std::pair{"uncompensated", 0.03}, std::pair{"recommended", 0.002}}) {
    MachineChoiceRecord choice;
    choice.name = name;
    if (size < 0.03) choice.maps = {{.component = "x", .model = "mean"}};
    choice.points = 12;
    choice.cells = {{.across = 100,
                     .up = 200,
                     .points = 4,
                     .mean_across = 0.0,
                     .mean_up = -size,
                     .rms = size},
                    {.across = 200,
                     .up = 200,
                     .points = 4,
                     .mean_across = 0.0,
                     .mean_up = 0.0,
                     .rms = 0.0},
                    {.across = 300, .up = 250, .points = 4}};
    machine.choices.push_back(choice);
  }
  return machine;
}

const Figure& Named(const std::vector<Figure>& figures,
                    const std::string& name) {
  for (const Figure& figure : figures) {
    if (figure.plot.name == "machine-" + name) return figure;
  }
  throw std::runtime_error("no figure " + name);
}

const Series& Labelled(const Figure& figure, const std::string& label) {
  for (const Series& series : figure.plot.series) {
    if (series.label == label) return series;
  }
  throw std::runtime_error("no series " + label);
}

TEST(MachineFigures, ShareTheirScaleBeforeAndAfter) {
  const std::vector<Figure> figures = MachineFigures(Lathe());
  ASSERT_EQ(figures.size(), 6U);
  const Figure& before = Named(figures, "arrows-before");
  const Figure& after = Named(figures, "arrows-after");
  // 0.03 mm is one cell's height of 50 mm, so 20 um are 33.3 mm on both axes.
  const Series& scale = Labelled(before, "scale: 20 µm");
  EXPECT_NEAR(scale.columns[0][1] - scale.columns[0][0], 100.0 / 3.0, 1e-9);
  const Series& same = Labelled(after, "scale: 20 µm");
  EXPECT_EQ(same.columns[0][1], scale.columns[0][1]);
  EXPECT_NEAR(before.plot.series[1].columns[1][1] - 200.0, -50.0, 1e-9);
  EXPECT_NEAR(after.plot.series[1].columns[1][1] - 200.0, -50.0 / 15.0, 1e-9);
  EXPECT_EQ(before.plot.y.low, after.plot.y.low);
  EXPECT_EQ(before.plot.x.high, after.plot.x.high);
  EXPECT_EQ(Named(figures, "grid-before").plot.colour.high, 30.0);
  EXPECT_EQ(Named(figures, "grid-after").plot.colour.high, 30.0);
  EXPECT_EQ(Named(figures, "grid-after").plot.colour.low, 0.0);
  // What is left, on its own scale.
  EXPECT_NEAR(
      Named(figures, "arrows-left").plot.series[1].columns[1][1] - 200.0,
      -50.0,
      1e-9);
  EXPECT_NO_THROW(Labelled(Named(figures, "arrows-left"), "scale: 2 µm"));
  EXPECT_EQ(Named(figures, "grid-left").plot.colour.high, 2.0);
}

TEST(MachineFigures, TellNoErrorFromNoFigure) {
  const std::vector<Figure> figures = MachineFigures(Lathe());
  const Figure& arrows = Named(figures, "arrows-before");
  // A dot where the error is 0, no arrow; neither where it is not known.
  EXPECT_EQ(arrows.plot.series[0].columns[0], (std::vector<double>{100, 200}));
  // A shaft and two strokes of the head, with breaks.
  EXPECT_EQ(arrows.plot.series[1].columns[0].size(), 9U);
  const Figure& grid = Named(figures, "grid-before");
  EXPECT_TRUE(IsShown(grid.plot, grid.plot.series[0], 1));
  EXPECT_FALSE(IsShown(grid.plot, grid.plot.series[0], 2));
  EXPECT_THAT(grid.note, HasSubstr("Hatched: no pose was there."));
}

TEST(MachineFigures, HaveUnitsDaysAndAlternativeText) {
  for (const Figure& figure : MachineFigures(Lathe())) {
    EXPECT_EQ(figure.plot.x.Label(), "Z (mm)");
    EXPECT_EQ(figure.plot.y.Label(), "X (mm)");
    EXPECT_THAT(figure.note, HasSubstr("12 poses of sessions 6, 7"));
    EXPECT_THAT(figure.description,
                AllOf(HasSubstr("µm"), Not(HasSubstr("nan"))));
    EXPECT_THAT(Svg(figure.plot, figure.title, figure.description),
                HasSubstr("<desc id=\"" + figure.plot.name + "-d\">"));
  }
}

TEST(MachineFigures, ColoursBeginAtZero) {
  const std::vector<Figure> figures = MachineFigures(Lathe());
  const Figure& grid = Named(figures, "grid-before");
  const std::string svg = Svg(grid.plot, grid.title, grid.description);
  EXPECT_THAT(svg, AllOf(HasSubstr(">RMS (µm)</text>"), Not(HasSubstr(">−"))));
  // Of the palette's half with blue nothing is drawn.
  EXPECT_THAT(svg, Not(HasSubstr("#004b7a")));
  EXPECT_THAT(svg, HasSubstr("#8c2d04"));
}

TEST(MachineFigures, AreNoneWithoutAPlaneOrMaps) {
  MachineRecord line = Lathe();
  line.plane.reset();
  EXPECT_TRUE(MachineFigures(line).empty());
  MachineRecord bare = Lathe();
  bare.choices.pop_back();
  EXPECT_TRUE(MachineFigures(bare).empty());
  EXPECT_TRUE(MachineFigures({}).empty());
}

TEST(MachineAnswer, SaysTheWorstErrorItsAxisAndWhatMapsLeave) {
  MachineRecord machine = Lathe();
  machine.choices[0].max = 0.04;
  EXPECT_EQ(MachineAnswer(machine),
            "Without maps the tool is off by up to 40.0 um, mostly along X.");
  machine.choices[1].max = 0.004;
  EXPECT_EQ(MachineAnswer(machine),
            "Without maps the tool is off by up to 40.0 um, mostly along X. "
            "The recommended maps leave up to 4.0 um, 90 % less.");
  machine.choices[1].max = 0.05;
  EXPECT_THAT(MachineAnswer(machine), ::testing::HasSubstr("25 % more"));
}

// A results.json of somebody else's.
TEST(MachineFigures, StandWhatIsNotFinite) {
  MachineRecord machine = Lathe();
  machine.plane->cell_width = kNaN;
  machine.plane->cell_height = 0.0;
  machine.unit = "furlong";
  for (MachineChoiceRecord& choice : machine.choices) {
    choice.cells[0] = {.across = 1e308, .up = -1e308, .mean_up = 1e308};
  }
  for (const Figure& figure : MachineFigures(machine)) {
    EXPECT_NO_THROW(Svg(figure.plot, figure.title, figure.description));
  }
}

}  // namespace
}  // namespace errmap::machine
