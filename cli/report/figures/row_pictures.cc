#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "cli/report/figures/figure_parts.h"
#include "cli/report/figures/figures.h"
#include "cli/report/html.h"
#include "cli/report/number_text.h"

namespace errmap::report {
namespace {

constexpr double kPictureWidth = 120.0;
constexpr double kHeight = 18.0;
constexpr double kPictureEdge = 4.0;
constexpr double kDot = 2.5;  // radius

std::string Picture(const std::string& words, const std::string& drawn) {
  return fmt::format(
      "<svg class=\"spark\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
      "height=\"{1:g}\" role=\"img\" aria-label=\"{2}\">{3}</svg>",
      kPictureWidth,
      kHeight,
      HtmlText(words),
      drawn);
}

std::string Dot(double x, double y, double radius) {
  return fmt::format(
      "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\" fill=\"{}\"/>",
      x,
      y,
      radius,
      kBlue);
}

// The largest of neighbours, if there are more than `most`.
std::vector<double> Thinned(const std::vector<double>& values,
                            std::size_t most) {
  if (values.size() <= most) return values;
  std::vector<double> thinned;
  for (std::size_t i = 0; i < most; ++i) {
    const auto begin = values.begin();
    thinned.push_back(*std::max_element(
        begin + static_cast<std::ptrdiff_t>(i * values.size() / most),
        begin + static_cast<std::ptrdiff_t>((i + 1) * values.size() / most)));
  }
  return thinned;
}

}  // namespace

std::string IntervalPicture(double rmse,
                            const models::IntervalRecord& ci95,
                            double without_map) {
  if (!(rmse >= 0.0) || !(rmse <= without_map) || std::isinf(without_map)) {
    return "";
  }
  const auto x = [&](double error) {
    const double left = without_map > 0.0 ? error / without_map : 0.0;
    return kPictureEdge +
           (kPictureWidth - 2.0 * kPictureEdge) * std::clamp(left, 0.0, 1.0);
  };
  constexpr double kMiddle = kHeight / 2.0;
  std::string drawn =
      fmt::format("<path d=\"M{:g} {:g}H{:g}\" stroke=\"#d5dae0\"/>",
                  kPictureEdge,
                  kMiddle,
                  kPictureWidth - kPictureEdge);
  if (std::isfinite(ci95[0]) && std::isfinite(ci95[1])) {
    drawn += fmt::format(
        "<path d=\"M{:.1f} {:g}H{:.1f}\" stroke=\"{}\" stroke-width=\"2\"/>",
        x(ci95[0]),
        kMiddle,
        x(ci95[1]),
        kBlue);
  }
  return Picture(
      fmt::format("{:.0f} % of the error is left",
                  without_map > 0.0 ? kPercent * rmse / without_map : 0.0),
      drawn + Dot(x(rmse), kMiddle, kDot));
}

std::string Sparkline(const std::vector<double>& errors,
                      const std::string& words) {
  constexpr std::size_t kMostPoints = 57;  // two units of width each
  const std::vector<double> shown = Thinned(errors, kMostPoints);
  if (shown.size() < 2 ||
      !std::ranges::all_of(shown, [](double e) { return std::isfinite(e); })) {
    return "";
  }
  const auto worst = std::ranges::max_element(shown);
  const double step = (kPictureWidth - 2.0 * kPictureEdge) /
                      static_cast<double>(shown.size() - 1);
  const auto y = [&](double error) {
    const double share = *worst > 0.0 ? error / *worst : 0.0;
    return kHeight - kDot - (kHeight - 2.0 * kDot) * share;
  };
  std::string line;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    line += fmt::format("{}{:.1f} {:.1f}",
                        i == 0 ? "M" : "L",
                        kPictureEdge + step * static_cast<double>(i),
                        y(shown[i]));
  }
  return Picture(
      words,
      fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\"/>", line, kBlue) +
          Dot(kPictureEdge + step * static_cast<double>(worst - shown.begin()),
              y(*worst),
              kDot));
}

}  // namespace errmap::report
