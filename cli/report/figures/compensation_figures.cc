#include "cli/report/figures/compensation_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "cli/report/figures/figure_parts.h"
#include "cli/report/figures/held_out_rows.h"

namespace errmap::report {
namespace {

constexpr int kWide = 1180;
constexpr int kHalfWidth = 450;
constexpr std::size_t kLongName = 34;  // characters under a figure

Figure Begin(const ReportView& view,
             const std::string& name,
             const std::string& title) {
  Figure figure;
  figure.place = FigurePlace::kCompensation;
  figure.title = title;
  figure.plot.name = name;
  figure.plot.y = {.quantity = "error", .unit = view.shown_unit};
  return figure;
}

// The rows of the recommended map that were held out.
HeldOutRows RowsOfAdvice(const ReportView& view) {
  if (view.recommended.empty() || view.decisive.empty()) {
    HeldOutRows none;
    none.missing = "no map";
    return none;
  }
  return HeldOutRowsOf(view, view.recommended, view.decisive);
}

// Bins of equal width, or the values themselves where they are few.
class Bins {
 public:
  Bins(const std::vector<double>& values, std::size_t most) {
    const std::set<double> levels(values.begin(), values.end());
    low_ = *levels.begin();
    const double high = *levels.rbegin();
    count_ = std::min(levels.size(), most);
    if (levels.size() <= most && levels.size() > 1) {
      double step = high - low_;
      for (auto it = std::next(levels.begin()); it != levels.end(); ++it) {
        step = std::min(step, *it - *std::prev(it));
      }
      // Levels that lie evenly keep their places.
      const double steps = (high - low_) / step;
      constexpr double kEven = 1e-3;
      if (std::abs(steps - std::round(steps)) < kEven * steps &&
          steps < static_cast<double>(most)) {
        count_ = static_cast<std::size_t>(std::lround(steps)) + 1;
        width_ = step;
        low_ -= 0.5 * step;
        return;
      }
    }
    width_ = high > low_ ? (high - low_) / static_cast<double>(count_) : 1.0;
  }

  std::size_t Of(double value) const {
    const double place = std::floor((value - low_) / width_);
    return std::min(count_ - 1, static_cast<std::size_t>(std::max(0.0, place)));
  }
  double Centre(std::size_t bin) const {
    return low_ + (static_cast<double>(bin) + 0.5) * width_;
  }
  double width() const { return width_; }
  std::size_t count() const { return count_; }

 private:
  double low_ = 0.0;
  double width_ = 1.0;
  std::size_t count_ = 1;
};

double Correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double my = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    yy += (y[i] - my) * (y[i] - my);
    xy += (x[i] - mx) * (y[i] - my);
  }
  return xx > 0.0 && yy > 0.0 ? std::abs(xy) / std::sqrt(xx * yy) : 0.0;
}

// The sensor of the recommended map whose readings go most with the error.
std::size_t LeadingSensor(const ReportView& view, const HeldOutRows& rows) {
  const auto& advice = view.component->recommendation;
  std::size_t best = std::string::npos;
  double most = -1.0;
  for (std::size_t i = 0; i < rows.inputs.size(); ++i) {
    const std::string& name = view.component->figures.inputs[i].name;
    const std::vector<double>& values = rows.inputs[i];
    if (!advice ||
        std::ranges::find(advice->sensors, name) == advice->sensors.end() ||
        !std::ranges::all_of(values,
                             [](double v) { return std::isfinite(v); })) {
      continue;
    }
    const double here = Correlation(values, rows.target);
    if (here > most) {
      most = here;
      best = i;
    }
  }
  return best;
}

// Means over a grid, and what of it is empty.
struct Surface {
  std::vector<std::vector<double>> cells;  // as Mark::kCells
  double largest = 0.0;
};

