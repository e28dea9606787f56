#include "cli/report/figures/gnuplot.h"

#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/files/atomic_file.h"
#include "tests/cli/report/report_document.h"

namespace errmap::report {
namespace {

using ::testing::HasSubstr;

bool HasGnuplot() { return std::system("command -v gnuplot >/dev/null") == 0; }

Plot SimplePlot(const std::string& name) {
  Plot plot;
  plot.name = name;
  plot.x = {.quantity = "position", .unit = "mm"};
  plot.y = {.quantity = "residual", .unit = "µm"};
  plot.series = {{.label = "points",
                  .mark = Mark::kPoints,
                  .columns = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}}};
  return plot;
}

// A folder to work in, and out of it again.
class GnuplotTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!HasGnuplot()) GTEST_SKIP() << "gnuplot is not installed";
    old_ = std::filesystem::current_path();
    std::string name =
        (std::filesystem::temp_directory_path() / "gnuplot_test_XXXXXX")
            .string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    std::filesystem::current_path(folder_);
  }
  void TearDown() override {
    if (folder_.empty()) return;
    std::filesystem::current_path(old_);
    std::filesystem::remove_all(folder_);
  }

  // Runs the plot's script; the image, "" where gnuplot refuses it.
  static std::string Drawn(const Plot& plot, ImageFormat format) {
    data::WriteFileAtomically("script.gp", PlotScript(plot, format, "image"));
    if (std::system("LC_ALL=C.UTF-8 gnuplot -d script.gp >log 2>&1") != 0) {
      return "";
    }
    return data::ReadFile("image");
  }

  std::filesystem::path old_;
  std::filesystem::path folder_;
};

TEST(GnuplotString, WritesWhatCouldBeACommandAsOctalEscapes) {
  EXPECT_EQ(GnuplotString("a\"b`c'd\\e$f@g#h;i{j}"),
            "\"a\\042b\\140c\\047d\\134e\\044f\\100g\\043h\\073i\\173j\\175\"");
}

TEST(GnuplotString, KeepsDigitsApartFromTheEscapeBeforeThem) {
  EXPECT_EQ(GnuplotString("a'12b3"), "\"a\\047\\061\\062b3\"");
}

TEST(GnuplotString, TurnsLineBreaksIntoBlanksAndKeepsUtf8) {
  EXPECT_EQ(GnuplotString("µm\nx"), "\"µm x\"");
}

TEST(GnuplotString, LeavesNoHostileNameAWayOut) {
  for (const std::string& name : HostileNames()) {
    const std::string text = GnuplotString(name);
    EXPECT_EQ(text.find_first_of("`$@'\n;#{}", 1), std::string::npos) << text;
    EXPECT_EQ(text.find('"', 1), text.size() - 1) << text;
  }
}

TEST(GnuplotTicString, DoublesThePercentSignsOfFormats) {
  EXPECT_EQ(GnuplotTicString("50 %d"), "\"50 %%d\"");
}

TEST(PlotScript, HoldsTheDataAndTheUnitsOfBothAxes) {
  const std::string script =
      PlotScript(SimplePlot("c1-x"), ImageFormat::kPdf, "c1-x.pdf");
  EXPECT_THAT(script, HasSubstr("set xlabel \"position, mm\""));
  EXPECT_THAT(script, HasSubstr("set ylabel \"residual, µm\""));
  EXPECT_THAT(script, HasSubstr("$data0 << END\n1 4\n2 5\n3 6\nEND\n"));
  EXPECT_THAT(script, HasSubstr("set output \"c1-x.pdf\""));
  EXPECT_THAT(script, HasSubstr("pdfcairo"));
}

TEST(PlotScript, LeavesOutPointsThatAreNotFiniteAndBreaksLinesThere) {
  Plot plot = SimplePlot("a");
  plot.series[0].mark = Mark::kLine;
  plot.series[0].columns = {{1.0, 2.0, 3.0, 4.0},
                            {1.0, std::nan(""), HUGE_VAL, 4.0}};
  EXPECT_THAT(PlotScript(plot, ImageFormat::kSvg, "a.svg"),
              HasSubstr("<< END\n1 1\n\n4 4\nEND\n"));
}

TEST(PlotScript, RefusesColumnsOfDifferentLengths) {
  Plot plot = SimplePlot("a");
  plot.series[0].columns[1].pop_back();
  EXPECT_THROW(PlotScript(plot, ImageFormat::kSvg, "a.svg"),
               std::invalid_argument);
  plot.series[0].columns.pop_back();
  EXPECT_THROW(PlotScript(plot, ImageFormat::kSvg, "a.svg"),
               std::invalid_argument);
}

TEST_F(GnuplotTest, DrawsTheScriptInEveryFormat) {
  EXPECT_THAT(Drawn(SimplePlot("a"), ImageFormat::kSvg),
              HasSubstr("residual, µm"));
  EXPECT_TRUE(Drawn(SimplePlot("a"), ImageFormat::kPdf).starts_with("%PDF"));
  EXPECT_TRUE(Drawn(SimplePlot("a"), ImageFormat::kPng).starts_with("\x89PNG"));
}

TEST_F(GnuplotTest, DrawsEveryMark) {
  Plot plot = SimplePlot("a");
  plot.colour = {.quantity = "residual", .unit = "µm", .high = 1.0};
  plot.x.names = {{"first of them", 1.0}, {"second", 2.0}};
  plot.series = {
      {.mark = Mark::kLine, .columns = {{1.0, 2.0}, {1.0, 2.0}}},
      {.mark = Mark::kBars, .columns = {{1.0}, {2.0}, {0.5}}},
      {.mark = Mark::kSpan, .columns = {{1.0}, {2.0}, {0.5}, {1.5}}},
      {.mark = Mark::kCells, .columns = {{1.0}, {4.0}, {0.5}, {0.5}, {1.0}}}};
  EXPECT_THAT(Drawn(plot, ImageFormat::kSvg), HasSubstr("first of them"));
}

TEST_F(GnuplotTest, ShowsHostileNamesAsTextAndRunsNothing) {
  for (const std::string& name : HostileNames()) {
    Plot plot = SimplePlot("a");
    plot.x.quantity = name;
    plot.y.quantity = name;
    plot.y.names = {{name, 4.0}};
    plot.series[0].label = name;
    plot.series.push_back(
        {.mark = Mark::kCells, .columns = {{1.0}, {4.0}, {0.5}, {0.5}, {1.0}}});
    plot.colour = {.quantity = name, .high = 1.0};
    EXPECT_THAT(Drawn(plot, ImageFormat::kSvg), HasSubstr("</svg>")) << name;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      EXPECT_THAT(entry.path().filename().string(),
                  ::testing::AnyOf("script.gp", "image", "log"))
          << name;
    }
  }
}

}  // namespace
}  // namespace errmap::report
