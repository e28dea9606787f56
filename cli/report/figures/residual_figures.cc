#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "cli/report/figures/figure_parts.h"
#include "stats/summary.h"

namespace errmap::report {
namespace {

constexpr std::size_t kLongLabel = 40;  // characters under a figure

// Mean residual at each level of x, with its 95 % interval where n > 1.
Series Means(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(
      order.begin(), order.end(), [&](auto a, auto b) { return x[a] < x[b]; });
  Series series{
      .label = "mean", .mark = Mark::kLine, .colour = kVermillion, .size = 1.8};
  for (std::size_t i = 0; i < order.size();) {
    double sum = 0.0;
    std::size_t j = i;
    do {  // a level that is not a number equals none, not even itself
      sum += y[order[j]];
      ++j;
    } while (j < order.size() && x[order[j]] == x[order[i]]);
    series.Add({x[order[i]], sum / static_cast<double>(j - i)});
    i = j;
  }
  return series;
}

Figure PredictedFigure(const ResidualContext& context) {
  Figure figure =
      BeginFigure(context, "predicted", "predicted against measured");
  if (!figure.missing.empty()) return figure;
  const HeldOutRows& rows = context.rows;
  figure.note = "On the line the prediction is right.";
  const std::string& unit = context.view.shown_unit;
  figure.plot.x = {.quantity = "measured error", .unit = unit};
  figure.plot.y = {.quantity = "predicted error", .unit = unit};
  const auto [low, high] =
      std::minmax_element(rows.target.begin(), rows.target.end());
  figure.plot.series = {{.mark = Mark::kLine,
                         .columns = {{*low, *high}, {*low, *high}},
                         .colour = kGrey},
                        Points(rows.target, rows.predicted)};
  figure.description = fmt::format(
      "Scatter of predicted against measured error of {} held-out rows, "
      "measured from {} to {}; root mean square distance from the line {}.",
      rows.target.size(),
      Plain(*low),
      Plain(*high),
      Amount(RmsOf(rows.residual), context.view));
  return figure;
}

const std::string& InputName(const ReportView& view, std::size_t index) {
  return view.component->figures.inputs[index].name;
}

Figure PositionFigure(const ResidualContext& context, std::size_t position) {
  Figure figure = BeginFigure(context, "position", "residual against position");
  const bool is_there = position < context.rows.inputs.size();
  if (figure.missing.empty() && !is_there) {
    figure.missing = "The data have no position column.";
  }
  if (!figure.missing.empty()) return figure;
  const std::vector<double>& x = context.rows.inputs[position];
  figure.note =
      "A curve or slope here is error along the axis that the map misses.";
  figure.plot.x = InputAxis(context.view, position, kLongLabel);
  figure.plot.y = ResidualAxis(context.view);
  figure.plot.series = {Points(x, context.rows.residual),
                        ZeroLine(x),
                        Means(x, context.rows.residual)};
  figure.description =
      fmt::format("Scatter over the position: {}; a line joins the means.",
                  SpreadWords(context));
  return figure;
}

std::vector<std::pair<std::string, double>> GroupTics(const HeldOutRows& rows) {
  constexpr std::size_t kMostTics = 12;
  std::vector<std::pair<std::string, double>> tics;
  const std::size_t step = (rows.labels.size() + kMostTics - 1) / kMostTics;
  for (std::size_t i = 0; i < rows.labels.size(); i += step) {
    tics.emplace_back(Shortened(rows.labels[i], 10), static_cast<double>(i));
  }
  return tics;
}

double SmallestStep(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double gap = values[i] - values[i - 1];
    if (gap > 0.0) step = std::min(step, gap);
  }
  return std::isfinite(step) ? step : 1.0;
}

// Levels of a position that jitters would make cells thinner than a hair.
double CellWidth(const std::vector<double>& values) {
  constexpr double kMostCells = 60.0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return std::max(SmallestStep(values), (*high - *low) / kMostCells);
}

Figure MapFigure(const ResidualContext& context, std::size_t position) {
  Figure figure =
      BeginFigure(context, "map", "residual over position and group");
  const HeldOutRows& rows = context.rows;
  if (figure.missing.empty() && position >= rows.inputs.size()) {
    figure.missing = "The data have no position column.";
  }
  if (figure.missing.empty() && rows.group.empty()) {
    figure.missing = "The data have no groups.";
  }
  if (!figure.missing.empty()) return figure;
  const std::vector<double>& x = rows.inputs[position];
  double largest = 0.0;
  for (const double r : rows.residual) largest = std::max(largest, std::abs(r));
  if (!(largest > 0.0)) largest = 1.0;
  figure.note =
      "Blue: measured less than predicted; orange: more. A row of one colour "
      "is a group shifted as a whole, a column a position that the map "
      "misses.";
  figure.plot.x = InputAxis(context.view, position, kLongLabel);
  figure.plot.y.quantity =
      Shortened(context.view.component->figures.group.value_or(""), 30);
  figure.plot.y.names = GroupTics(rows);
  figure.plot.y.low = -0.5;
  figure.plot.y.high = static_cast<double>(rows.labels.size()) - 0.5;
  const double half = 0.5 * CellWidth(x);
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  figure.plot.x.low = *low - half;
  figure.plot.x.high = *high + half;
  figure.plot.colour = ResidualAxis(context.view);
  figure.plot.colour.high = largest;
  figure.plot.series = {{.mark = Mark::kCells,
                         .columns = {x,
                                     rows.group,
                                     std::vector<double>(x.size(), half),
                                     std::vector<double>(x.size(), 0.5),
                                     rows.residual}}};
  figure.description =
      fmt::format("Map of residuals over position and {} groups: {}.",
                  rows.labels.size(),
                  SpreadWords(context));
  return figure;
}

double AbsoluteCorrelation(const std::vector<double>& x,
                           const std::vector<double>& y) {
  const auto vector = [](const std::vector<double>& values) {
    return Eigen::Map<const VectorXd>(values.data(), std::ssize(values));
  };
  return std::abs(stats::Correlation(vector(x), vector(y)));
}

// Indices of the inputs that the model reads, the position aside.
std::vector<std::size_t> UsedInputs(const ResidualContext& context,
                                    std::size_t position) {
  const ModelRecord* model = ModelOf(context.view, context.model);
  std::vector<std::string> used;
  if (model != nullptr && model->inputs_used) used = *model->inputs_used;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < context.rows.inputs.size(); ++i) {
    if (i == position) continue;
    const std::string& name = InputName(context.view, i);
    if (used.empty() ||
        std::find(used.begin(), used.end(), name) != used.end()) {
      indices.push_back(i);
    }
  }
  return indices;
}