Surface SurfaceOf(const std::vector<double>& x,
                  const std::vector<double>& y,
                  const std::vector<double>& value,
                  const Bins& across,
                  const Bins& up) {
  std::map<std::pair<std::size_t, std::size_t>, std::pair<double, int>> sums;
  for (std::size_t i = 0; i < value.size(); ++i) {
    auto& [sum, n] = sums[{across.Of(x[i]), up.Of(y[i])}];
    sum += value[i];
    ++n;
  }
  Surface surface{.cells = {{}, {}, {}, {}, {}}};
  for (const auto& [place, of_cell] : sums) {
    const double mean = of_cell.first / of_cell.second;
    surface.cells[0].push_back(across.Centre(place.first));
    surface.cells[1].push_back(up.Centre(place.second));
    surface.cells[2].push_back(0.5 * across.width());
    surface.cells[3].push_back(0.5 * up.width());
    surface.cells[4].push_back(mean);
    surface.largest = std::max(surface.largest, std::abs(mean));
  }
  return surface;
}

}  // namespace

std::vector<Figure> OverTimeFigures(const ReportView& view,
                                    const std::string& prefix) {
  const HeldOutRows rows = RowsOfAdvice(view);
  if (!rows.missing.empty()) return {};
  constexpr double kHour = 3600.0;
  Figure figure = Begin(view, prefix + "time", "Measured and predicted");
  figure.plot.width = kWide;
  figure.plot.height = 300;
  const bool by_time = !rows.time.empty() && rows.session_labels.size() < 2;
  std::vector<double> x;
  for (std::size_t i = 0; i < rows.row.size(); ++i) {
    x.push_back(by_time ? (rows.time[i] - rows.time[0]) / kHour : rows.row[i]);
  }
  figure.plot.x = by_time
                      ? Axis{.quantity = "time", .unit = "h"}
                      : Axis{.quantity = "row of the file", .unit = "number"};
  const auto [low, high] =
      std::minmax_element(rows.target.begin(), rows.target.end());
  // Where a session begins.
  if (!rows.session.empty() && rows.session_labels.size() > 1) {
    Series parts{.label = "a session begins",
                 .mark = Mark::kLine,
                 .columns = {{}, {}},
                 .colour = kGrey,
                 .dashed = true};
    for (std::size_t i = 1; i < rows.session.size(); ++i) {
      if (rows.session[i] == rows.session[i - 1]) continue;
      parts.columns[0].insert(parts.columns[0].end(), {x[i], x[i], kAutomatic});
      parts.columns[1].insert(parts.columns[1].end(),
                              {*low, *high, kAutomatic});
    }
    if (!parts.columns[0].empty()) figure.plot.series.push_back(parts);
  }
  Series outside{.label = "outside the trained range",
                 .mark = Mark::kPoints,
                 .columns = {{}, {}},
                 .colour = kOrange,
                 .size = 3.0,
                 .shape = Shape::kCircle};
  for (std::size_t i = 0; i < rows.outside.size(); ++i) {
    if (!rows.outside[i]) continue;
    outside.Add({x[i], rows.predicted[i]});
  }
  const std::size_t num_outside = outside.columns[0].size();
  if (num_outside > 0) figure.plot.series.push_back(std::move(outside));
  figure.plot.series.push_back({.label = "measured",
                                .mark = Mark::kPoints,
                                .columns = {x, rows.target},
                                .colour = kGrey,
                                .size = 2.2});  // seen around the predicted
  figure.plot.series.push_back({.label = "predicted, row held out",
                                .mark = Mark::kPoints,
                                .columns = {x, rows.predicted},
                                .colour = kVermillion,
                                .size = 0.9});
  figure.note = fmt::format(
      "{}, {}: what the map says of rows that its fit has not seen.",
      view.recommended,
      view.decisive);
  if (num_outside > 0) {
    figure.note +=
        fmt::format(" Of {} rows {} lie outside what the fold was trained on.",
                    x.size(),
                    num_outside);
  }
  figure.description = fmt::format(
      "Measured error from {} to {} and its prediction, {} rows in the order "
      "of measuring; root mean square difference {}.",
      Plain(*low),
      Plain(*high),
      x.size(),
      WithUnit(Plain(RmsOf(rows.residual)), view.shown_unit));
  return {std::move(figure)};
}

