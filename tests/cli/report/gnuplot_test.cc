#include "cli/report/gnuplot.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/svg.h"
#include "data/text.h"
#include "tests/cli/report_document.h"

namespace errmap::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kSeconds = 60.0;

bool HasGnuplot() { return std::system("command -v gnuplot >/dev/null") == 0; }

Plot SimplePlot(const std::string& name) {
  Plot plot;
  plot.name = name;
  plot.x.label = "position, mm";
  plot.y.label = "residual, µm";
  plot.series = {{.label = "points",
                  .mark = Mark::kPoints,
                  .columns = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}}};
  return plot;
}

// A name as it must stand in the SVG: one line, & and < as entities.
std::string AsSvgText(const std::string& name) {
  std::string text;
  for (const char c : data::AsUtf8(name)) {
    if (c == '&') {
      text += "&amp;";
    } else if (c == '<') {
      text += "&lt;";
    } else {
      text += c == '\n' ? ' ' : c;
    }
  }
  return text;
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

TEST_F(GnuplotTest, DrawsEveryPlotInOrder) {
  const Drawings drawn = DrawPlots(
      {SimplePlot("a"), SimplePlot("b")}, ImageFormat::kSvg, kSeconds);
  EXPECT_EQ(drawn.failure, "");
  ASSERT_EQ(drawn.drawings.size(), 2U);
  for (const Drawing& drawing : drawn.drawings) {
    EXPECT_EQ(drawing.failure, "");
    EXPECT_THAT(drawing.image, HasSubstr("residual, µm"));
    EXPECT_THAT(drawing.image, HasSubstr("</svg>"));
  }
}

TEST_F(GnuplotTest, DrawsTheSameBytesAgain) {
  const auto draw = [] {
    return DrawPlots({SimplePlot("a")}, ImageFormat::kSvg, kSeconds)
        .drawings[0]
        .image;
  };
  EXPECT_EQ(draw(), draw());
}

TEST_F(GnuplotTest, TellsWhichPlotIsRefusedAndDrawsTheOthers) {
  Plot broken = SimplePlot("b");
  broken.x.logarithmic = true;
  broken.x.low = -5.0;
  broken.x.high = -1.0;
  const Drawings drawn = DrawPlots(
      {SimplePlot("a"), broken, SimplePlot("c")}, ImageFormat::kSvg, kSeconds);
  EXPECT_EQ(drawn.failure, "");
  EXPECT_EQ(drawn.drawings[0].failure, "");
  EXPECT_THAT(drawn.drawings[1].failure, HasSubstr("gnuplot"));
  EXPECT_EQ(drawn.drawings[2].failure, "");
  EXPECT_THAT(drawn.drawings[2].image, HasSubstr("</svg>"));
}

TEST_F(GnuplotTest, ShowsHostileNamesAsTextAndRunsNothing) {
  for (const std::string& name : HostileNames()) {
    Plot plot = SimplePlot("a");
    plot.x.label = name;
    plot.y.label = name;
    plot.y.tics = {{name, 4.0}};
    plot.series[0].label = name;
    plot.series.push_back(
        {.mark = Mark::kCells, .columns = {{1.0}, {4.0}, {0.5}, {0.5}, {1.0}}});
    plot.colour_label = name;
    plot.colour_limit = 1.0;
    const Drawings drawn = DrawPlots({plot}, ImageFormat::kSvg, kSeconds);
    EXPECT_EQ(drawn.drawings[0].failure, "") << name;
    const std::string svg =
        CompactSvg(drawn.drawings[0].image, "role=\"img\"", "");
    // Every character is there, as gnuplot escapes it.
    EXPECT_THAT(drawn.drawings[0].image, HasSubstr(AsSvgText(name)));
    EXPECT_THAT(svg, Not(HasSubstr("<script"))) << svg;
    EXPECT_THAT(svg, Not(HasSubstr("<img"))) << svg;
    EXPECT_TRUE(std::filesystem::is_empty(folder_)) << name;
  }
}

TEST_F(GnuplotTest, ShowsAScriptTagAsText) {
  Plot plot = SimplePlot("a");
  plot.x.label = "<script>alert(1)</script>";
  const Drawings drawn = DrawPlots({plot}, ImageFormat::kSvg, kSeconds);
  EXPECT_THAT(CompactSvg(drawn.drawings[0].image, "", ""),
              HasSubstr(">&lt;script>alert(1)&lt;/script></text>"));
}

TEST_F(GnuplotTest, DrawsPdfAndPng) {
  const Drawings pdf =
      DrawPlots({SimplePlot("a")}, ImageFormat::kPdf, kSeconds);
  EXPECT_EQ(pdf.drawings[0].failure, "");
  EXPECT_TRUE(pdf.drawings[0].image.starts_with("%PDF"));
  const Drawings png =
      DrawPlots({SimplePlot("a")}, ImageFormat::kPng, kSeconds);
  EXPECT_EQ(png.drawings[0].failure, "");
  EXPECT_TRUE(png.drawings[0].image.starts_with("\x89PNG"));
}

TEST_F(GnuplotTest, StopsAfterItsTime) {
  const Drawings drawn =
      DrawPlots({SimplePlot("a"), SimplePlot("b")}, ImageFormat::kSvg, 0.0);
  EXPECT_THAT(drawn.drawings[0].failure, HasSubstr("too long"));
  EXPECT_THAT(drawn.drawings[1].failure, HasSubstr("too long"));
}

TEST(DrawPlots, SaysHowToInstallGnuplotWhereThereIsNone) {
  const char* const path = std::getenv("PATH");
  const std::string old = path != nullptr ? path : "";
  setenv("PATH", "/nonexistent", 1);
  const Drawings drawn =
      DrawPlots({SimplePlot("a")}, ImageFormat::kSvg, kSeconds);
  setenv("PATH", old.c_str(), 1);
  EXPECT_THAT(drawn.failure, HasSubstr("sudo apt-get install gnuplot-nox"));
  ASSERT_EQ(drawn.drawings.size(), 1U);
  EXPECT_EQ(drawn.drawings[0].failure, drawn.failure);
}

constexpr const char* kSvg =
    "<?xml version=\"1.0\"?><svg width='9' viewBox=\"0 0 100 50\">"
    "<title>Gnuplot</title><defs><path id='gpPt0' d='M-1,0'/></defs>"
    "<script>alert(1)</script>"
    "<g stroke-width=\"2.00\"><path stroke='rgb(  0, 114, 178)' "
    "d='M1.04,2.06 L1.01,2.08 L3,4 Z '/>"
    "<use xlink:href='#gpPt6' transform='translate(10.04,20) scale(2.25)' "
    "color='#D55E00'/><use xlink:href='#gpPt6' transform='translate(11,21) "
    "scale(2.25)' color='#D55E00'/>"
    "<g transform=\"translate(5,6) rotate(270)\" font-size=\"12.00\" "
    "text-anchor=\"end\"><text> a &lt;b></text></g></g></svg>";

TEST(CompactSvg, KeepsLinesPointsAndTextAndNothingElse) {
  const std::string svg = CompactSvg(kSvg, "role=\"img\"", "<title>t</title>");
  EXPECT_EQ(svg,
            "<svg viewBox=\"0 0 100 50\" width=\"100\" height=\"50\" "
            "role=\"img\"><title>t</title><path d=\"M1 2.1L3 4Z\" "
            "fill=\"none\" stroke=\"#0072b2\" stroke-width=\"2\"/><path "
            "d=\"M10 20h0M11 21h0\" fill=\"none\" stroke=\"#D55E00\" "
            "stroke-width=\"4.5\" stroke-linecap=\"round\"/><text x=\"5\" "
            "y=\"6\" font-size=\"12\" text-anchor=\"end\" "
            "transform=\"rotate(270 5 6)\">a &lt;b></text></svg>");
}

TEST(CompactSvg, RefusesWhatIsNoWholeSvg) {
  EXPECT_EQ(CompactSvg("", "", ""), "");
  EXPECT_EQ(CompactSvg("no picture", "", ""), "");
  const std::string half(kSvg);
  EXPECT_EQ(CompactSvg(half.substr(0, half.size() - 10), "", ""), "");
}

}  // namespace
}  // namespace errmap::cli
