#include "cli/report/figures/plot_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace errmap::report {
namespace {

// "−0.5", with as many digits as a step between neighbours needs.
std::string TicText(double value, double step, double largest) {
  constexpr double kManyDigits = 1e6;
  constexpr double kSmallStep = 0.99e-5;
  constexpr double kRounding = 1e-6;
  if (std::abs(value) < kRounding * step) value = 0.0;
  std::string text;
  if (largest >= kManyDigits || step < kSmallStep) {
    const int digits =
        1 + static_cast<int>(std::ceil(std::log10(largest / step) + kRounding));
    text = fmt::format("{:.{}g}", value, std::clamp(digits, 1, 15));
  } else {
    const int decimals = std::max(
        0, -static_cast<int>(std::floor(std::log10(step) + kRounding)));
    text = fmt::format("{:.{}f}", value, decimals);
  }
  if (text.starts_with('-')) text = "−" + text.substr(1);
  return text;
}

// At most `most` (>= 1) tics at round numbers from low to high.
std::vector<Tic> LinearTics(double low, double high, int most) {
  const double least = (high - low) / most;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10.0 * power;
  for (const double round : {5.0, 2.0, 1.0}) {
    if (round * power >= least) step = round * power;
  }
  constexpr double kRounding = 1e-9;
  const double first = std::ceil(low / step - kRounding);
  std::vector<Tic> tics;
  for (int i = 0; i <= most; ++i) {
    const double at = (first + i) * step;
    if (at > high + kRounding * step) break;
    tics.push_back(
        {at, TicText(at, step, std::max(std::abs(low), std::abs(high)))});
  }
  return tics;
}

// Tics at 1, 2 and 5 of each power of ten, or at powers alone; few decades
// without either have round numbers.
std::vector<Tic> LogarithmicTics(double low, double high, int most) {
  const auto from = static_cast<int>(std::floor(std::log10(low)));
  const auto to = static_cast<int>(std::ceil(std::log10(high)));
  std::vector<Tic> tics;
  for (int every = 0; every <= to - from; ++every) {
    tics.clear();
    for (int decade = from; decade <= to; decade += std::max(every, 1)) {
      for (const int step : {1, 2, 5}) {
        const double at = step * std::pow(10.0, decade);
        if (at < low || at > high || (every > 0 && step > 1)) continue;
        tics.push_back({at, fmt::format("{:.6g}", at)});
      }
    }
    if (static_cast<int>(tics.size()) <= most) break;
  }
  return tics.size() < 2 ? LinearTics(low, high, most) : tics;
}

}  // namespace

std::pair<double, double> Ends(const Plot& plot, bool along_x) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  const auto take = [&](double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const Series& series : plot.series) {
    const auto& columns = series.columns;
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
      if (!IsShown(plot, series, i)) continue;
      const double value = columns[along_x ? 0 : 1][i];
      double reach = 0.0;
      if (series.mark == Mark::kCells) reach = columns[along_x ? 2 : 3][i];
      if (series.mark == Mark::kBars && along_x) reach = 0.5 * columns[2][i];
      take(value - reach);
      take(value + reach);
      if (series.mark == Mark::kBars && !along_x) take(0.0);
      if (series.mark == Mark::kBand && !along_x) take(columns[2][i]);
      if (series.mark == Mark::kSpan && along_x) {
        take(columns[2][i]);
        take(columns[3][i]);
      }
    }
  }
  return low <= high ? std::pair{low, high} : std::pair{1.0, 2.0};
}

Scale::Scale(const Axis& axis, std::pair<double, double> ends)
    : logarithmic_(axis.logarithmic) {
  const bool turned = axis.low > axis.high;
  const double first = turned ? axis.high : axis.low;
  const double last = turned ? axis.low : axis.high;
  constexpr double kMargin = 0.03;
  low_ = Place(ends.first);
  high_ = Place(ends.second);
  const double big = std::max(std::abs(low_), std::abs(high_));
  constexpr double kNarrow = 1e-9;
  if (!(high_ - low_ > kNarrow * big)) {
    const double room = big > 0.0 && !logarithmic_ ? 0.1 * big : 1.0;
    low_ -= room;
    high_ += room;
  }
  const double room = kMargin * (high_ - low_);
  low_ = std::isfinite(first) ? std::min(low_, Place(first)) : low_ - room;
  high_ = std::isfinite(last) ? std::max(high_, Place(last)) : high_ + room;
  if (turned) std::swap(low_, high_);
}

std::vector<Tic> Scale::Tics(TicRoom room) const {
  const double low = Value(std::min(low_, high_));
  const double high = Value(std::max(low_, high_));
  constexpr int kMost = 9;
  std::vector<Tic> tics;
  for (int most = kMost; most > 0; --most) {
    tics = logarithmic_ ? LogarithmicTics(low, high, most)
                        : LinearTics(low, high, most);
    if (StandApart(tics, room)) break;
  }
  return tics;
}

bool Scale::StandApart(const std::vector<Tic>& tics, TicRoom room) const {
  for (std::size_t i = 1; i < tics.size(); ++i) {
    if (std::abs((*this)(tics[i].at) - (*this)(tics[i - 1].at)) <
        0.5 * (room(tics[i]) + room(tics[i - 1]))) {
      return false;
    }
  }
  return true;
}

double Scale::Place(double value) const {
  return logarithmic_ ? std::log10(value) : value;
}

double Scale::Value(double place) const {
  return logarithmic_ ? std::pow(10.0, place) : place;
}

}  // namespace errmap::report