std::vector<Figure> InputFigures(const ResidualContext& context,
                                 std::size_t position) {
  constexpr std::size_t kMost = 3;
  if (!context.rows.missing.empty()) return {};
  std::vector<std::size_t> used = UsedInputs(context, position);
  const std::size_t all = used.size();
  std::stable_sort(used.begin(), used.end(), [&](auto a, auto b) {
    return AbsoluteCorrelation(context.rows.inputs[a], context.rows.residual) >
           AbsoluteCorrelation(context.rows.inputs[b], context.rows.residual);
  });
  used.resize(std::min(all, kMost));
  std::vector<Figure> figures;
  for (const std::size_t input : used) {
    Figure figure =
        BeginFigure(context,
                    fmt::format("input-{}", input + 1),
                    fmt::format("residual against {}",
                                Shortened(InputName(context.view, input), 60)));
    const std::vector<double>& x = context.rows.inputs[input];
    figure.plot.x = InputAxis(context.view, input, kLongLabel);
    figure.plot.y = ResidualAxis(context.view);
    figure.plot.series = {Points(x, context.rows.residual), ZeroLine(x)};
    if (used.size() < all && figures.empty()) {
      figure.note = fmt::format(
          "The {} of {} inputs that correlate most with the residual.",
          used.size(),
          all);
    }
    figure.description =
        fmt::format("Scatter over this input: {}; correlation of size {:.2f}.",
                    SpreadWords(context),
                    AbsoluteCorrelation(x, context.rows.residual));
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace

std::vector<Figure> ResidualFigures(const ReportView& view,
                                    const std::string& model,
                                    const std::string& holdout,
                                    const std::string& prefix,
                                    bool brief) {
  const HeldOutRows rows = HeldOutRowsOf(view, model, holdout);
  const ResidualContext context{view, rows, model, prefix};
  const std::size_t position = PositionIndex(view);
  std::vector<Figure> figures;
  figures.push_back(PredictedFigure(context));
  figures.push_back(PositionFigure(context, position));
  figures.push_back(HistogramFigure(context));
  if (!brief) {
    figures.push_back(MapFigure(context, position));
    figures.push_back(NormalPlotFigure(context));
    for (Figure& figure : InputFigures(context, position)) {
      figures.push_back(std::move(figure));
    }
  }
  if (rows.thinned) {
    for (Figure& figure : figures) {
      figure.note += fmt::format("{}Drawn from {} of the rows, spread evenly.",
                                 figure.note.empty() ? "" : " ",
                                 rows.target.size());
    }
  }
  return figures;
}

}  // namespace errmap::report
