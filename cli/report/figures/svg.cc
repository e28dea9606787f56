#include "cli/report/figures/svg.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "cli/report/html.h"

namespace errmap::cli {
namespace {

constexpr double kTextSize = 12.0;
constexpr double kLineHeight = 17.0;
constexpr double kEdge = 6.0;   // free at the rim of the picture
constexpr double kApart = 8.0;  // between labels
constexpr double kTicLength = 4.0;
constexpr double kHalf = 0.5;

// A number to a tenth of a pixel: "72.5", "-3".
std::string Tenth(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string At(double x, double y) { return Tenth(x) + " " + Tenth(y); }

// Width in pixels of a text in any of the usual sans-serif fonts, rather too
// wide than too narrow: nobody knows which one the reader has.
double TextWidth(std::string_view text) {
  double width = 0.0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    constexpr unsigned char kContinuation = 0x80;
    constexpr unsigned char kLead = 0xC0;
    constexpr unsigned char kLeadOfThree = 0xE0;
    if (byte >= kContinuation && byte < kLead) continue;
    if (byte >= kLeadOfThree) {
      width += 1.0;
    } else if (std::string_view(" .,:;'|!()[]iljtfrI-/").find(c) !=
               std::string_view::npos) {
      width += 0.42;
    } else if (std::string_view("mwMW@%").find(c) != std::string_view::npos) {
      width += 1.0;
    } else {
      width += c >= 'A' && c <= 'Z' ? 0.76 : 0.64;
    }
  }
  return width * kTextSize;
}

// The text, shortened in its middle until it is no wider than `most` pixels.
std::string Fitting(const std::string& text, double most) {
  std::string shorter = text;
  for (std::size_t length = text.size();
       TextWidth(shorter) > most && length > 3;
       --length) {
    shorter = Shortened(text, length);
  }
  return shorter;
}

struct Tic {
  double at = 0.0;
  std::string text;
};

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

// From values of one axis to pixels from `from` to `to`.
class Scale {
 public:
  // `ends` are the lowest and highest value that must be seen.
  Scale(const Axis& axis, std::pair<double, double> ends)
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

  void Span(double from, double to) {
    from_ = from;
    to_ = to;
  }
  double from() const { return from_; }
  double to() const { return to_; }

  double operator()(double value) const {
    return from_ + (Place(value) - low_) / (high_ - low_) * (to_ - from_);
  }

  // Round numbers, as many as find room: each needs `room(tic)` pixels.
  template <typename Room>
  std::vector<Tic> Tics(const Room& room) const {
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

  template <typename Room>
  bool StandApart(const std::vector<Tic>& tics, const Room& room) const {
    for (std::size_t i = 1; i < tics.size(); ++i) {
      if (std::abs((*this)(tics[i].at) - (*this)(tics[i - 1].at)) <
          kHalf * (room(tics[i]) + room(tics[i - 1]))) {
        return false;
      }
    }
    return true;
  }

 private:
  bool logarithmic_;
  double low_ = 0.0;
  double high_ = 1.0;
  double from_ = 0.0;
  double to_ = 1.0;

  double Place(double value) const {
    return logarithmic_ ? std::log10(value) : value;
  }
  double Value(double place) const {
    return logarithmic_ ? std::pow(10.0, place) : place;
  }
};

// Lowest and highest value along an axis, with what marks reach beyond it.
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
      if (series.mark == Mark::kBars && along_x) reach = kHalf * columns[2][i];
      take(value - reach);
      take(value + reach);
      if (series.mark == Mark::kBars && !along_x) take(0.0);
      if (series.mark == Mark::kSpan && along_x) {
        take(columns[2][i]);
        take(columns[3][i]);
      }
    }
  }
  return low <= high ? std::pair{low, high} : std::pair{1.0, 2.0};
}

// Colour of a share from 0 to 1 of the palette.
std::string PaletteColour(double share) {
  std::size_t next = 1;
  while (next + 1 < kPalette.size() && kPalette[next].first < share) ++next;
  const auto& [low, from] = kPalette[next - 1];
  const auto& [high, to] = kPalette[next];
  const double part = (share - low) / (high - low);
  std::string colour = "#";
  for (std::size_t i = 1; i < from.size(); i += 2) {
    const auto byte = [i](std::string_view text) {
      return static_cast<double>(
          std::strtol(std::string(text.substr(i, 2)).c_str(), nullptr, 16));
    };
    colour += fmt::format(
        "{:02x}",
        std::lround(byte(from) + part * (byte(to) - byte(from))) & 0xff);
  }
  return colour;
}

