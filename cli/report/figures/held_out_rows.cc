#include <cmath>
#include <cstdint>

#include "cli/report/figures/figure_parts.h"
#include "cli/report/plot.h"

namespace errmap::report {

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
