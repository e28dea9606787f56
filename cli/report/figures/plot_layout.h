#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/report/figures/plot_scale.h"
#include "cli/report/plot.h"

namespace errmap::report {

// In pixels:
inline constexpr double kTextSize = 12.0;
inline constexpr double kEdge = 6.0;   // free at the rim of the picture
inline constexpr double kApart = 8.0;  // between labels
inline constexpr double kTicLength = 4.0;
inline constexpr double kSwatch = 20.0;     // of a series in the legend
inline constexpr double kColourBar = 14.0;  // width of the scale of colours

/// Width in pixels of a text in any of the usual sans-serif fonts, rather too
/// wide than too narrow: nobody knows which one the reader has.
double TextWidth(std::string_view text);

/// The text, shortened in its middle until it is no wider than `most` pixels.
std::string Fitting(const std::string& text, double most);

struct LegendEntry {
  const Series* series = nullptr;
  std::string label = {};
  double x = 0.0;
  double y = 0.0;
};

/// Where the parts of a picture stand, in pixels from its upper left corner.
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

/// Whether the picture has a scale of colours at its right.
bool HasColours(const Plot& plot);

/// Margins first, so that every label finds its place. The legend points at
/// the series of `plot`, which has to outlive it.
PlotLayout LayOut(const Plot& plot);

}  // namespace errmap::report
