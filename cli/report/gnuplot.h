#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace errmap::cli {

/// How a series is drawn, and the columns that it needs.
enum class Mark {
  kPoints,    // x, y
  kLine,      // x, y
  kSteps,     // x, y: a step down or up at x
  kBars,      // x, y, width
  kInterval,  // x, y, low, high: along y
  kSpan,      // x, y, low, high: along x
  kCells,     // x, y, half width, half height, value: a map in colours
};

enum class Shape { kDot, kCircle, kSquare, kDiamond };

/// One series of a plot.
struct Series {
  std::string label = {};  // "": not in the legend
  Mark mark = Mark::kPoints;
  /// (columns x n) equal lengths; a point with a value that is not finite is
  /// left out, and breaks a line.
  std::vector<std::vector<double>> columns = {};
  std::string colour = "#0072B2";
  double size = 1.0;  // of points in diameters, of lines in widths
  Shape shape = Shape::kDot;
  bool dashed = false;
};

constexpr double kAutomatic = std::numeric_limits<double>::quiet_NaN();

struct Axis {
  std::string label;  // with the unit
  bool logarithmic = false;
  double low = kAutomatic;
  double high = kAutomatic;
  /// Text at places instead of numbers.
  std::vector<std::pair<std::string, double>> tics;
  bool slanted_tics = false;
};

/// One plot as plain data.
struct Plot {
  std::string name;  // of its files: a-z, 0-9 and '-' only
  int width = 430;   // pixels; 72 make an inch on paper
  int height = 290;
  Axis x;
  Axis y;
  std::string colour_label;          // of the values of kCells
  double colour_limit = kAutomatic;  // colours from -limit to limit
  bool legend_below = false;         // else in the best corner
  std::vector<Series> series;
};

enum class ImageFormat { kSvg, kPdf, kPng };
/// "svg", "pdf", "png".
std::string_view ToString(ImageFormat format);

/// A text as a gnuplot string that means these characters and nothing else:
/// whatever gnuplot could read as a command, an escape or a substitution is
/// written as an octal escape; line breaks and control characters become
/// blanks. In labels of tics '%' is doubled, since they are formats.
std::string GnuplotString(std::string_view text);
std::string GnuplotTicString(std::string_view text);

/// A whole gnuplot script with its data, which writes `file` when it is run.
std::string PlotScript(const Plot& plot,
                       ImageFormat format,
                       std::string_view file);

/// An image, or in one line why there is none.
struct Drawing {
  std::string image;
  std::string failure;
};

/// What was drawn, one per plot; where gnuplot could not be run at all,
/// `failure` says why and what to do.
struct Drawings {
  std::vector<Drawing> drawings;
  std::string failure;
};

/// Draws the plots with one run of gnuplot (another after each plot that it
/// refuses), without a shell, without the user's settings, for at most
/// `seconds` in all.
Drawings DrawPlots(const std::vector<Plot>& plots,
                   ImageFormat format,
                   double seconds);

}  // namespace errmap::cli