std::vector<Figure> SurfaceFigures(const ReportView& view,
                                   const std::string& prefix) {
  const HeldOutRows rows = RowsOfAdvice(view);
  const std::size_t position = PositionIndex(view);
  if (!rows.missing.empty() || position >= rows.inputs.size()) return {};
  const std::size_t sensor = LeadingSensor(view, rows);
  if (sensor == std::string::npos) return {};
  constexpr std::size_t kMostAcross = 40;
  constexpr std::size_t kMostUp = 40;
  const std::vector<double>& x = rows.inputs[position];
  const std::vector<double>& y = rows.inputs[sensor];
  const Bins across(x, kMostAcross);
  const Bins up(y, kMostUp);
  struct Panel {
    const char* name;
    const char* title;
    const std::vector<double>* values;
  };
  const std::array panels = {Panel{"measured", "Measured error", &rows.target},
                             Panel{"mapped", "Mapped error", &rows.predicted},
                             Panel{"left", "What is left", &rows.residual}};
  std::vector<Figure> figures;
  // One scale for what is compared; what is left would be blank on it.
  double compared = 0.0;
  for (const auto* values : {&rows.target, &rows.predicted}) {
    compared = std::max(compared, SurfaceOf(x, y, *values, across, up).largest);
  }
  for (const Panel& panel : panels) {
    const Surface surface = SurfaceOf(x, y, *panel.values, across, up);
    const double largest =
        panel.values == &rows.residual ? surface.largest : compared;
    Figure figure = Begin(view, prefix + "surface-" + panel.name, panel.title);
    figure.place = FigurePlace::kSurface;
    figure.plot.width = 390;
    figure.plot.height = 280;
    figure.plot.x = InputAxis(view, position, kLongName);
    figure.plot.y = InputAxis(view, sensor, kLongName);
    figure.plot.colour = {.quantity = "error",
                          .unit = view.shown_unit,
                          .high = largest > 0.0 ? largest : 1.0};
    figure.plot.series = {{.mark = Mark::kCells, .columns = surface.cells}};
    figure.description = fmt::format(
        "Mean error over the position and {}, in cells; the largest mean is {} "
        "in size. Hatched: not measured.",
        view.component->figures.inputs[sensor].name,
        WithUnit(Plain(surface.largest), view.shown_unit));
    figures.push_back(std::move(figure));
  }
  figures.front().note =
      "Means of held-out rows; measured and mapped on one scale, what is left "
      "on its own. Hatched where nothing was measured.";
  return figures;
}

std::vector<Figure> BeforeAndAfterFigures(const ReportView& view,
                                          const std::string& prefix) {
  const HeldOutRows rows = RowsOfAdvice(view);
  const std::size_t position = PositionIndex(view);
  if (!rows.missing.empty() || position >= rows.inputs.size()) return {};
  constexpr std::size_t kMostBins = 30;
  const std::vector<double>& x = rows.inputs[position];
  const Bins bins(x, kMostBins);
  Figure figure =
      Begin(view, prefix + "compensation", "Before and after compensation");
  figure.plot.width = kHalfWidth;
  figure.plot.x = InputAxis(view, position, kLongName);
  std::vector<std::string> words;
  struct Part {
    const char* label;
    const std::vector<double>* values;
    const char* colour;
  };
  for (const Part& part : {Part{"before", &rows.target, kGrey},
                           Part{"after", &rows.residual, kBlue}}) {
    std::vector<double> n(bins.count());
    std::vector<double> sum(bins.count());
    std::vector<double> squares(bins.count());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::size_t bin = bins.Of(x[i]);
      const double value = (*part.values)[i];
      n[bin] += 1.0;
      sum[bin] += value;
      squares[bin] += value * value;
    }
    Series mean{.label = part.label,
                .mark = Mark::kLine,
                .columns = {{}, {}},
                .colour = part.colour,
                .size = 2.4};
    Series band{.label = std::string(part.label) + ", two sd",
                .mark = Mark::kLine,
                .columns = {{}, {}},
                .colour = part.colour,
                .size = 1.2,
                .dashed = true};
    std::vector<double> lower;
    for (std::size_t bin = 0; bin < bins.count(); ++bin) {
      if (n[bin] < 1.0) continue;
      const double m = sum[bin] / n[bin];
      const double variance = std::max(0.0, squares[bin] / n[bin] - m * m);
      mean.Add({bins.Centre(bin), m});
      band.columns[1].push_back(m + 2.0 * std::sqrt(variance));
      lower.push_back(m - 2.0 * std::sqrt(variance));
    }
    band.columns[0] = mean.columns[0];
    // The upper edge, a gap, the lower edge.
    band.Add({kAutomatic, kAutomatic});
    band.columns[0].insert(
        band.columns[0].end(), mean.columns[0].begin(), mean.columns[0].end());
    band.columns[1].insert(band.columns[1].end(), lower.begin(), lower.end());
    words.push_back(
        fmt::format("{} {}",
                    part.label,
                    WithUnit(Plain(RmsOf(*part.values)), view.shown_unit)));
    figure.plot.series.push_back(std::move(band));
    figure.plot.series.push_back(std::move(mean));
  }
  figure.note = "Means of held-out rows and, dashed, two standard deviations.";
  figure.description = fmt::format(
      "Mean error by position with bands; root mean square {} and {}.",
      words[0],
      words[1]);
  return {std::move(figure)};
}