constexpr int kColours = 21;

std::string CellColour(double value, double limit) {
  const double share = kHalf * (value / limit + 1.0);
  const double level = std::clamp(
      std::floor(share * kColours), 0.0, static_cast<double>(kColours - 1));
  return PaletteColour(level / (kColours - 1));
}

std::string RectanglePath(double x0, double y0, double x1, double y1) {
  return fmt::format(
      "M{}H{}V{}H{}Z", At(x0, y0), Tenth(x1), Tenth(y1), Tenth(x0));
}

// One point; all of a series stand in one path.
std::string PointPath(Shape shape, double x, double y, double radius) {
  const std::string r = Tenth(radius);
  switch (shape) {
    case Shape::kDot:
    case Shape::kSquare:
      // The cap of a line without length.
      return "M" + At(x, y) + "h0";
    case Shape::kCircle:
      return fmt::format("M{}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0",
                         At(x - radius, y),
                         fmt::arg("r", r),
                         fmt::arg("d", Tenth(2.0 * radius)));
    case Shape::kDiamond:
      return fmt::format("M{}l{r} {r}l-{r} {r}l-{r} -{r}Z",
                         At(x, y - radius),
                         fmt::arg("r", r));
  }
  return "";
}

double PointRadius(const Series& series) {
  constexpr double kRadius = 1.8;
  return kRadius * series.size;
}

std::string PointStyle(const Series& series) {
  switch (series.shape) {
    case Shape::kDot:
    case Shape::kSquare:
      return fmt::format(
          "stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"{}\"",
          series.colour,
          Tenth(2.0 * PointRadius(series)),
          series.shape == Shape::kDot ? "round" : "square");
    case Shape::kCircle:
      return fmt::format("fill=\"#fff\" stroke=\"{}\" stroke-width=\"1.4\"",
                         series.colour);
    case Shape::kDiamond:
      return fmt::format("fill=\"{}\"", series.colour);
  }
  return "";
}

std::string LineStyle(const Series& series) {
  return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.3g}\"{}",
                     series.colour,
                     series.size,
                     series.dashed ? " stroke-dasharray=\"6 4\"" : "");
}

constexpr const char* kBarStyle = "fill-opacity=\".45\" stroke-width=\".8\"";

std::string PathElement(const std::string& d, const std::string& style) {
  return d.empty() ? "" : fmt::format("<path d=\"{}\" {}/>", d, style);
}

// Draws one plot: margins first, so that every label finds its place.
class Pen {
 public:
  explicit Pen(const Plot& plot)
      : plot_(plot),
        x_(plot.x, Ends(plot, true)),
        y_(plot.y, Ends(plot, false)) {
    height_ = plot.height + PlaceLegend();
    PlaceAxes();
  }

  double height() const { return height_; }

  std::string Draw() const {
    std::string body = HasCells() ? Hatching() : Grid();
    for (const Series& series : plot_.series) body += SeriesShapes(series);
    return body + Frame() + ColourBar() + Legend() + Words();
  }

 private:
  struct LegendEntry {
    const Series* series = nullptr;
    std::string label = {};
    double x = 0.0;
    double y = 0.0;
  };
  static constexpr double kSwatch = 20.0;

  const Plot& plot_;
  Scale x_;
  Scale y_;
  double height_ = 0.0;
  double top_ = 0.0;
  bool slanted_ = false;
  std::vector<Tic> x_tics_;
  std::vector<Tic> y_tics_;
  std::vector<Tic> colour_tics_;
  std::vector<LegendEntry> legend_;

  double width() const { return plot_.width; }
  bool HasColours() const { return std::isfinite(plot_.colour.high); }

  // Entries side by side as long as there is room; returns their height.
  double PlaceLegend() {
    double x = kEdge;
    double y = kEdge + kHalf * kLineHeight;
    for (const Series& series : plot_.series) {
      if (series.label.empty()) continue;
      LegendEntry entry{.series = &series};
      entry.label =
          Fitting(series.label, width() - 2.0 * kEdge - kSwatch - kApart);
      const double needs = kSwatch + kApart + TextWidth(entry.label);
      if (x > kEdge && x + needs > width() - kEdge) {
        x = kEdge;
        y += kLineHeight;
      }
      entry.x = x;
      entry.y = y;
      x += needs + 2.0 * kApart;
      legend_.push_back(std::move(entry));
    }
    top_ = legend_.empty() ? kEdge + kHalf * kTextSize
                           : y + kHalf * kLineHeight + kEdge;
    return legend_.empty() ? 0.0 : y + kHalf * kLineHeight - kEdge;
  }

