#include "cli/report/figures/plot_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace errmap::report {
namespace {

constexpr double kLineHeight = 17.0;
constexpr double kHalf = 0.5;
constexpr double kSlant = 0.7071;  // of a label at 45 degrees

// Entries side by side as long as there is room.
std::vector<LegendEntry> PlaceLegend(const Plot& plot) {
  std::vector<LegendEntry> legend;
  double x = kEdge;
  double y = kEdge + kHalf * kLineHeight;
  for (const Series& series : plot.series) {
    if (series.label.empty()) continue;
    LegendEntry entry{.series = &series};
    entry.label =
        Fitting(series.label, plot.width - 2.0 * kEdge - kSwatch - kApart);
    const double needs = kSwatch + kApart + TextWidth(entry.label);
    if (x > kEdge && x + needs > plot.width - kEdge) {
      x = kEdge;
      y += kLineHeight;
    }
    entry.x = x;
    entry.y = y;
    x += needs + 2.0 * kApart;
    legend.push_back(std::move(entry));
  }
  return legend;
}

double RoomAcross(const Tic& tic) { return TextWidth(tic.text) + kApart; }
double RoomAlong(const Tic& /*tic*/) { return kTextSize + 2.0; }

double Widest(const std::vector<Tic>& tics) {
  double widest = 0.0;
  for (const Tic& tic : tics) widest = std::max(widest, TextWidth(tic.text));
  return widest;
}

// Names of categories; if there is no room for all, every k-th.
std::vector<Tic> NamedTics(const Axis& axis, const Scale& scale, TicRoom room) {
  std::vector<Tic> tics;
  for (std::size_t every = 1; every <= axis.names.size(); ++every) {
    tics.clear();
    for (std::size_t i = 0; i < axis.names.size(); i += every) {
      tics.push_back({axis.names[i].second, axis.names[i].first});
    }
    if (scale.StandApart(tics, room)) break;
  }
  return tics;
}

std::vector<Tic> TicsOf(const Axis& axis, const Scale& scale, TicRoom room) {
  return axis.names.empty() ? scale.Tics(room) : NamedTics(axis, scale, room);
}

// Returns how wide it is, with the room before it.
double PlaceColours(const Plot& plot, double top, PlotLayout* layout) {
  Scale scale(plot.colour, {ColourLow(plot), plot.colour.high});
  scale.Span(layout->height - 2.0 * kLineHeight, top);
  layout->colour_tics = scale.Tics(RoomAlong);
  return 2.0 * kApart + kColourBar + kTicLength + Widest(layout->colour_tics) +
         kApart + kLineHeight;
}

void PlaceAxes(const Plot& plot, double top, PlotLayout* layout) {
  const double right =
      HasColours(plot) ? PlaceColours(plot, top, layout) : 2.0 * kEdge;
  // Names that do not stand side by side are slanted.
  double below = kTicLength + 2.0 * kLineHeight + kEdge;
  double slanted_left = 0.0;
  if (!plot.x.names.empty()) {
    constexpr double kUsualLeft = 60.0;
    layout->x.Span(kUsualLeft, plot.width - right);
    std::vector<Tic> all;
    for (const auto& [name, at] : plot.x.names) all.push_back({at, name});
    layout->slanted = !layout->x.StandApart(all, RoomAcross);
    if (layout->slanted) {
      below += kSlant * Widest(all) - kHalf * kTextSize;
      slanted_left = kSlant * Widest(all) + kEdge -
                     std::abs(layout->x(all.front().at) - layout->x.from());
    }
  }
  layout->y.Span(layout->height - below, top);
  layout->y_tics = TicsOf(plot.y, layout->y, RoomAlong);
  double left = kEdge + kLineHeight + Widest(layout->y_tics) + kTicLength +
                kHalf * kApart;
  layout->x.Span(std::max(left, slanted_left), plot.width - right);
  layout->x_tics = layout->slanted ? TicsOf(plot.x, layout->x, RoomAlong)
                                   : TicsOf(plot.x, layout->x, RoomAcross);
  if (!layout->x_tics.empty() && !layout->slanted) {
    // The last label may reach beyond the axis.
    const double beyond = layout->x(layout->x_tics.back().at) +
                          kHalf * TextWidth(layout->x_tics.back().text) +
                          kEdge - plot.width;
    if (beyond > 0.0) layout->x.Span(layout->x.from(), layout->x.to() - beyond);
  }
}

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

double TextWidth(std::string_view text) {
  double width = 0.0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    constexpr unsigned char kContinuation = 0x80;
    constexpr unsigned char kLead = 0xC0;
    constexpr unsigned char kLeadOfThree = 0xE0;
    if (byte >= kContinuation && byte < kLead) continue;
    if (std::string_view(" .,:;'|!()[]iljtfrI-/").find(c) !=
        std::string_view::npos) {
      width += 0.42;
    } else if (byte >= kLeadOfThree ||
               std::string_view("mwMW@%").find(c) != std::string_view::npos) {
      width += 1.0;
    } else {
      width += c >= 'A' && c <= 'Z' ? 0.76 : 0.64;
    }
  }
  return width * kTextSize;
}

std::string Fitting(const std::string& text, double most) {
  std::string shorter = text;
  for (std::size_t length = text.size();
       TextWidth(shorter) > most && length > 3;
       --length) {
    shorter = Shortened(text, length);
  }
  return shorter;
}

bool HasColours(const Plot& plot) { return std::isfinite(plot.colour.high); }

PlotLayout LayOut(const Plot& plot) {
  PlotLayout layout{.x = Scale(plot.x, Ends(plot, true)),
                    .y = Scale(plot.y, Ends(plot, false)),
                    .height = static_cast<double>(plot.height),
                    .legend = PlaceLegend(plot)};
  double top = kEdge + kHalf * kTextSize;
  if (!layout.legend.empty()) {
    const double below = layout.legend.back().y + kHalf * kLineHeight;
    layout.height = plot.height + (below - kEdge);
    top = below + kEdge;
  }
  PlaceAxes(plot, top, &layout);
  return layout;
}

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