std::vector<Figure> UnitFigures(const ReportView& view,
                                const std::string& prefix) {
  const models::HoldoutRecord* holdout = HoldoutOf(view, view.decisive);
  if (holdout == nullptr || holdout->unit_labels.size() < 2) return {};
  // Bars of fewer pixels are no bars: then fewer models, then a line.
  constexpr double kFewestPixels = 4.0;
  constexpr double kUsed = 0.8;  // of a unit's room
  const double pixels =
      kUsed * kHalfWidth / static_cast<double>(holdout->unit_labels.size());
  const bool as_line = pixels < kFewestPixels;
  const auto most_models =
      static_cast<std::size_t>(std::clamp(pixels / kFewestPixels, 1.0, 3.0));
  constexpr std::array kColours = {kBlue, kVermillion, kGreen};
  std::vector<const ModelRecord*> shown = view.models;
  std::ranges::stable_partition(shown, [&](const ModelRecord* model) {
    return model->name == view.recommended;
  });
  std::vector<const ModelRecord*> best;
  for (const ModelRecord* model : shown) {
    const ResultRecord* result = ResultOf(*model, view.decisive);
    if (result == nullptr ||
        result->unit_rmse.size() != holdout->unit_labels.size()) {
      continue;
    }
    if (best.size() < most_models) best.push_back(model);
  }
  if (best.empty()) return {};
  Figure figure =
      Begin(view, prefix + "units", "Error by " + holdout->unit_of_analysis);
  figure.plot.width = kHalfWidth;
  figure.plot.y.quantity = "RMSE, held out";
  figure.plot.y.low = 0.0;
  figure.plot.x.quantity = Shortened(holdout->unit_of_analysis, 30);
  for (std::size_t i = 0; i < holdout->unit_labels.size(); ++i) {
    figure.plot.x.names.emplace_back(Shortened(holdout->unit_labels[i], 10),
                                     static_cast<double>(i));
  }
  const double width = kUsed / static_cast<double>(best.size());
  double worst = 0.0;
  std::string where;
  for (std::size_t m = 0; m < best.size(); ++m) {
    const ResultRecord& result = *ResultOf(*best[m], view.decisive);
    Series bars{.label = Shortened(best[m]->name, 24),
                .mark = as_line ? Mark::kLine : Mark::kBars,
                .columns = {{}, {}, {}},
                .colour = kColours[m],
                .size = as_line ? 1.2 : 3.0,
                .models = {PlaceOf(view, *best[m])}};
    for (std::size_t i = 0; i < result.unit_rmse.size(); ++i) {
      const double rmse = result.unit_rmse[i] * view.scale;
      bars.Add({static_cast<double>(i) - 0.5 * kUsed +
                    width * (static_cast<double>(m) + 0.5),
                rmse,
                width});
      if (m == 0 && rmse > worst) {
        worst = rmse;
        where = holdout->unit_labels[i];
      }
    }
    if (as_line) bars.columns.pop_back();
    figure.plot.series.push_back(std::move(bars));
  }
  figure.note = best.size() == 1
                    ? fmt::format("Of the recommended map, {}.", view.decisive)
                    : fmt::format(
                          "The recommended map beside the lowest "
                          "errors, {}.",
                          view.decisive);
  figure.description =
      fmt::format("The error of {} units; {} is worst at {} with {}.",
                  holdout->unit_labels.size(),
                  best.front()->name,
                  where,
                  WithUnit(Plain(worst), view.shown_unit));
  return {std::move(figure)};
}

