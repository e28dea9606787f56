#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace errmap::report {

/// The marks of a series, and the columns that each needs.
enum class Mark {
  kPoints,  // x, y
  kLine,    // x, y
  kBars,    // x, y, width: from 0 to y
  kSpan,    // x, y, low, high: along x
  kBand,    // x, low, high: the area between them
  kCells,   // x, y, half width, half height, value: a map in colours
};

constexpr std::size_t NumColumns(Mark mark) {
  switch (mark) {
    case Mark::kPoints:
    case Mark::kLine:
      return 2;
    case Mark::kBars:
    case Mark::kBand:
      return 3;
    case Mark::kSpan:
      return 4;
    case Mark::kCells:
      return 5;
  }
  return 0;
}

enum class Shape { kDot, kCircle, kSquare, kDiamond };

/// One series of a plot.
struct Series {
  std::string label = {};  // "": not in the legend
  Mark mark = Mark::kPoints;
  /// (columns x n) equal lengths. A point with a value that is not finite is
  /// left out, and interrupts a line.
  std::vector<std::vector<double>> columns =
      std::vector<std::vector<double>>(NumColumns(mark));
  std::string colour = "#0072B2";  // #rrggbb
  double size = 1.0;  // of points in diameters of 4.4 px, of lines in pixels
  Shape shape = Shape::kDot;
  bool dashed = false;
  bool on_top = false;  // drawn after the others, in the legend as listed
  /// The tooltip of each point or bar; or empty.
  std::vector<std::string> hints = {};

  /// Adds a point: a value for each column.
  void Add(std::initializer_list<double> point) {
    auto column = columns.begin();
    for (const double value : point) (column++)->push_back(value);
  }
};

constexpr double kAutomatic = std::numeric_limits<double>::quiet_NaN();

/// A quantity and the range shown. The given ends are used unless data lie
/// beyond them; low > high reverses the axis.
struct Axis {
  std::string quantity = {};
  std::string unit = {};  // "": none
  bool logarithmic = false;
  double low = kAutomatic;
  double high = kAutomatic;
  /// Names at positions instead of numbers: the axis has categories, no unit.
  std::vector<std::pair<std::string, double>> names = {};

  /// "residual (µm)"; only the quantity for categories or without a unit.
  std::string Label() const;
};

/// One plot as plain data.
struct Plot {
  std::string name;  // for files and ids: only a-z, 0-9 and '-'
  int width = 390;   // pixels; 72 make an inch on paper
  int height = 260;  // without the legend
  Axis x;
  Axis y;
  /// For the values of kCells, from -high to high; from 0 if low is 0.
  Axis colour;
  std::vector<Series> series;
};

/// Colours of cells from the lowest value (0) to the highest (1): blue, white,
/// vermillion. They are distinguishable with every kind of colour vision; in
/// grey print, they show size, not sign.
constexpr std::array<std::pair<double, std::string_view>, 5> kPalette = {
    {{0.0, "#004B7A"},
     {0.2, "#56B4E9"},
     {0.5, "#F7F7F7"},
     {0.8, "#E69F00"},
     {1.0, "#8C2D04"}}};

/// Returns the low end of the plot's colours: minus their high end, or 0.
double ColourLow(const Plot& plot);

/// True if the plot can show this point of the series: finite, and positive on
/// a logarithmic axis.
bool IsShown(const Plot& plot, const Series& series, std::size_t point);

/// True if there is anything to draw.
bool HasPoints(const Plot& plot);

/// "residual (µm)"; without a unit only the quantity.
std::string WithUnit(std::string_view what, std::string_view unit);

/// Cuts to `most` characters (not bytes); "…" replaces the middle.
std::string Shortened(const std::string& text, std::size_t most);

}  // namespace errmap::report
