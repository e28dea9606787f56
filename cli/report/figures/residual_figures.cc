#include "cli/report/figures/residual_figures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Core>
#include <fmt/format.h>

#include "data/csv.h"
#include "stats/distributions.h"
#include "stats/normality/probability_plot.h"
#include "stats/summary.h"

namespace errmap::cli {
namespace {

constexpr const char* kBlue = "#0072B2";
constexpr const char* kVermillion = "#D55E00";
constexpr const char* kGrey = "#666666";
constexpr std::size_t kFewestForShape = 8;
// Characters of a name that fit under a figure, and under a small one.
constexpr std::size_t kLongLabel = 40;
constexpr std::size_t kShortLabel = 24;

// Everything the figures of one model share.
struct Context {
  const ReportView& view;
  const HeldOutRows& rows;
  std::string model;
  std::string holdout;
  std::string prefix;
};

double MeanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(values.size());
}

double RmsOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

Eigen::VectorXd Sorted(const std::vector<double>& values) {
  Eigen::VectorXd sorted = Eigen::Map<const Eigen::VectorXd>(
      values.data(), static_cast<Eigen::Index>(values.size()));
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

std::vector<double> ListOf(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

std::string Plain(double value) { return fmt::format("{:.3g}", value); }

Figure Begin(const Context& context,
             const std::string& kind,
             const std::string& title) {
  Figure figure;
  figure.place = FigurePlace::kResiduals;
  figure.subject = context.model;
  figure.title = title;
  figure.plot.name = context.prefix + kind;
  figure.missing = context.rows.missing;
  return figure;
}

Axis ResidualAxis(const ReportView& view) {
  return {.quantity = "residual", .unit = view.shown_unit};
}

Series Points(std::vector<double> x, std::vector<double> y) {
  return {.mark = Mark::kPoints,
          .columns = {std::move(x), std::move(y)},
          .colour = kBlue};
}

Series ZeroLine(const std::vector<double>& x) {
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  return {.mark = Mark::kLine,
          .columns = {{*low, *high}, {0.0, 0.0}},
          .colour = kGrey};
}

// Mean residual at each level of x, with its 95 % interval where n > 1.
Series Means(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(
      order.begin(), order.end(), [&](auto a, auto b) { return x[a] < x[b]; });
  Series series{.label = "mean",
                .mark = Mark::kLine,
                .columns = {{}, {}},
                .colour = kVermillion,
                .size = 1.8};
  for (std::size_t i = 0; i < order.size();) {
    double sum = 0.0;
    std::size_t j = i;
    for (; j < order.size() && x[order[j]] == x[order[i]]; ++j) {
      sum += y[order[j]];
    }
    series.columns[0].push_back(x[order[i]]);
    series.columns[1].push_back(sum / static_cast<double>(j - i));
    i = j;
  }
  return series;
}

Figure PredictedFigure(const Context& context) {
  Figure figure = Begin(context, "predicted", "predicted against measured");
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
      WithUnit(Plain(RmsOf(rows.residual)), unit));
  return figure;
}

std::string SpreadWords(const Context& context) {
  const auto [low, high] = std::minmax_element(context.rows.residual.begin(),
                                               context.rows.residual.end());
  return fmt::format(
      "residuals of {} held-out rows from {} to {}, mean {}",
      context.rows.residual.size(),
      Plain(*low),
      Plain(*high),
      WithUnit(Plain(MeanOf(context.rows.residual)), context.view.shown_unit));
}

const models::FiguresRecord& RowsOf(const ReportView& view) {
  return view.component->figures;
}

std::size_t PositionIndex(const ReportView& view) {
  const models::FiguresRecord& figures = RowsOf(view);
  for (std::size_t i = 0; i < figures.inputs.size(); ++i) {
    if (figures.inputs[i].name == figures.position) return i;
  }
  return std::string::npos;
}

const std::string& InputName(const ReportView& view, std::size_t index) {
  return RowsOf(view).inputs[index].name;
}

Axis InputAxis(const ReportView& view, std::size_t index, std::size_t most) {
  const models::FigureInputRecord& input = RowsOf(view).inputs[index];
  return {.quantity = Shortened(input.name, most),
          .unit = PrettyUnit(input.unit)};
}

Figure PositionFigure(const Context& context, std::size_t position) {
  Figure figure = Begin(context, "position", "residual against position");
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

Figure GroupFigure(const Context& context) {
  const std::string group = RowsOf(context.view).group.value_or("");
  Figure figure = Begin(context, "group", "residual by group");
  if (figure.missing.empty() && context.rows.group.empty()) {
    figure.missing = "The data have no groups.";
  }
  if (!figure.missing.empty()) return figure;
  figure.note =
      "Groups whose mean lies off zero drift as a whole: warm-up or another "
      "day that the map does not know.";
  figure.plot.x.quantity = Shortened(group, 40);
  figure.plot.x.names = GroupTics(context.rows);
  figure.plot.y = ResidualAxis(context.view);
  figure.plot.series = {Points(context.rows.group, context.rows.residual),
                        ZeroLine(context.rows.group),
                        Means(context.rows.group, context.rows.residual)};
  figure.description =
      fmt::format("Scatter over {} groups: {}; a line joins the means.",
                  context.rows.labels.size(),
                  SpreadWords(context));
  return figure;
}

Figure HistogramFigure(const Context& context) {
  Figure figure = Begin(context, "histogram", "histogram and normal curve");
  const HeldOutRows& rows = context.rows;
  if (figure.missing.empty() && rows.residual.size() < kFewestForShape) {
    figure.missing = "Too few residuals for a histogram.";
  }
  if (!figure.missing.empty()) return figure;
  const Eigen::VectorXd sorted = Sorted(rows.residual);
  const stats::Histogram histogram = stats::MakeHistogram(sorted, 0);
  Series bars{.mark = Mark::kBars, .columns = {{}, {}, {}}, .colour = kBlue};
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    bars.columns[0].push_back(histogram.low +
                              (static_cast<double>(i) + 0.5) * histogram.width);
    bars.columns[1].push_back(static_cast<double>(histogram.counts[i]));
    bars.columns[2].push_back(histogram.width);
  }
  const double mean = sorted.mean();
  const double sd = stats::Summarize(sorted).sd;
  Series curve{.label = "normal, same mean and sd",
               .mark = Mark::kLine,
               .columns = {{}, {}},
               .colour = kVermillion,
               .size = 2.0};
  constexpr int kCurvePoints = 81;
  constexpr double kReach = 3.5;
  constexpr double kRootTwoPi = 2.5066282746310002;
  for (int i = 0; i < kCurvePoints && sd > 0.0; ++i) {
    const double z = kReach * (2.0 * i / (kCurvePoints - 1) - 1.0);
    curve.columns[0].push_back(mean + z * sd);
    curve.columns[1].push_back(static_cast<double>(sorted.size()) *
                               histogram.width / sd / kRootTwoPi *
                               std::exp(-0.5 * z * z));
  }
  figure.note = "Figure 11 of the report of 1995.";
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

// "" where the residuals can be standardised.
std::string WhyNoShape(const HeldOutRows& rows) {
  if (!rows.missing.empty()) return rows.missing;
  if (rows.residual.size() < kFewestForShape) return "Too few residuals.";
  const auto [low, high] =
      std::minmax_element(rows.residual.begin(), rows.residual.end());
  return *low < *high ? "" : "All residuals are equal.";
}

Figure NormalPlotFigure(const Context& context) {
  Figure figure = Begin(context, "normal", "normal probability plot");
  figure.missing = WhyNoShape(context.rows);
  if (!figure.missing.empty()) return figure;
  const Eigen::VectorXd sorted = Sorted(context.rows.residual);
  const Eigen::VectorXd medians = stats::NormalMedians(sorted.size());
  const double mean = sorted.mean();
  const double sd = stats::Summarize(sorted).sd;
  const std::vector<double> x = ListOf(medians);
  figure.note =
      "Figure 7 of the report of 1995: normal residuals lie on the line (same "
      "mean and "
      "sd).";
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

Figure PpccFigure(const Context& context) {
  Figure figure = Begin(context, "ppcc", "Tukey lambda PPCC plot");
  figure.missing = WhyNoShape(context.rows);
  if (!figure.missing.empty()) return figure;
  const Eigen::VectorXd sorted = Sorted(context.rows.residual);
  const stats::TukeyPpcc curve = stats::TukeyPlot(sorted.size()).Curve(sorted);
  figure.note = fmt::format(
      "Figure 8 of the report of 1995: highest at lambda {:.2f} (r {:.4f}); a "
      "normal "
      "sample is highest near 0.14.",
      curve.best_lambda,
      curve.best_r);
  figure.plot.x.quantity = "Tukey's lambda";
  figure.plot.y.quantity = "probability plot correlation";
  const double least = curve.r.minCoeff();
  figure.plot.series = {{.label = "normal (0.14)",
                         .mark = Mark::kLine,
                         .columns = {{0.14, 0.14}, {least, 1.0}},
                         .colour = kGrey,
                         .dashed = true},
                        {.mark = Mark::kLine,
                         .columns = {ListOf(curve.lambda), ListOf(curve.r)},
                         .colour = kBlue,
                         .size = 2.0},
                        {.label = "highest",
                         .mark = Mark::kPoints,
                         .columns = {{curve.best_lambda}, {curve.best_r}},
                         .colour = kVermillion,
                         .size = 2.0}};
  figure.description = fmt::format(
      "Correlation of the probability plot for 81 values of lambda from -2 to "
      "2; maximum {:.4f} at lambda {:.2f}.",
      curve.best_r,
      curve.best_lambda);
  return figure;
}

Figure EcdfFigure(const Context& context) {
  Figure figure = Begin(context, "ecdf", "distribution against the normal");
  figure.missing = WhyNoShape(context.rows);
  if (!figure.missing.empty()) return figure;
  const Eigen::VectorXd sorted = Sorted(context.rows.residual);
  const double mean = sorted.mean();
  const double sd = stats::Summarize(sorted).sd;
  const auto n = static_cast<double>(sorted.size());
  std::vector<double> x;
  std::vector<double> y;
  double distance = 0.0;
  double place = 0.0;
  for (Eigen::Index i = 0; i < sorted.size(); ++i) {
    const double below = static_cast<double>(i) / n;
    const double above = static_cast<double>(i + 1) / n;
    const double normal = stats::NormalCdf((sorted[i] - mean) / sd);
    const double here =
        std::max(std::abs(normal - below), std::abs(normal - above));
    if (here > distance) {
      distance = here;
      place = sorted[i];
    }
    x.insert(x.end(), {sorted[i], sorted[i]});
    y.insert(y.end(), {below, above});
  }
  Series curve{.label = "normal, same mean and sd",
               .mark = Mark::kLine,
               .columns = {{}, {}},
               .colour = kVermillion,
               .size = 1.8};
  constexpr int kCurvePoints = 81;
  for (int i = 0; i < kCurvePoints; ++i) {
    const double at = sorted[0] + (sorted[sorted.size() - 1] - sorted[0]) * i /
                                      (kCurvePoints - 1);
    curve.columns[0].push_back(at);
    curve.columns[1].push_back(stats::NormalCdf((at - mean) / sd));
  }
  figure.note =
      "The Kolmogorov-Smirnov distance is the largest gap between the two; the "
      "grey line marks its place.";
  figure.plot.x = ResidualAxis(context.view);
  figure.plot.y = {.quantity = "share of rows", .unit = "fraction"};
  figure.plot.y.low = 0.0;
  figure.plot.y.high = 1.0;
  figure.plot.series = {{.mark = Mark::kLine,
                         .columns = {{place, place}, {0.0, 1.0}},
                         .colour = kGrey,
                         .dashed = true},
                        curve,
                        {.label = "residuals",
                         .mark = Mark::kLine,
                         .columns = {std::move(x), std::move(y)},
                         .colour = kBlue,
                         .size = 1.6}};
  figure.description = fmt::format(
      "Empirical distribution against the normal one; largest gap {:.4f} at "
      "{}.",
      distance,
      WithUnit(Plain(place), context.view.shown_unit));
  return figure;
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

Figure MapFigure(const Context& context, std::size_t position) {
  Figure figure = Begin(context, "map", "residual over position and group");
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
      "is a group that drifts, a column a position that the map misses.";
  figure.plot.width = 460;
  figure.plot.x = InputAxis(context.view, position, kLongLabel);
  figure.plot.y.quantity =
      Shortened(RowsOf(context.view).group.value_or(""), 30);
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
  const double mean_x = MeanOf(x);
  const double mean_y = MeanOf(y);
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  return xx > 0.0 && yy > 0.0 ? std::abs(xy) / std::sqrt(xx * yy) : 0.0;
}

// Indices of the inputs that the model reads, the position aside.
std::vector<std::size_t> UsedInputs(const Context& context,
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

std::vector<Figure> InputFigures(const Context& context,
                                 std::size_t position,
                                 std::size_t most) {
  std::vector<std::size_t> used = UsedInputs(context, position);
  const std::size_t all = used.size();
  std::stable_sort(used.begin(), used.end(), [&](auto a, auto b) {
    return AbsoluteCorrelation(context.rows.inputs[a], context.rows.residual) >
           AbsoluteCorrelation(context.rows.inputs[b], context.rows.residual);
  });
  used.resize(std::min(all, most));
  std::vector<Figure> figures;
  for (const std::size_t input : used) {
    Figure figure =
        Begin(context,
              fmt::format("input-{}", input + 1),
              fmt::format("residual against {}",
                          Shortened(InputName(context.view, input), 60)));
    const std::vector<double>& x = context.rows.inputs[input];
    figure.small = true;
    figure.plot.width = 300;
    figure.plot.height = 210;
    figure.plot.x = InputAxis(context.view, input, kShortLabel);
    figure.plot.y = ResidualAxis(context.view);
    figure.plot.series = {Points(x, context.rows.residual), ZeroLine(x)};
    if (used.size() < all && figures.empty()) {
      figure.note = fmt::format(
          "The {} of {} inputs whose values go most with the residual; errmap "
          "report DIR --figures DIR2 draws all.",
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

HeldOutRows HeldOutRowsOf(const ReportView& view,
                          const std::string& model,
                          const std::string& holdout) {
  HeldOutRows rows;
  const models::FiguresRecord& figures = RowsOf(view);
  const std::vector<double>* found = nullptr;
  const models::FigureTableRecord* table = nullptr;
  std::vector<bool> outside;
  for (const models::FigureHoldoutRecord& entry : figures.holdouts) {
    if (entry.name != holdout) continue;
    for (const auto& [name, values] : entry.predictions) {
      if (name == model) found = &values;
    }
    const auto index = static_cast<std::size_t>(entry.table);
    if (index < figures.tables.size()) table = &figures.tables[index];
    if (table == nullptr || !entry.outside) continue;
    outside.resize(table->target.size());
    for (const std::int64_t row : *entry.outside) {
      const auto at = static_cast<std::size_t>(row);
      if (at < outside.size()) outside[at] = true;
    }
  }
  if (figures.tables.empty()) {
    rows.missing =
        "results.json holds no rows for figures; run errmap compare "
        "again.";
  } else if (found == nullptr || table == nullptr ||
             found->size() != table->target.size()) {
    rows.missing = "There are no held-out predictions of this model.";
  }
  if (!rows.missing.empty()) return rows;
  const std::vector<double>& predicted = *found;
  const std::vector<double>& target = table->target;
  const std::vector<std::vector<double>>& inputs = table->inputs;
  rows.inputs.resize(figures.inputs.size());
  rows.labels = table->labels;
  if (table->session_labels) rows.session_labels = *table->session_labels;
  rows.thinned = table->rows_total > static_cast<std::int64_t>(target.size());
  for (std::size_t i = 0; i < target.size(); ++i) {
    if (!std::isfinite(predicted[i]) || !std::isfinite(target[i])) continue;
    rows.row.push_back(static_cast<double>(i < table->rows.size()
                                               ? table->rows[i]
                                               : static_cast<std::int64_t>(i)));
    rows.target.push_back(target[i] * view.scale);
    rows.predicted.push_back(predicted[i] * view.scale);
    rows.residual.push_back((target[i] - predicted[i]) * view.scale);
    if (table->groups.size() == target.size()) {
      rows.group.push_back(static_cast<double>(table->groups[i]));
    }
    if (table->sessions && table->sessions->size() == target.size()) {
      rows.session.push_back(static_cast<double>((*table->sessions)[i]));
    }
    if (table->time && table->time->size() == target.size()) {
      rows.time.push_back((*table->time)[i]);
    }
    if (i < outside.size()) rows.outside.push_back(outside[i]);
    for (std::size_t j = 0; j < rows.inputs.size(); ++j) {
      rows.inputs[j].push_back(j < inputs.size() && i < inputs[j].size()
                                   ? inputs[j][i]
                                   : kAutomatic);
    }
  }
  if (rows.target.empty()) {
    rows.missing = "There are no held-out predictions of this model.";
  }
  return rows;
}

std::vector<Figure> ResidualFigures(const ReportView& view,
                                    const std::string& model,
                                    const std::string& holdout,
                                    const std::string& prefix,
                                    bool brief,
                                    std::size_t most_inputs) {
  const HeldOutRows rows = HeldOutRowsOf(view, model, holdout);
  const Context context{view, rows, model, holdout, prefix};
  const std::size_t position = PositionIndex(view);
  std::vector<Figure> figures;
  figures.push_back(PredictedFigure(context));
  figures.push_back(PositionFigure(context, position));
  figures.push_back(HistogramFigure(context));
  if (!brief) {
    figures.push_back(GroupFigure(context));
    figures.push_back(MapFigure(context, position));
    figures.push_back(NormalPlotFigure(context));
    figures.push_back(PpccFigure(context));
    figures.push_back(EcdfFigure(context));
    for (Figure& figure : InputFigures(context, position, most_inputs)) {
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

Figure SmallResidualFigure(const ReportView& view,
                           const std::string& model,
                           const std::string& holdout,
                           const std::string& name) {
  const HeldOutRows rows = HeldOutRowsOf(view, model, holdout);
  Figure figure;
  figure.place = FigurePlace::kEveryModel;
  figure.small = true;
  figure.title = model;
  figure.plot.name = name;
  figure.missing = rows.missing;
  if (!figure.missing.empty()) return figure;
  const std::size_t position = PositionIndex(view);
  const bool has_position = position < rows.inputs.size();
  const std::vector<double>& x =
      has_position ? rows.inputs[position] : rows.row;
  figure.plot.width = 300;
  figure.plot.height = 210;
  figure.plot.x = has_position
                      ? InputAxis(view, position, kShortLabel)
                      : Axis{.quantity = "row", .unit = "number in the file"};
  figure.plot.y = ResidualAxis(view);
  figure.plot.series = {Points(x, rows.residual), ZeroLine(x)};
  figure.description = fmt::format(
      "Residuals of {} held-out rows over the {}: root mean square {}.",
      rows.residual.size(),
      has_position ? "position" : "row number",
      WithUnit(Plain(RmsOf(rows.residual)), view.shown_unit));
  return figure;
}

}  // namespace errmap::cli
