#include "cli/report/figures/gnuplot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "data/text.h"

namespace errmap::report {
namespace {

std::string Range(const Axis& axis) {
  const auto end = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.9g}", value) : "*";
  };
  return fmt::format("[{}:{}]", end(axis.low), end(axis.high));
}

std::string AxisCommands(char name, const Axis& axis) {
  std::string text = fmt::format("set {}label {}\nset {}range {}\n",
                                 name,
                                 GnuplotString(axis.Label()),
                                 name,
                                 Range(axis));
  if (axis.logarithmic) text += fmt::format("set logscale {}\n", name);
  if (axis.names.empty()) return text;
  std::string tics;
  bool slanted = false;
  for (const auto& [label, at] : axis.names) {
    constexpr std::size_t kShort = 4;
    slanted = slanted || (name == 'x' && label.size() > kShort);
    tics += fmt::format(
        "{}{} {:.9g}", tics.empty() ? "" : ", ", GnuplotTicString(label), at);
  }
  return text + fmt::format("set {}tics {}({})\n",
                            name,
                            slanted ? "rotate by 45 right " : "",
                            tics);
}

bool IsColour(std::string_view colour) {
  return colour.size() == 7 && colour.front() == '#' &&
         colour.find_first_not_of("0123456789abcdefABCDEF", 1) ==
             std::string_view::npos;
}

int PointType(Shape shape) {
  switch (shape) {
    case Shape::kDot:
      return 7;
    case Shape::kCircle:
      return 6;
    case Shape::kSquare:
      return 5;
    case Shape::kDiamond:
      return 13;
  }
  return 7;
}

std::string Style(const Series& series) {
  const std::string colour = fmt::format(
      "lc rgb \"{}\"", IsColour(series.colour) ? series.colour : "#000000");
  const std::string line = fmt::format(
      "lw {:.3g} dt {}", series.size, series.dashed ? "(6,4)" : "1");
  switch (series.mark) {
    case Mark::kPoints:
      return fmt::format("with points pt {} ps {:.3g} {}",
                         PointType(series.shape),
                         0.4 * series.size,
                         colour);
    case Mark::kLine:
      return fmt::format("with lines {} {}", line, colour);
    case Mark::kBars:
      return fmt::format("with boxes fill solid 0.45 border {}", colour);
    case Mark::kSpan:
      return fmt::format("with vectors nohead {} {}", line, colour);
    case Mark::kCells:
      return "with boxxyerror fill solid 1 noborder lc palette";
  }
  return "";
}

std::string Using(Mark mark) {
  switch (mark) {
    case Mark::kBars:
      return "1:2:3";
    case Mark::kSpan:
      return "3:2:($4-$3):(0)";
    case Mark::kCells:
      return "1:2:3:4:5";
    default:
      return "1:2";
  }
}

// The data block of a series: numbers only.
std::string DataBlock(const Plot& plot, std::size_t index) {
  const Series& series = plot.series[index];
  std::string text = fmt::format("$data{} << END\n", index);
  bool gap = true;
  for (std::size_t row = 0; row < series.columns.front().size(); ++row) {
    const bool shown = IsShown(plot, series, row);
    if (!shown && !gap && series.mark == Mark::kLine) text += "\n";
    gap = !shown;
    if (!shown) continue;
    for (std::size_t column = 0; column < series.columns.size(); ++column) {
      text += fmt::format(
          "{}{:.6g}", column == 0 ? "" : " ", series.columns[column][row]);
    }
    text += "\n";
  }
  return text + "END\n";
}

std::string Terminal(const Plot& plot, ImageFormat format) {
  constexpr double kPointsPerInch = 72.0;
  constexpr int kKeyLine = 17;
  const int height =
      plot.height +
      kKeyLine * static_cast<int>(std::count_if(
                     plot.series.begin(), plot.series.end(), [](const auto& s) {
                       return !s.label.empty();
                     }));
  switch (format) {
    case ImageFormat::kSvg:
      return fmt::format(
          "set terminal svg noenhanced size {},{} dynamic font "
          "\"sans-serif,12\" butt\n",
          plot.width,
          height);
    case ImageFormat::kPdf:
      return fmt::format(
          "set terminal pdfcairo noenhanced color size {:.3f}in,{:.3f}in "
          "font \"sans-serif,11\" fontscale 0.9\n",
          plot.width / kPointsPerInch,
          height / kPointsPerInch);
    case ImageFormat::kPng:
      return fmt::format(
          "set terminal pngcairo noenhanced size {},{} font "
          "\"sans-serif,11\" fontscale 2.4 linewidth 2.4 pointscale 2.4\n",
          3 * plot.width,
          3 * height);
  }
  return "";
}

