#include "cli/report/figures/figure_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "cli/report/plot.h"
#include "data/column_header.h"

namespace errmap::report {

bool SpansDecades(double low, double high) {
  constexpr double kManyTimes = 15.0;
  return low > 0.0 && high > kManyTimes * low;
}

Figure BeginFigure(const ResidualContext& context,
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

std::string SpreadWords(const ResidualContext& context) {
  const auto [low, high] = std::minmax_element(context.rows.residual.begin(),
                                               context.rows.residual.end());
  return fmt::format("residuals of {} held-out rows from {} to {}, mean {}",
                     context.rows.residual.size(),
                     Plain(*low),
                     Plain(*high),
                     Amount(MeanOf(context.rows.residual), context.view));
}

std::string Plain(double value) { return fmt::format("{:.3g}", value); }

std::string Amount(double error, const ReportView& view) {
  return ErrorTextOf(view).WithUnit(error / view.scale);
}

double MeanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(values.size());
}

double RmsOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

std::size_t PositionIndex(const ReportView& view) {
  const models::FiguresRecord& figures = view.component->figures;
  for (std::size_t i = 0; i < figures.inputs.size(); ++i) {
    if (figures.inputs[i].name == figures.position) return i;
  }
  return std::string::npos;
}

Axis InputAxis(const ReportView& view, std::size_t index, std::size_t most) {
  const models::FigureInputRecord& input =
      view.component->figures.inputs[index];
  const std::string base = data::ReadHeader(input.name).base;
  return {.quantity = Shortened(base.empty() ? input.name : base, most),
          .unit = PrettyUnit(input.unit)};
}

Axis ResidualAxis(const ReportView& view) {
  return {.quantity = "residual", .unit = view.shown_unit};
}

Axis HeldOutErrorAxis(const ReportView& view, double low, double high) {
  constexpr double kMargin = 1.25;
  Axis axis{.quantity = "RMSE on held-out rows", .unit = view.shown_unit};
  axis.logarithmic = SpansDecades(low, high);
  axis.low = axis.logarithmic ? low / kMargin : 0.0;
  if (axis.logarithmic) axis.high = high * kMargin;
  return axis;
}

void NameRows(const std::vector<std::string>& names,
              const std::string& what,
              Plot* plot) {
  for (const std::string& name : names) {
    plot->y.names.emplace_back(name, static_cast<double>(plot->y.names.size()));
  }
  plot->y.quantity = what;
  plot->y.low = static_cast<double>(names.size()) - 0.5;
  plot->y.high = -0.5;
}

Series AcrossRows(const std::string& label, double at, std::size_t rows) {
  return {.label = label,
          .mark = Mark::kLine,
          .columns = {{at, at}, {-0.5, static_cast<double>(rows) - 0.5}},
          .colour = kBlack,
          .size = 1.5,
          .dashed = true};
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

HeldOutRows HeldOutRowsOf(const ReportView& view,
                          const std::string& model,
                          const std::string& holdout) {
  HeldOutRows rows;
  const models::FiguresRecord& figures = view.component->figures;
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
    return rows;
  }
  if (found == nullptr || table == nullptr ||
      found->size() != table->target.size()) {
    rows.missing = "There are no held-out predictions of this model.";
    return rows;
  }
  const std::vector<double>& predicted = *found;
  const std::vector<double>& target = table->target;
  const std::vector<std::vector<double>>& inputs = table->inputs;
  rows.inputs.resize(figures.inputs.size());
  rows.labels = table->labels;
  if (table->session_labels) rows.session_labels = *table->session_labels;
  rows.thinned = table->rows_total > std::ssize(target);
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

}  // namespace errmap::report
