#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>

#include "cli/report/figures/figure_parts.h"
#include "data/column_header.h"
#include "stats/summary.h"

namespace errmap::report {
namespace {

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

// Positions along an axis: the values themselves if they are few, else the
// middles of parts of equal width.
std::vector<double> PlacesOf(const std::vector<double>& values,
                             std::size_t most) {
  const std::set<double> levels(values.begin(), values.end());
  if (levels.size() <= most) return values;
  const double low = *levels.begin();
  const double width = (*levels.rbegin() - low) / static_cast<double>(most);
  std::vector<double> places;
  for (const double value : values) {
    const double part = std::min(std::floor((value - low) / width),
                                 static_cast<double>(most - 1));
    places.push_back(low + (part + 0.5) * width);
  }
  return places;
}

// The mean over x and the band in which 90 % lie, below it.
void AddBanded(const std::string& label,
               const char* colour,
               const std::vector<double>& x,
               const std::vector<double>& y,
               Plot* plot) {
  constexpr std::size_t kMostPlaces = 24;
  constexpr double kTail = 0.05;
  std::vector<double> known;
  std::vector<double> of_known;
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (!std::isfinite(x[i])) continue;
    known.push_back(x[i]);
    of_known.push_back(y[i]);
  }
  const std::vector<double> places = PlacesOf(known, kMostPlaces);
  std::map<double, std::vector<double>> at;
  for (std::size_t i = 0; i < places.size(); ++i) {
    at[places[i]].push_back(of_known[i]);
  }
  Series band{.mark = Mark::kBand, .colour = colour};
  Series mean{
      .label = label, .mark = Mark::kLine, .colour = colour, .size = 2.4};
  for (auto& [place, values] : at) {
    std::ranges::sort(values);
    const Eigen::Map<const VectorXd> ascending(values.data(),
                                               std::ssize(values));
    band.Add({place,
              stats::Quantile(ascending, kTail),
              stats::Quantile(ascending, 1.0 - kTail)});
    mean.Add({place, ascending.mean()});
  }
  plot->series.push_back(std::move(band));
  plot->series.push_back(std::move(mean));
}

Figure PositionFigure(const ReportView& view,
                      const HeldOutRows& rows,
                      std::size_t position,
                      const std::string& prefix) {
  Figure figure = Begin(
      view, prefix + "compensation", "Error over position, before and after");
  figure.plot.x = InputAxis(view, position, kLongName);
  const std::vector<double>& x = rows.inputs[position];
  AddBanded("before", kGrey, x, rows.target, &figure.plot);
  AddBanded("after", kBlue, x, rows.residual, &figure.plot);
  figure.note = "Mean of unseen rows. The band holds 90 % of them.";
  figure.description = fmt::format(
      "Mean error by position with 90 % bands; root mean square before {}, "
      "after {}.",
      Amount(RmsOf(rows.target), view),
      Amount(RmsOf(rows.residual), view));
  return figure;
}

// Hours of the day where the clock tells them, else hours or rows since the
// session began.
std::pair<Axis, std::vector<double>> TimeOfSession(const ReportView& view,
                                                   const HeldOutRows& rows) {
  constexpr double kHour = 3600.0;
  constexpr double kDay = 24.0;
  const std::string& origin = view.component->data.reading.time.origin;
  const bool of_day = origin == "1970" || origin == "midnight";
  const bool clock = rows.time.size() == rows.row.size();
  const std::vector<double>& at = clock ? rows.time : rows.row;
  std::map<double, double> begins;
  const auto session = [&](std::size_t i) {
    return i < rows.session.size() ? rows.session[i] : 0.0;
  };
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto [begin, is_new] = begins.try_emplace(session(i), at[i]);
    if (!is_new) begin->second = std::min(begin->second, at[i]);
  }
  std::vector<double> x;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double since = at[i] - begins[session(i)];
    x.push_back(!clock   ? since
                : of_day ? std::fmod(at[i] / kHour, kDay)
                         : since / kHour);
  }
  if (!clock) return {{.quantity = "rows since the start"}, x};
  return {{.quantity = of_day ? "time of day" : "time since the session began",
           .unit = "h"},
          x};
}

Figure TimeFigure(const ReportView& view,
                  const HeldOutRows& rows,
                  const std::string& prefix) {
  Figure figure = Begin(view, prefix + "clock", "Error over time, after");
  auto [axis, x] = TimeOfSession(view, rows);
  if (axis.quantity == "time of day")
    figure.title = "Over the time of day, after";
  figure.plot.x = std::move(axis);
  figure.plot.y.quantity = "remaining error";
  AddBanded("", kBlue, x, rows.residual, &figure.plot);
  figure.plot.series.push_back(ZeroLine(x));
  figure.note =
      "Mean and 90 % band. A mean off zero is a drift that the map misses.";
  figure.description = fmt::format(
      "The remaining error over the time with its 90 % band, {} rows; "
      "root mean square {}.",
      x.size(),
      Amount(RmsOf(rows.residual), view));
  return figure;
}

