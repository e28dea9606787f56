#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/report/plot.h"

namespace errmap::report {

/// A tic mark of an axis and its text.
struct Tic {
  double at = 0.0;
  std::string text;
};

/// Pixels along the axis that a tic's text needs.
using TicRoom = double (*)(const Tic&);

/// Lowest and highest value along an axis, including the extent of marks.
std::pair<double, double> Ends(const Plot& plot, bool along_x);

/// Maps the values of an axis to pixels from `from` to `to`.
class Scale {
 public:
  /// `ends` are the lowest and highest value that must be visible.
  Scale(const Axis& axis, std::pair<double, double> ends);

  void Span(double from, double to) {
    from_ = from;
    to_ = to;
  }
  double from() const { return from_; }
  double to() const { return to_; }

  double operator()(double value) const {
    return from_ + (Place(value) - low_) / (high_ - low_) * (to_ - from_);
  }

  /// Returns as many round numbers as fit.
  std::vector<Tic> Tics(TicRoom room) const;

  bool StandApart(const std::vector<Tic>& tics, TicRoom room) const;

 private:
  bool logarithmic_;
  double low_ = 0.0;
  double high_ = 1.0;
  double from_ = 0.0;
  double to_ = 1.0;

  double Place(double value) const;
  double Value(double place) const;
};

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