  static double RoomAcross(const Tic& tic) {
    return TextWidth(tic.text) + kApart;
  }
  static double RoomAlong(const Tic& /*tic*/) { return kTextSize + 2.0; }

  static double Widest(const std::vector<Tic>& tics) {
    double widest = 0.0;
    for (const Tic& tic : tics) widest = std::max(widest, TextWidth(tic.text));
    return widest;
  }

  // Names of categories; where there is no room for all, every k-th.
  template <typename Room>
  static std::vector<Tic> NamedTics(const Axis& axis,
                                    const Scale& scale,
                                    const Room& room) {
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

  template <typename Room>
  static std::vector<Tic> TicsOf(const Axis& axis,
                                 const Scale& scale,
                                 const Room& room) {
    return axis.names.empty() ? scale.Tics(room) : NamedTics(axis, scale, room);
  }

  static constexpr double kSlant = 0.7071;  // of a label at 45 degrees
  static constexpr double kBar = 14.0;      // width of the colour scale

  void PlaceAxes() {
    double right = 2.0 * kEdge;
    if (HasColours()) {
      Scale scale(plot_.colour, {-plot_.colour.high, plot_.colour.high});
      scale.Span(height_ - 2.0 * kLineHeight, top_);
      colour_tics_ = scale.Tics(RoomAlong);
      right = 2.0 * kApart + kBar + kTicLength + Widest(colour_tics_) + kApart +
              kLineHeight;
    }
    // Names that do not stand side by side are slanted.
    double below = kTicLength + 2.0 * kLineHeight + kEdge;
    double slanted_left = 0.0;
    if (!plot_.x.names.empty()) {
      constexpr double kUsualLeft = 60.0;
      x_.Span(kUsualLeft, width() - right);
      std::vector<Tic> all;
      for (const auto& [name, at] : plot_.x.names) all.push_back({at, name});
      slanted_ = !x_.StandApart(all, RoomAcross);
      if (slanted_) {
        below += kSlant * Widest(all) - kHalf * kTextSize;
        slanted_left = kSlant * Widest(all) + kEdge -
                       std::abs(x_(all.front().at) - x_.from());
      }
    }
    y_.Span(height_ - below, top_);
    y_tics_ = TicsOf(plot_.y, y_, RoomAlong);
    double left =
        kEdge + kLineHeight + Widest(y_tics_) + kTicLength + kHalf * kApart;
    x_.Span(std::max(left, slanted_left), width() - right);
    x_tics_ = slanted_ ? TicsOf(plot_.x, x_, RoomAlong)
                       : TicsOf(plot_.x, x_, RoomAcross);
    if (!x_tics_.empty() && !slanted_) {
      // The last label may reach beyond the axis.
      const double beyond = x_(x_tics_.back().at) +
                            kHalf * TextWidth(x_tics_.back().text) + kEdge -
                            width();
      if (beyond > 0.0) x_.Span(x_.from(), x_.to() - beyond);
    }
  }

  std::string Grid() const {
    std::string d;
    for (const Tic& tic : x_tics_) {
      d += "M" + At(x_(tic.at), y_.to()) + "V" + Tenth(y_.from());
    }
    for (const Tic& tic : y_tics_) {
      d += "M" + At(x_.from(), y_(tic.at)) + "H" + Tenth(x_.to());
    }
    return PathElement(d,
                       "class=\"grid\" fill=\"none\" stroke=\"#ddd\" "
                       "stroke-width=\".6\"");
  }

  bool HasCells() const {
    return std::ranges::any_of(plot_.series, [](const Series& series) {
      return series.mark == Mark::kCells;
    });
  }

  // Where no cell is: nothing was measured, which is not zero.
  std::string Hatching() const {
    constexpr double kStep = 6.0;
    const double left = x_.from();
    const double right = x_.to();
    const double top = y_.to();
    const double bottom = y_.from();
    std::string d;
    for (double sum = left + top + kStep; sum < right + bottom; sum += kStep) {
      const double x0 = std::min(right, sum - top);
      const double x1 = std::max(left, sum - bottom);
      d += "M" + At(x0, sum - x0) + "L" + At(x1, sum - x1);
    }
    return PathElement(d,
                       "fill=\"none\" stroke=\"#9aa3ad\" "
                       "stroke-width=\".7\"");
  }

  std::string Frame() const {
    std::string d = "M" + At(x_.from(), y_.to()) + "V" + Tenth(y_.from()) +
                    "H" + Tenth(x_.to());
    for (const Tic& tic : x_tics_) {
      d += "M" + At(x_(tic.at), y_.from()) + "v" + Tenth(kTicLength);
    }
    for (const Tic& tic : y_tics_) {
      d += "M" + At(x_.from(), y_(tic.at)) + "h" + Tenth(-kTicLength);
    }
    return PathElement(d, "class=\"frame\" fill=\"none\" stroke=\"#555\"");
  }

  std::string SeriesShapes(const Series& series) const {
    switch (series.mark) {
      case Mark::kPoints:
        return PathElement(Points(series), PointStyle(series));
      case Mark::kLine:
        return PathElement(Line(series), LineStyle(series));
      case Mark::kSpan:
        return PathElement(Spans(series), LineStyle(series));
      case Mark::kBars:
        return PathElement(
            Bars(series),
            fmt::format(
                "fill=\"{0}\" stroke=\"{0}\" {1}", series.colour, kBarStyle));
      case Mark::kCells:
        return Cells(series);
    }
    return "";
  }

  std::string Points(const Series& series) const {
    std::string d;
    std::set<std::string> drawn;  // one on another is one
    for (std::size_t i = 0; i < series.columns[0].size(); ++i) {
      if (!IsShown(plot_, series, i)) continue;
      const std::string point = PointPath(series.shape,
                                          x_(series.columns[0][i]),
                                          y_(series.columns[1][i]),
                                          PointRadius(series));
      if (drawn.insert(point).second) d += point;
    }
    return d;
  }

  std::string Line(const Series& series) const {
    std::string d;
    std::string last;
    for (std::size_t i = 0; i < series.columns[0].size(); ++i) {
      if (!IsShown(plot_, series, i)) {
        last.clear();
        continue;
      }
      const std::string point =
          At(x_(series.columns[0][i]), y_(series.columns[1][i]));
      if (point == last) continue;
      d += (last.empty() ? "M" : "L") + point;
      last = point;
    }
    return d;
  }

  std::string Spans(const Series& series) const {
    std::string d;
    for (std::size_t i = 0; i < series.columns[0].size(); ++i) {
      if (!IsShown(plot_, series, i)) continue;
      d += "M" + At(x_(series.columns[2][i]), y_(series.columns[1][i])) + "H" +
           Tenth(x_(series.columns[3][i]));
    }
    return d;
  }

  std::string Bars(const Series& series) const {
    std::string d;
    for (std::size_t i = 0; i < series.columns[0].size(); ++i) {
      if (!IsShown(plot_, series, i)) continue;
      const double half = kHalf * series.columns[2][i];
      d += RectanglePath(x_(series.columns[0][i] - half),
                         y_(0.0),
                         x_(series.columns[0][i] + half),
                         y_(series.columns[1][i]));
    }
    return d;
  }

  // A path per colour; neighbours that touch leave no seam between them.
  std::string Cells(const Series& series) const {
    std::map<std::string, std::string> paths;
    const auto& c = series.columns;
    for (std::size_t i = 0; i < c[0].size(); ++i) {
      if (!IsShown(plot_, series, i)) continue;
      paths[CellColour(c[4][i], plot_.colour.high)] +=
          RectanglePath(x_(c[0][i] - c[2][i]),
                        y_(c[1][i] - c[3][i]),
                        x_(c[0][i] + c[2][i]),
                        y_(c[1][i] + c[3][i]));
    }
    std::string shapes;
    for (const auto& [colour, d] : paths) shapes += Cell(d, colour);
    return shapes;
  }

  static std::string Cell(const std::string& d, const std::string& colour) {
    return PathElement(
        d, fmt::format("fill=\"{}\" shape-rendering=\"crispEdges\"", colour));
  }

  double BarLeft() const { return x_.to() + 2.0 * kApart; }
  double BarPlace(double value) const {
    const double share = kHalf * (value / plot_.colour.high + 1.0);
    return y_.from() + share * (y_.to() - y_.from());
  }

  std::string ColourBar() const {
    if (!HasColours()) return "";
    std::string shapes;
    const double limit = plot_.colour.high;
    for (int i = 0; i < kColours; ++i) {
      const auto end = [&](int k) {
        return BarPlace(limit * (2.0 * k / kColours - 1.0));
      };
      shapes +=
          Cell(RectanglePath(BarLeft(), end(i), BarLeft() + kBar, end(i + 1)),
               PaletteColour(static_cast<double>(i) / (kColours - 1)));
    }
    return shapes;
  }

  std::string Legend() const {
    std::string shapes;
    for (const LegendEntry& entry : legend_) {
      const Series& series = *entry.series;
      const double right = entry.x + kSwatch;
      if (series.mark == Mark::kPoints) {
        shapes += PathElement(PointPath(series.shape,
                                        entry.x + kHalf * kSwatch,
                                        entry.y,
                                        PointRadius(series)),
                              PointStyle(series));
      } else {
        shapes += PathElement("M" + At(entry.x, entry.y) + "H" + Tenth(right),
                              LineStyle(series));
      }
    }
    return shapes;
  }

  // Text about its anchor; `more` are further attributes.
  static std::string Text(double x,
                          double y,
                          const std::string& text,
                          const std::string& more) {
    return fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>",
                       Tenth(x),
                       Tenth(y),
                       more,
                       HtmlText(text));
  }

