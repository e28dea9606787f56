#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/report/figures/plot_scale.h"
#include "cli/report/plot.h"

namespace errmap::report {

// All in pixels:
inline constexpr double kTextSize = 12.0;
inline constexpr double kEdge = 6.0;   // free margin of the picture
inline constexpr double kApart = 8.0;  // between labels
inline constexpr double kTicLength = 4.0;
inline constexpr double kSwatch = 20.0;     // of a series in the legend
inline constexpr double kColourBar = 14.0;  // width of the colour bar

/// Estimates the width of a text in pixels, for any usual sans-serif font. It
/// overestimates rather than underestimates, since the reader's font is
/// unknown.
double TextWidth(std::string_view text);

/// Shortens the text to at most `most` pixels by cutting its middle.
std::string Fitting(const std::string& text, double most);

struct LegendEntry {
  const Series* series = nullptr;
  std::string label = {};
  double x = 0.0;
  double y = 0.0;
};

/// The positions of a picture's parts, in pixels from its upper left corner.
struct PlotLayout {
  Scale x;
  Scale y;
  double height = 0.0;   // of the picture, legend included
  bool slanted = false;  // the names along x
  std::vector<Tic> x_tics = {};
  std::vector<Tic> y_tics = {};
  std::vector<Tic> colour_tics = {};
  std::vector<LegendEntry> legend = {};
};

/// True if the picture has a colour bar at its right.
bool HasColours(const Plot& plot);

/// Computes the margins first, so that every label fits. The legend points at
/// the series of `plot`, which must outlive it.
PlotLayout LayOut(const Plot& plot);

}  // namespace errmap::report