std::string Palette(const Plot& plot) {
  if (!std::isfinite(plot.colour.high)) return "";
  constexpr double kScaleWidth = 105.0;  // pixels
  const bool from_zero = ColourLow(plot) == 0.0;
  std::string stops;
  for (const auto& [at, colour] : kPalette) {
    constexpr double kMiddle = 0.5;
    if (from_zero && at < kMiddle) continue;
    stops += fmt::format(
        "{}{} \"{}\"", stops.empty() ? "" : ", ", 10.0 * at, colour);
  }
  return fmt::format(
      "set palette maxcolors 21 defined ({})\n"
      "set cbrange [{:.6g}:{:.6g}]\nset cblabel {} offset 1.5,0\n"
      "set rmargin at screen {:.3f}\n",
      stops,
      ColourLow(plot),
      plot.colour.high,
      GnuplotString(plot.colour.Label()),
      1.0 - kScaleWidth / plot.width);
}

std::string Key(const Plot& plot) {
  const bool labelled =
      std::any_of(plot.series.begin(), plot.series.end(), [](const auto& s) {
        return !s.label.empty();
      });
  return labelled ? "set key above left Left reverse samplen 1.5 spacing 1.1\n"
                  : "unset key\n";
}

}  // namespace

std::string_view ToString(ImageFormat format) {
  switch (format) {
    case ImageFormat::kSvg:
      return "svg";
    case ImageFormat::kPdf:
      return "pdf";
    case ImageFormat::kPng:
      return "png";
  }
  return "";
}

std::string GnuplotString(std::string_view text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
      " _-+*/=:,.()^<>|!?[]&%";
  std::string quoted = "\"";
  bool after_escape = false;
  for (const char c : data::AsUtf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    constexpr unsigned char kFirstBeyondAscii = 0x80;
    constexpr unsigned char kDelete = 0x7f;
    const bool plain =
        byte >= kFirstBeyondAscii || kPlain.find(c) != std::string_view::npos;
    // gnuplot takes a digit behind an octal escape for a part of it.
    const bool joins = after_escape && c >= '0' && c <= '9';
    after_escape = false;
    if (byte < ' ' || byte == kDelete) {
      quoted += ' ';
    } else if (plain && !joins) {
      quoted += c;
    } else {
      quoted += fmt::format("\\{:03o}", byte);
      after_escape = true;
    }
  }
  return quoted + "\"";
}

std::string GnuplotTicString(std::string_view text) {
  std::string doubled;
  for (const char c : text) doubled += c == '%' ? "%%" : std::string(1, c);
  return GnuplotString(doubled);
}

std::string PlotScript(const Plot& plot,
                       ImageFormat format,
                       std::string_view file) {
  std::string text = fmt::format("# Drawn by: gnuplot {}.gp\n", plot.name);
  text += "reset\nset encoding utf8\nset minussign\n";
  text += Terminal(plot, format);
  text += fmt::format("set output {}\n", GnuplotString(file));
  text +=
      "set border 3 lc rgb \"#555555\"\nset tics nomirror\n"
      "set grid lc rgb \"#DDDDDD\" dt 1 lw 0.5\nset style fill solid 1 "
      "noborder\n";
  text += Key(plot) + AxisCommands('x', plot.x) + AxisCommands('y', plot.y);
  text += Palette(plot);
  std::string plots;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    if (!HasPoints(plot, series)) continue;
    text += DataBlock(plot, i);
    plots += fmt::format("{}$data{} using {} {} {}",
                         plots.empty() ? "plot " : ", \\\n     ",
                         i,
                         Using(series.mark),
                         Style(series),
                         series.label.empty()
                             ? "notitle"
                             : "title " + GnuplotString(series.label));
  }
  return text + plots + "\nunset output\n";
}

}  // namespace errmap::report