  // Reads upwards.
  std::string Upright(double x, const std::string& text) const {
    const std::string fit = Fitting(text, height_ - 2.0 * kEdge);
    const double half = kHalf * TextWidth(fit) + kEdge;
    const double y = std::clamp(kHalf * (y_.from() + y_.to()),
                                std::min(half, kHalf * height_),
                                std::max(height_ - half, kHalf * height_));
    return Text(x,
                y,
                fit,
                fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 "
                            "{})\"",
                            At(x, y)));
  }

  std::string Words() const {
    constexpr double kDown = 0.35 * kTextSize;  // from the middle to the line
    std::string words;
    for (const Tic& tic : x_tics_) {
      const double x = x_(tic.at);
      const double y = y_.from() + kTicLength + kTextSize;
      words += slanted_ ? Text(x + kDown,
                               y,
                               tic.text,
                               fmt::format(" text-anchor=\"end\" "
                                           "transform=\"rotate(-45 {})\"",
                                           At(x + kDown, y)))
                        : Text(x, y, tic.text, " text-anchor=\"middle\"");
    }
    for (const Tic& tic : y_tics_) {
      words += Text(x_.from() - kTicLength - kHalf * kApart,
                    y_(tic.at) + kDown,
                    tic.text,
                    " text-anchor=\"end\"");
    }
    for (const Tic& tic : colour_tics_) {
      words += Text(BarLeft() + kBar + kTicLength,
                    BarPlace(tic.at) + kDown,
                    tic.text,
                    "");
    }
    for (const LegendEntry& entry : legend_) {
      words += Text(
          entry.x + kSwatch + kHalf * kApart, entry.y + kDown, entry.label, "");
    }
    const std::string label = Fitting(plot_.x.Label(), width() - 2.0 * kEdge);
    const double half = kHalf * TextWidth(label) + kEdge;
    words += Text(std::clamp(kHalf * (x_.from() + x_.to()),
                             std::min(half, kHalf * width()),
                             std::max(width() - half, kHalf * width())),
                  height_ - kEdge - 2.0,
                  label,
                  " text-anchor=\"middle\"");
    words += Upright(kEdge + kTextSize, plot_.y.Label());
    if (HasColours()) {
      words += Upright(width() - kEdge, plot_.colour.Label());
    }
    return fmt::format("<g class=\"words\" fill=\"#1b1f24\">{}</g>", words);
  }
};

}  // namespace

