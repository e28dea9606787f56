#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <fmt/format.h>

#include "cli/report/figures/figure_parts.h"
#include "stats/normality/probability_plot.h"
#include "stats/summary.h"

namespace errmap::report {
namespace {

constexpr std::size_t kFewestForShape = 8;

VectorXd Sorted(const std::vector<double>& values) {
  VectorXd sorted =
      Eigen::Map<const VectorXd>(values.data(), std::ssize(values));
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

std::vector<double> ListOf(const VectorXd& values) {
  return {values.begin(), values.end()};
}

// "" where the residuals can be standardised.
std::string WhyNoShape(const HeldOutRows& rows) {
  if (!rows.missing.empty()) return rows.missing;
  if (rows.residual.size() < kFewestForShape) return "Too few residuals.";
  const auto [low, high] =
      std::minmax_element(rows.residual.begin(), rows.residual.end());
  return *low < *high ? "" : "All residuals are equal.";
}

}  // namespace

Figure HistogramFigure(const ResidualContext& context) {
  Figure figure =
      BeginFigure(context, "histogram", "histogram and normal curve");
  const HeldOutRows& rows = context.rows;
  if (figure.missing.empty() && rows.residual.size() < kFewestForShape) {
    figure.missing = "Too few residuals for a histogram.";
  }
  if (!figure.missing.empty()) return figure;
  const VectorXd sorted = Sorted(rows.residual);
  const stats::Histogram histogram = stats::MakeHistogram(sorted, 0);
  Series bars{.mark = Mark::kBars, .colour = kBlue};
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    bars.Add({histogram.low + (static_cast<double>(i) + 0.5) * histogram.width,
              static_cast<double>(histogram.counts[i]),
              histogram.width});
  }
  const double mean = sorted.mean();
  const double sd = stats::Summarize(sorted).sd;
  Series curve{.label = "normal, same mean and sd",
               .mark = Mark::kLine,
               .colour = kVermillion,
               .size = 2.0};
  constexpr int kCurvePoints = 81;
  constexpr double kReach = 3.5;
  constexpr double kRootTwoPi = 2.5066282746310002;
  for (int i = 0; i < kCurvePoints && sd > 0.0; ++i) {
    const double z = kReach * (2.0 * i / (kCurvePoints - 1) - 1.0);
    curve.Add({mean + z * sd,
               static_cast<double>(sorted.size()) * histogram.width / sd /
                   kRootTwoPi * std::exp(-0.5 * z * z)});
  }
  figure.plot.x = ResidualAxis(context.view);
  figure.plot.y = {.quantity = "count", .unit = "rows"};
  figure.plot.y.low = 0.0;
  figure.plot.series = {bars, curve};
  figure.description = fmt::format(
      "Histogram of {} bins with a normal curve of mean {} and sd {}: {}.",
      histogram.counts.size(),
      Plain(mean),
      Plain(sd),
      SpreadWords(context));
  return figure;
}

Figure NormalPlotFigure(const ResidualContext& context) {
  Figure figure = BeginFigure(context, "normal", "normal probability plot");
  figure.missing = WhyNoShape(context.rows);
  if (!figure.missing.empty()) return figure;
  const VectorXd sorted = Sorted(context.rows.residual);
  const VectorXd medians = stats::NormalMedians(sorted.size());
  const double mean = sorted.mean();
  const double sd = stats::Summarize(sorted).sd;
  const std::vector<double> x = ListOf(medians);
  figure.note =
      "Figure 7 of the report of 1995: normal residuals lie on the line (same "
      "mean and sd).";
  figure.plot.x = {.quantity = "normal order statistic median",
                   .unit = "standard deviations"};
  figure.plot.y = {.quantity = "ordered residual",
                   .unit = context.view.shown_unit};
  figure.plot.series = {
      {.mark = Mark::kLine,
       .columns = {{x.front(), x.back()},
                   {mean + sd * x.front(), mean + sd * x.back()}},
       .colour = kVermillion,
       .size = 1.8},
      Points(x, ListOf(sorted))};
  figure.description = fmt::format(
      "Ordered residuals against normal medians, correlation {:.4f}: {}.",
      stats::PlotCorrelation(sorted, medians),
      SpreadWords(context));
  return figure;
}

}  // namespace errmap::report
