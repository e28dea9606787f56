#pragma once

#include <array>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace errmap::report {

/// How a series is drawn, and the columns that it needs.
enum class Mark {
  kPoints,  // x, y
  kLine,    // x, y
  kBars,    // x, y, width: from 0 to y
  kSpan,    // x, y, low, high: along x
  kBand,    // x, low, high: the area between them
  kCells,   // x, y, half width, half height, value: a map in colours
};

enum class Shape { kDot, kCircle, kSquare, kDiamond };

/// One series of a plot.
struct Series {
  std::string label = {};  // "": not in the legend
  Mark mark = Mark::kPoints;
  /// (columns x n) equal lengths; a point with a value that is not finite is
  /// left out, and breaks a line.
  std::vector<std::vector<double>> columns = {};
  std::string colour = "#0072B2";  // #rrggbb
  double size = 1.0;  // of points in diameters of 4.4 px, of lines in pixels
  Shape shape = Shape::kDot;
  bool dashed = false;
  /// What a browser says of each point or bar when pointed at; or empty.
  std::vector<std::string> hints = {};

  /// Adds a point: a value for each of its first columns.
  void Add(std::initializer_list<double> point) {
    auto column = columns.begin();
    for (const double value : point) (column++)->push_back(value);
  }
};

constexpr double kAutomatic = std::numeric_limits<double>::quiet_NaN();

/// A quantity and how much of it is shown. Ends that are given hold unless
/// data lie beyond them; low > high turns the axis round.
struct Axis {
  std::string quantity = {};
  std::string unit = {};  // "": none
  bool logarithmic = false;
  double low = kAutomatic;
  double high = kAutomatic;
  /// Names at places instead of numbers: the axis has categories, no unit.
  std::vector<std::pair<std::string, double>> names = {};

  /// "residual (µm)"; of categories, and without a unit, the quantity alone.
  std::string Label() const;
};

/// One plot as plain data.
struct Plot {
  std::string name;  // of its files and ids: a-z, 0-9 and '-' only
  int width = 390;   // pixels; 72 make an inch on paper
  int height = 260;  // without the legend
  Axis x;
  Axis y;
  /// Of the values of kCells, from -high to high; from 0 where low is 0.
  Axis colour;
  std::vector<Series> series;
};

/// Colours of cells from the lowest value (0) to the highest (1): blue, white,
/// vermillion; told apart in every kind of colour vision and, by depth, not by
/// sign, in grey print.
constexpr std::array<std::pair<double, std::string_view>, 5> kPalette = {
    {{0.0, "#004B7A"},
     {0.2, "#56B4E9"},
     {0.5, "#F7F7F7"},
     {0.8, "#E69F00"},
     {1.0, "#8C2D04"}}};

/// Where the plot's colours begin: at minus their high end, or at 0.
double ColourLow(const Plot& plot);

/// Whether the plot can show that point of the series: finite, and positive
/// along an axis with logarithms.
bool IsShown(const Plot& plot, const Series& series, std::size_t point);

/// Whether there is anything to draw. Throws std::invalid_argument where the
/// series has not the columns that its mark needs, or of different lengths.
bool HasPoints(const Plot& plot, const Series& series);
bool HasPoints(const Plot& plot);

/// "residual (µm)"; without a unit the quantity alone.
std::string WithUnit(std::string_view what, std::string_view unit);

/// At most `most` characters (not bytes), the middle replaced by "…".
std::string Shortened(std::string_view text, std::size_t most);

}  // namespace errmap::report