std::string Svg(const Plot& plot,
                std::string_view title,
                std::string_view description) {
  if (!HasPoints(plot)) return "";
  const Pen pen(plot);
  return fmt::format(
      "<svg viewBox=\"0 0 {w} {h}\" "
      "width=\"{w}\" height=\"{h}\" font-family=\"sans-serif\" "
      "font-size=\"{size}\" role=\"img\" aria-labelledby=\"{id}-t {id}-d\">"
      "<title id=\"{id}-t\">{title}</title><desc id=\"{id}-d\">{desc}</desc>"
      "<path class=\"paper\" d=\"M0 0H{w}V{h}H0Z\" fill=\"#fff\"/>{body}</svg>",
      fmt::arg("w", plot.width),
      fmt::arg("h", Tenth(pen.height())),
      fmt::arg("size", Tenth(kTextSize)),
      fmt::arg("id", plot.name),
      fmt::arg("title", HtmlText(title)),
      fmt::arg("desc", HtmlText(description)),
      fmt::arg("body", pen.Draw()));
}

std::string SvgFile(std::string_view svg) {
  constexpr std::string_view kTag = "<svg";
  if (!svg.starts_with(kTag)) return std::string(svg);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\"" +
         std::string(svg.substr(kTag.size())) + "\n";
}

}  // namespace errmap::cli