std::vector<Figure> TrainingResidualFigures(const ReportView& view,
                                            const std::string& prefix) {
  const models::FiguresRecord& figures = view.component->figures;
  const HeldOutRows rows = RowsOfAdvice(view);
  if (!rows.missing.empty() || !figures.fitted || figures.tables.empty() ||
      figures.fitted->size() != figures.tables.front().target.size()) {
    return {};
  }
  const models::FigureTableRecord& table = figures.tables.front();
  Figure figure =
      Begin(view, prefix + "both", "Residuals of fitted and of held-out rows");
  figure.place = FigurePlace::kResiduals;
  figure.subject = view.recommended;
  std::vector<double> row;
  std::vector<double> residual;
  for (std::size_t i = 0; i < table.target.size(); ++i) {
    row.push_back(static_cast<double>(
        i < table.rows.size() ? table.rows[i] : static_cast<std::int64_t>(i)));
    residual.push_back((table.target[i] - (*figures.fitted)[i]) * view.scale);
  }
  figure.plot.x = {.quantity = "row of the file", .unit = "number"};
  figure.plot.y.quantity = "residual";
  figure.note = "Held-out rows that scatter more were not learnt but met.";
  figure.description = fmt::format(
      "Residuals by row: root mean square {} of rows that were fitted, {} of "
      "the same rows held out.",
      Plain(RmsOf(residual)),
      WithUnit(Plain(RmsOf(rows.residual)), view.shown_unit));
  figure.plot.series = {{.label = "held out",
                         .mark = Mark::kPoints,
                         .columns = {rows.row, rows.residual},
                         .colour = kVermillion},
                        {.label = "fitted",
                         .mark = Mark::kPoints,
                         .columns = {std::move(row), std::move(residual)},
                         .colour = kBlue}};
  return {std::move(figure)};
}

std::vector<Figure> CostFigures(const ReportView& view,
                                const std::string& prefix) {
  Figure figure =
      Begin(view, prefix + "cost", "Error against cost on a controller");
  figure.plot.width = kHalfWidth;
  figure.plot.x = {
      .quantity = "operations per step", .unit = "count", .logarithmic = true};
  figure.plot.y.quantity = "RMSE, " + Shortened(view.decisive, 20);
  figure.plot.y.logarithmic = true;
  Series others{.label = "a map",
                .mark = Mark::kPoints,
                .columns = {{}, {}},
                .colour = kBlue,
                .size = 2.2};
  Series recommended{.label = Shortened(view.recommended, 30),
                     .mark = Mark::kPoints,
                     .columns = {{}, {}},
                     .colour = kVermillion,
                     .size = 3.0,
                     .shape = Shape::kDiamond};
  std::string words;
  for (const ModelRecord* model : view.models) {
    const double rmse = TestRmse(*model, view.decisive) * view.scale;
    if (!model->step_cost || !(rmse > 0.0)) continue;
    const auto operations = static_cast<double>(model->step_cost->operations());
    if (!(operations > 0.0)) continue;
    Series& series = model->name == view.recommended ? recommended : others;
    series.Add({operations, rmse});
    series.models.push_back(PlaceOf(view, *model));
    words += fmt::format("{}{} {:.0f} and {:.3g}",
                         words.empty() ? "" : "; ",
                         model->name,
                         operations,
                         rmse);
  }
  if (others.columns[0].size() + recommended.columns[0].size() < 3) return {};
  figure.plot.series.push_back(std::move(others));
  if (!recommended.columns[0].empty()) {
    figure.plot.series.push_back(std::move(recommended));
  }
  figure.note =
      "Operations of the exported program, exponentials counted as one; the "
      "table of costs has each map by name.";
  figure.description =
      fmt::format("Operations per step and error of each map: {}.", words);
  return {std::move(figure)};
}

}  // namespace errmap::report