// The input whose mean over the unit's rows lies farthest outside those of all
// other units: "t03_degC: 27.4 °C, else 22.1 to 24.9". "" if none does.
std::string WhatDiffers(const ReportView& view,
                        const HeldOutRows& rows,
                        const std::vector<double>& unit_of_row,
                        double unit) {
  constexpr std::size_t kFewestOthers = 3;
  constexpr double kFarBeyond = 0.25;  // of the others' range
  std::string words;
  double most = kFarBeyond;
  for (std::size_t j = 0; j < rows.inputs.size(); ++j) {
    std::map<double, std::pair<double, double>> sums;
    for (std::size_t i = 0; i < unit_of_row.size(); ++i) {
      auto& [sum, n] = sums[unit_of_row[i]];
      sum += rows.inputs[j][i];
      n += 1.0;
    }
    const double here = sums[unit].first / sums[unit].second;
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (const auto& [other, of] : sums) {
      if (other == unit) continue;
      low = std::min(low, of.first / of.second);
      high = std::max(high, of.first / of.second);
    }
    const double beyond = std::max(here - high, low - here) / (high - low);
    if (sums.size() <= kFewestOthers || !(beyond > most)) continue;
    most = beyond;
    const models::FigureInputRecord& input = view.component->figures.inputs[j];
    words = fmt::format(" There {} is {} on average, elsewhere {} to {}{}{}.",
                        data::ReadHeader(input.name).base,
                        Plain(here),
                        Plain(low),
                        Plain(high),
                        input.unit.empty() ? "" : " ",
                        PrettyUnit(input.unit));
  }
  return words;
}

// Why the worst unit is the worst, as far as its rows tell.
std::string WorstWords(const ReportView& view,
                       const HeldOutRows& rows,
                       const models::HoldoutRecord& holdout,
                       const std::string& label) {
  const bool of_sessions = holdout.whole_sessions;
  const auto& labels = of_sessions ? rows.session_labels : rows.labels;
  const auto& unit_of_row = of_sessions ? rows.session : rows.group;
  const auto found = std::ranges::find(labels, label);
  if (found == labels.end() || unit_of_row.size() != rows.residual.size()) {
    return "";
  }
  const auto unit = static_cast<double>(found - labels.begin());
  std::vector<double> left;
  for (std::size_t i = 0; i < unit_of_row.size(); ++i) {
    if (unit_of_row[i] == unit) left.push_back(rows.residual[i]);
  }
  if (left.empty()) return "";
  std::string words;
  constexpr double kMostly = 0.8;
  if (std::abs(MeanOf(left)) > kMostly * RmsOf(left)) {
    words = fmt::format(" The whole {} is shifted by {}.",
                        holdout.unit_of_analysis,
                        Amount(MeanOf(left), view));
  }
  return words + WhatDiffers(view, rows, unit_of_row, unit);
}

std::vector<Figure> UnitFigures(const ReportView& view,
                                const HeldOutRows& rows,
                                const std::string& prefix) {
  const models::HoldoutRecord* holdout = HoldoutOf(view, view.decisive);
  const ResultRecord* result = ResultOf(view, view.recommended, view.decisive);
  if (holdout == nullptr || result == nullptr ||
      holdout->unit_labels.size() < 2 ||
      result->unit_rmse.size() != holdout->unit_labels.size()) {
    return {};
  }
  const std::vector<std::string>& labels = holdout->unit_labels;
  Figure figure =
      Begin(view, prefix + "units", "Error by " + holdout->unit_of_analysis);
  figure.plot.y.quantity = "RMSE, unseen";
  figure.plot.y.low = 0.0;
  figure.plot.x.quantity = Shortened(holdout->unit_of_analysis, 30);
  const std::size_t worst = static_cast<std::size_t>(
      std::ranges::max_element(result->unit_rmse) - result->unit_rmse.begin());
  // Bars of fewer pixels are not bars.
  constexpr std::size_t kMostBars = 80;
  constexpr double kBar = 0.8;
  const bool as_line = labels.size() > kMostBars;
  Series others{.mark = as_line ? Mark::kLine : Mark::kBars, .colour = kBlue};
  Series most{.mark = Mark::kBars, .colour = kVermillion};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto at = static_cast<double>(i);
    const double rmse = result->unit_rmse[i] * view.scale;
    figure.plot.x.names.emplace_back(Shortened(labels[i], 10), at);
    Series& series = i == worst && !as_line ? most : others;
    if (as_line) {
      series.Add({at, rmse});
    } else {
      series.Add({at, rmse, kBar});
    }
    series.hints.push_back(labels[i] + ": " + Amount(rmse, view));
  }
  const std::string where =
      fmt::format("Worst{}: {} {}, {}.",
                  as_line ? "" : " (orange)",
                  holdout->unit_of_analysis,
                  labels[worst],
                  Amount(result->unit_rmse[worst] * view.scale, view));
  figure.plot.series = {std::move(others)};
  if (!as_line) figure.plot.series.push_back(std::move(most));
  figure.note = where + (rows.missing.empty()
                             ? WorstWords(view, rows, *holdout, labels[worst])
                             : "");
  figure.description =
      fmt::format("The error of {} units. {}", labels.size(), where);
  return {std::move(figure)};
}

}  // namespace

std::vector<Figure> CompensationFigures(const ReportView& view,
                                        const std::string& prefix) {
  if (view.recommended.empty() || view.decisive.empty()) return {};
  const HeldOutRows rows = HeldOutRowsOf(view, view.recommended, view.decisive);
  const std::size_t position = PositionIndex(view);
  std::vector<Figure> figures;
  if (rows.missing.empty()) {
    if (position < rows.inputs.size()) {
      figures.push_back(PositionFigure(view, rows, position, prefix));
    }
    figures.push_back(TimeFigure(view, rows, prefix));
  }
  for (Figure& figure : UnitFigures(view, rows, prefix)) {
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace errmap::report
