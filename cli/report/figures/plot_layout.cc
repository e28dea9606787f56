#include "cli/report/figures/plot_layout.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

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

}  // namespace errmap::report
