#include "cli/report/leaderboard.h"

#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "data/csv.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

using models::HoldoutResult;
using models::ModelResult;

// A cell: text, or a figure of which `in_unit` says whether it has the
// target's unit and so is shown in another.
struct Cell {
  std::string text;
  double value = std::nan("");
  bool in_unit = false;
};

struct Row {
  const Comparison* component;
  std::vector<Cell> cells;
};

const std::vector<std::string>& Headings() {
  static const std::vector<std::string> headings = {
      "component",  "holdout",    "model",       "kind",       "status",
      "parameters", "test_n",     "test_rmse",   "test_mean",  "test_sd",
      "test_mae",   "test_min",   "test_max",    "test_range", "test_r2",
      "train_n",    "train_rmse", "train_mean",  "train_sd",   "train_mae",
      "train_min",  "train_max",  "train_range", "train_r2",   "fit_seconds",
      "predict_ns", "unit"};
  return headings;
}

Cell Text(const std::string& text) { return {.text = text}; }
Cell Number(double value) { return {.text = "", .value = value}; }
Cell Error(double value) {
  return {.text = "", .value = value, .in_unit = true};
}

void AddMetrics(const stats::ErrorMetrics* metrics, std::vector<Cell>* cells) {
  constexpr std::size_t kFigures = 9;
  if (metrics == nullptr) {
    cells->resize(cells->size() + kFigures);
    return;
  }
  const stats::SampleSummary& residuals = metrics->residuals;
  cells->push_back(Number(static_cast<double>(residuals.n)));
  for (const double value : {metrics->rmse,
                             residuals.mean,
                             residuals.sd,
                             metrics->mae,
                             residuals.min,
                             residuals.max,
                             residuals.range}) {
    cells->push_back(Error(value));
  }
  cells->push_back(Number(metrics->r2));
}

double FitSeconds(const HoldoutResult& result) {
  double seconds = 0.0;
  for (const models::FoldResult& fold : result.folds) {
    seconds += fold.fit_seconds;
  }
  return seconds;
}

std::vector<Row> Rows(const StudyRun& run, bool for_people) {
  std::vector<Row> rows;
  for (const Comparison& component : run.components) {
    const data::Unit& unit = component.data.dataset.target().unit;
    for (std::size_t h = 0; h < component.holdouts.size(); ++h) {
      for (const ModelResult& model : component.study.models) {
        const HoldoutResult& result = model.holdouts[h];
        std::vector<Cell> cells = {
            Text(component.name),
            Text(component.holdouts[h].name),
            Text(model.name),
            Text(std::string(models::ToString(model.kind))),
            Text(result.ok() ? "ok" : "failed"),
            model.final_fit ? Number(static_cast<double>(
                                  model.final_fit->model->num_parameters()))
                            : Cell{}};
        AddMetrics(result.ok() ? &result.test : nullptr, &cells);
        AddMetrics(result.ok() ? &result.train : nullptr, &cells);
        cells.push_back(result.ok() ? Number(FitSeconds(result)) : Cell{});
        cells.push_back(Number(model.predict_ns));
        cells.push_back(Text(for_people ? unit.display_symbol : unit.symbol));
        rows.push_back({&component, std::move(cells)});
      }
    }
  }
  return rows;
}

// Column names reach Markdown as text: what would end a cell, open markup or
// break the line is escaped.
std::string MarkdownText(const std::string& text) {
  std::string escaped;
  for (const char c : data::Printable(text, text.size())) {
    if (std::string_view("\\|`*_<>[]&").find(c) != std::string_view::npos) {
      escaped += '\\';
    }
    escaped += c;
  }
  return escaped;
}

}  // namespace

std::string LeaderboardCsv(const StudyRun& run) {
  std::string text;
  for (const std::string& heading : Headings()) {
    text += (text.empty() ? "" : ",") + heading;
  }
  text += "\n";
  for (const Row& row : Rows(run, false)) {
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const Cell& cell = row.cells[i];
      text += i == 0 ? "" : ",";
      text += cell.text.empty() ? data::CsvNumber(cell.value)
                                : data::CsvField(cell.text);
    }
    text += "\n";
  }
  return text;
}

std::string LeaderboardMarkdown(const StudyRun& run) {
  const std::vector<std::string>& headings = Headings();
  std::string text = "|";
  std::string rule = "|";
  for (const std::string& heading : headings) {
    const bool is_text = heading == "component" || heading == "holdout" ||
                         heading == "model" || heading == "kind" ||
                         heading == "status" || heading == "unit";
    text += " " + heading + " |";
    rule += is_text ? " --- |" : " ---: |";
  }
  text += "\n" + rule + "\n";
  for (const Row& row : Rows(run, true)) {
    const double scale =
        row.component->data.dataset.target().unit.display_scale;
    text += "|";
    for (const Cell& cell : row.cells) {
      const std::string shown =
          !cell.text.empty() ? MarkdownText(cell.text)
          : std::isnan(cell.value)
              ? ""
              : fmt::format("{:.4g}",
                            cell.in_unit ? scale * cell.value : cell.value);
      text += " " + shown + " |";
    }
    text += "\n";
  }
  return text;
}

}  // namespace errmap::cli
