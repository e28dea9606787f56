#include "cli/report/plot.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "cli/report/wrap_text.h"

namespace errmap::report {
std::string Axis::Label() const {
  return names.empty() ? WithUnit(quantity, unit) : quantity;
}

double ColourLow(const Plot& plot) {
  return plot.colour.low == 0.0 ? 0.0 : -plot.colour.high;
}

bool IsShown(const Plot& plot, const Series& series, std::size_t point) {
  // Differences of larger ones overflow.
  constexpr double kLargest = 1e300;
  return std::all_of(series.columns.begin(),
                     series.columns.end(),
                     [&](const auto& column) {
                       return std::abs(column[point]) < kLargest;
                     }) &&
         (!plot.x.logarithmic || series.columns[0][point] > 0.0) &&
         (!plot.y.logarithmic || series.columns[1][point] > 0.0);
}

bool HasPoints(const Plot& plot) {
  for (const Series& series : plot.series) {
    assert(series.columns.size() == NumColumns(series.mark));
    for (std::size_t i = 0; i < series.columns.front().size(); ++i) {
      if (IsShown(plot, series, i)) return true;
    }
  }
  return false;
}

std::string WithUnit(std::string_view what, std::string_view unit) {
  std::string text(what);
  if (!unit.empty()) text.append(" (").append(unit).append(")");
  return text;
}

std::string Shortened(const std::string& text, std::size_t most) {
  return Squeezed(text, most, "…");
}

}  // namespace errmap::report
