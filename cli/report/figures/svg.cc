#include "cli/report/figures/svg.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "cli/report/figures/plot_layout.h"
#include "cli/report/html.h"

namespace errmap::report {
namespace {

// A number to a tenth of a pixel: "72.5", "-3".
std::string Tenth(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string At(double x, double y) { return Tenth(x) + " " + Tenth(y); }

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
  const double share = 0.5 * (value / limit + 1.0);
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
      // The cap of a line without length.
      return "M" + At(x, y) + "h0";
    case Shape::kSquare:
      // An area: paper has no square caps of lines without length.
      return RectanglePath(x - radius, y - radius, x + radius, y + radius);
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
  constexpr double kRadius = 2.2;
  return kRadius * series.size;
}

std::string PointStyle(const Series& series) {
  switch (series.shape) {
    case Shape::kDot:
      return fmt::format(
          "stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"round\"",
          series.colour,
          Tenth(2.0 * PointRadius(series)));
    case Shape::kCircle:
      return fmt::format("fill=\"#fff\" stroke=\"{}\" stroke-width=\"1.4\"",
                         series.colour);
    case Shape::kSquare:
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

// Of the area between two edges.
std::string BandStyle(const Series& series) {
  return fmt::format("fill=\"{}\" fill-opacity=\".18\"", series.colour);
}

constexpr const char* kBarStyle = "fill-opacity=\".45\" stroke-width=\".8\"";

std::string PathElement(const std::string& d, const std::string& style) {
  return d.empty() ? "" : fmt::format("<path d=\"{}\" {}/>", d, style);
}

// Draws one plot where its layout places it.
class Pen {
 public:
  Pen(const Plot& plot, const PlotLayout& layout)
      : plot_(plot), layout_(layout), x_(layout.x), y_(layout.y) {}

  std::string Draw() const {
    std::string body = HasCells() ? Hatching() : Grid();
    for (const bool on_top : {false, true}) {
      for (const Series& series : plot_.series) {
        if (series.on_top == on_top) body += Shapes(series);
      }
    }
    return body + Frame() + ColourBar() + Legend() + Words();
  }

 private:
  const Plot& plot_;
  const PlotLayout& layout_;
  const Scale& x_;
  const Scale& y_;

  std::string Grid() const {
    std::string d;
    for (const Tic& tic : layout_.x_tics) {
      d += "M" + At(x_(tic.at), y_.to()) + "V" + Tenth(y_.from());
    }
    for (const Tic& tic : layout_.y_tics) {
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

  // The background without cells: not measured, which is not zero.
  std::string Hatching() const {
    constexpr double kStep = 6.0;
    const double left = x_.from();
    const double right = x_.to();
    const double top = y_.to();
    const double bottom = y_.from();
    std::string d;
    const double lines = std::ceil((right + bottom - left - top) / kStep);
    for (int i = 1; i < lines; ++i) {
      const double sum = left + top + kStep * i;
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
    for (const Tic& tic : layout_.x_tics) {
      d += "M" + At(x_(tic.at), y_.from()) + "v" + Tenth(kTicLength);
    }
    for (const Tic& tic : layout_.y_tics) {
      d += "M" + At(x_.from(), y_(tic.at)) + "h" + Tenth(-kTicLength);
    }
    return PathElement(d, "class=\"frame\" fill=\"none\" stroke=\"#555\"");
  }

  std::string Shapes(const Series& series) const {
    switch (series.mark) {
      case Mark::kPoints:
        return Paths(Points(series), PointStyle(series));
      case Mark::kLine:
        return PathElement(Line(series), LineStyle(series));
      case Mark::kSpan:
        return PathElement(Spans(series), LineStyle(series));
      case Mark::kBars:
        return Paths(
            Bars(series),
            fmt::format(
                "fill=\"{0}\" stroke=\"{0}\" {1}", series.colour, kBarStyle));
      case Mark::kBand:
        return PathElement(Band(series), BandStyle(series));
      case Mark::kCells:
        return Cells(series);
    }
    return "";
  }

  // What is drawn of a series, and what is said of each part of it.
  struct Part {
    std::string d;
    std::string hint;
  };

  // A path for all, or for each that has something to say.
  static std::string Paths(const std::vector<Part>& parts,
                           const std::string& style) {
    std::string together;
    std::string alone;
    for (const Part& part : parts) {
      if (part.hint.empty()) {
        together += part.d;
      } else {
        alone += fmt::format("<path d=\"{}\"><title>{}</title></path>",
                             part.d,
                             HtmlText(part.hint));
      }
    }
    if (!alone.empty()) alone = fmt::format("<g {}>{}</g>", style, alone);
    return PathElement(together, style) + alone;
  }

  static std::string HintOf(const Series& series, std::size_t i) {
    return i < series.hints.size() ? series.hints[i] : "";
  }

  std::vector<Part> Points(const Series& series) const {
    std::vector<Part> parts;
    std::set<std::string> drawn;  // one on another is one
    for (std::size_t i = 0; i < series.columns[0].size(); ++i) {
      if (!IsShown(plot_, series, i)) continue;
      const std::string point = PointPath(series.shape,
                                          x_(series.columns[0][i]),
                                          y_(series.columns[1][i]),
                                          PointRadius(series));
      if (drawn.insert(point).second) {
        parts.push_back({point, HintOf(series, i)});
      }
    }
    return parts;
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

  std::vector<Part> Bars(const Series& series) const {
    std::vector<Part> parts;
    for (std::size_t i = 0; i < series.columns[0].size(); ++i) {
      if (!IsShown(plot_, series, i)) continue;
      const double half = 0.5 * series.columns[2][i];
      parts.push_back({RectanglePath(x_(series.columns[0][i] - half),
                                     y_(0.0),
                                     x_(series.columns[0][i] + half),
                                     y_(series.columns[1][i])),
                       HintOf(series, i)});
    }
    return parts;
  }

  // Along the high edge and back along the low one.
  std::string Band(const Series& series) const {
    const auto& [x, low, high] =
        std::tie(series.columns[0], series.columns[1], series.columns[2]);
    std::string d;
    std::string back;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!IsShown(plot_, series, i)) continue;
      d += (d.empty() ? "M" : "L") + At(x_(x[i]), y_(high[i]));
      back.insert(0, "L" + At(x_(x[i]), y_(low[i])));
    }
    return d.empty() ? d : d + back + "Z";
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
    const double low = ColourLow(plot_);
    const double share = (value - low) / (plot_.colour.high - low);
    return y_.from() + share * (y_.to() - y_.from());
  }

  std::string ColourBar() const {
    if (!HasColours(plot_)) return "";
    std::string shapes;
    const double limit = plot_.colour.high;
    for (int i = 0; i < kColours; ++i) {
      const auto end = [&](int k) {
        return BarPlace(
            std::max(limit * (2.0 * k / kColours - 1.0), ColourLow(plot_)));
      };
      if (end(i + 1) == y_.from()) continue;  // below the low end
      shapes += Cell(
          RectanglePath(BarLeft(), end(i), BarLeft() + kColourBar, end(i + 1)),
          PaletteColour(static_cast<double>(i) / (kColours - 1)));
    }
    return shapes;
  }

  std::string Legend() const {
    std::string shapes;
    for (const LegendEntry& entry : layout_.legend) {
      const Series& series = *entry.series;
      const double right = entry.x + kSwatch;
      if (series.mark == Mark::kPoints) {
        shapes += PathElement(PointPath(series.shape,
                                        entry.x + 0.5 * kSwatch,
                                        entry.y,
                                        PointRadius(series)),
                              PointStyle(series));
      } else if (series.mark == Mark::kBand) {
        shapes += PathElement(
            RectanglePath(entry.x, entry.y - 4.0, right, entry.y + 4.0),
            BandStyle(series));
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
    const std::string fit = Fitting(text, layout_.height - 2.0 * kEdge);
    const double half = 0.5 * TextWidth(fit) + kEdge;
    const double y =
        std::clamp(0.5 * (y_.from() + y_.to()),
                   std::min(half, 0.5 * layout_.height),
                   std::max(layout_.height - half, 0.5 * layout_.height));
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
    for (const Tic& tic : layout_.x_tics) {
      const double x = x_(tic.at);
      const double y = y_.from() + kTicLength + kTextSize;
      words += layout_.slanted
                   ? Text(x + kDown,
                          y,
                          tic.text,
                          fmt::format(" text-anchor=\"end\" "
                                      "transform=\"rotate(-45 {})\"",
                                      At(x + kDown, y)))
                   : Text(x, y, tic.text, " text-anchor=\"middle\"");
    }
    for (const Tic& tic : layout_.y_tics) {
      words += Text(x_.from() - kTicLength - 0.5 * kApart,
                    y_(tic.at) + kDown,
                    tic.text,
                    " text-anchor=\"end\"");
    }
    for (const Tic& tic : layout_.colour_tics) {
      words += Text(BarLeft() + kColourBar + kTicLength,
                    BarPlace(tic.at) + kDown,
                    tic.text,
                    "");
    }
    for (const LegendEntry& entry : layout_.legend) {
      words += Text(
          entry.x + kSwatch + 0.5 * kApart, entry.y + kDown, entry.label, "");
    }
    const std::string label =
        Fitting(plot_.x.Label(), plot_.width - 2.0 * kEdge);
    const double half = 0.5 * TextWidth(label) + kEdge;
    words += Text(std::clamp(0.5 * (x_.from() + x_.to()),
                             std::min(half, 0.5 * plot_.width),
                             std::max(plot_.width - half, 0.5 * plot_.width)),
                  layout_.height - kEdge - 2.0,
                  label,
                  " text-anchor=\"middle\"");
    words += Upright(kEdge + kTextSize, plot_.y.Label());
    if (HasColours(plot_)) {
      words += Upright(plot_.width - kEdge, plot_.colour.Label());
    }
    return fmt::format("<g class=\"words\" fill=\"#1b1f24\">{}</g>", words);
  }
};

}  // namespace

std::string Svg(const Plot& plot,
                std::string_view title,
                std::string_view description) {
  if (!HasPoints(plot)) return "";
  const PlotLayout layout = LayOut(plot);
  return fmt::format(
      "<svg viewBox=\"0 0 {w} {h}\" "
      "width=\"{w}\" height=\"{h}\" font-family=\"sans-serif\" "
      "font-size=\"{size}\" role=\"img\" aria-labelledby=\"{id}-t {id}-d\">"
      "<title id=\"{id}-t\">{title}</title><desc id=\"{id}-d\">{desc}</desc>"
      "<path class=\"paper\" d=\"M0 0H{w}V{h}H0Z\" fill=\"#fff\"/>{body}</svg>",
      fmt::arg("w", plot.width),
      fmt::arg("h", Tenth(layout.height)),
      fmt::arg("size", Tenth(kTextSize)),
      fmt::arg("id", plot.name),
      fmt::arg("title", HtmlText(title)),
      fmt::arg("desc", HtmlText(description)),
      fmt::arg("body", Pen(plot, layout).Draw()));
}

std::string SvgFile(std::string_view svg) {
  constexpr std::string_view kTag = "<svg";
  if (!svg.starts_with(kTag)) return std::string(svg);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\"" +
         std::string(svg.substr(kTag.size())) + "\n";
}

}  // namespace errmap::report
