#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/report/number_text.h"
#include "cli/report/plot.h"
#include "cli/report/tables/report_tables.h"
#include "models/record_json.h"
#include "stats/holdout.h"

namespace errmap::report {
namespace {

// A number, text or truth as one line; lists and objects as JSON.
std::string ValueText(const models::RecordJson& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_null()) return "-";
  if (value.is_number_float()) {
    return fmt::format("{:.6g}", value.get<double>());
  }
  return value.dump(
      -1, ' ', false, models::RecordJson::error_handler_t::replace);
}

template <typename T>
std::string SettingsText(const models::ByName<T>& settings) {
  std::string text;
  for (const auto& [key, value] : settings) {
    text += fmt::format("{}{} = {}",
                        text.empty() ? "" : ", ",
                        key,
                        ValueText(models::ToJson(value)));
  }
  return text;
}

std::string StopText(const models::SummaryRecord& fit) {
  return std::string(fitting::ToString(fit.stop)) +
         (fit.converged ? "" : " (not converged)");
}

double RootOfTwice(double cost) {
  return cost >= 0.0 ? std::sqrt(2.0 * cost) : models::kNotKnown;
}

}  // namespace

Table CostTable(const ReportView& view) {
  Table table{.title = "Error and cost of each map"};
  table.error = ErrorTextOf(view);
  table.note =
      "Arithmetic of the map alone; errmap cost includes the exported checks "
      "and limits.";
  table.columns = {{"model", false},
                   {WithUnit(view.decisive + " RMSE", view.shown_unit)},
                   {"sensors"},
                   {"additions"},
                   {"multiplications"},
                   {"divisions"},
                   {"exponentials"},
                   {"bytes of state"}};
  for (const ModelRecord* model : view.models) {
    const double rmse = TestRmse(*model, view.decisive);
    if (!std::isfinite(rmse)) continue;
    if (model->name == view.recommended) table.marked = table.rows.size();
    std::vector<Cell> row{
        model->name,
        Error{rmse},
        model->sensors ? Cell(std::ssize(*model->sensors)) : Cell()};
    if (const auto& cost = model->step_cost) {
      row.insert(row.end(),
                 {cost->additions,
                  cost->multiplications,
                  cost->divisions,
                  cost->exponentials,
                  cost->state_bytes});
    }
    row.resize(table.columns.size());
    table.rows.push_back(std::move(row));
  }
  table.SayIfEmpty("No map was judged.");
  return table;
}

Table RunTable(const ReportView& view) {
  Table table{.title = "Run summary"};
  table.note =
      "The fits to all rows, as the report's Table 4; sqrt(2 E) of the scaled "
      "target. Times were measured on the machine that fitted.";
  for (const ModelRecord* model : view.models) {
    if (!model->final) continue;
    constexpr double kMicroseconds = 1e6;
    const models::SummaryRecord& fit = model->final->summary.value;
    const auto parameters = static_cast<double>(model->parameters.value_or(0));
    const double time = kMicroseconds * fit.mean_iteration_seconds;
    // Equations solved at once have a sum of squares in the target's unit.
    const bool is_scaled = fit.iterations > 0;
    if (model->name == view.recommended) table.marked = table.rows.size();
    table.Add(
        {{{"model", false}, model->name},
         {{"inputs"},
          model->inputs_used ? Cell(std::ssize(*model->inputs_used)) : Cell()},
         {{"parameters"}, model->parameters},
         {{"iterations"}, fit.iterations},
         {{"evaluations"}, fit.evaluations},
         {{"µs per iteration"}, Number{time}},
         {{"sd, µs"}, Number{kMicroseconds * fit.sd_iteration_seconds, 3}},
         {{"µs per iteration and parameter"},
          Number{parameters > 0.0 ? time / parameters : models::kNotKnown, 3}},
         {{"elapsed, s"}, Number{model->final->fit_seconds, 3}},
         {{"sqrt(2 E) first"}, Number{RootOfTwice(fit.initial_cost)}},
         {{"sqrt(2 E) last"},
          Number{is_scaled ? RootOfTwice(fit.final_cost) : models::kNotKnown}},
         {{"stop", false}, StopText(fit)},
         {{"message", false}, fit.message}});
  }
  table.SayIfEmpty("The fits to all rows were not kept.");
  return table;
}

Table FoldTable(const ReportView& view) {
  Table table{.title = "Every fold"};
  table.error = ErrorTextOf(view);
  for (const ModelRecord* model : view.models) {
    for (const std::string& holdout : view.holdouts) {
      const ResultRecord* result = ResultOf(*model, holdout);
      if (result == nullptr) continue;
      for (std::size_t i = 0; i < result->folds.size(); ++i) {
        const models::FoldRecord& fold = result->folds[i];
        const models::SummaryRecord& fit = fold.fit.value.summary.value;
        table.Add(
            {{{"model", false}, model->name},
             {{"hold-out", false}, holdout},
             {{"fold"}, std::to_string(i)},
             {{WithUnit("training RMSE", view.shown_unit)},
              Error{fold.train_rmse}},
             {{WithUnit("test RMSE", view.shown_unit)}, Error{fold.test_rmse}},
             {{"iterations"}, fit.iterations},
             {{"evaluations"}, fit.evaluations},
             {{"fit, s"}, Number{fold.fit.value.fit_seconds, 3}},
             {{"stop", false}, StopText(fit)}});
      }
    }
  }
  table.SayIfEmpty("No fold was fitted.");
  return table;
}

Table StartTable(const ReportView& view) {
  Table table{.title = "Every start"};
  table.error = ErrorTextOf(view);
  for (const ModelRecord* model : view.models) {
    if (!model->final || !model->final->starts) continue;
    for (const models::StartResult& start : model->final->starts->table) {
      table.Add({{{"model", false}, model->name},
                 {{"seed"}, std::to_string(start.seed)},
                 {{"sqrt(2 E) last"}, Number{RootOfTwice(start.final_cost), 5}},
                 {{"iterations"}, start.iterations},
                 {{"stop", false}, std::string(fitting::ToString(start.stop))},
                 {{WithUnit("inner hold-out RMSE", view.shown_unit)},
                  Error{start.holdout_rmse}},
                 {{"chosen", false}, start.chosen ? "yes" : "no"}});
    }
  }
  table.SayIfEmpty("No model was fitted from several starts.");
  return table;
}

Table ShuffledTargetTable(const ReportView& view) {
  Table table{.title = "Can the nets learn noise?"};
  table.note =
      "The same fit to shuffled targets: what it explains there is memorised "
      "noise.";
  for (const ModelRecord* model : view.models) {
    if (!model->memorisation) continue;
    const models::ShuffledTargetRecord& check = *model->memorisation;
    table.Add(
        {{{"model", false}, model->name},
         {{"R2 on shuffled targets"}, Number{check.shuffled_r2, 3}},
         {{"R2 on the targets"}, Number{check.train_r2, 4}},
         {{"weights per row"}, Number{check.weights_per_row, 3}},
         {{"effective parameters"}, Number{check.effective_parameters, 4}},
         {{"in words", false}, check.sentence}});
  }
  table.SayIfEmpty("No net was checked.");
  return table;
}

Table OptionTable(const ReportView& view) {
  Table table{.title = "Options that took effect"};
  for (const ModelRecord* model : view.models) {
    std::string choices;
    if (model->final && model->final->choices) {
      choices = SettingsText(*model->final->choices);
    }
    table.Add({{{"model", false}, model->name},
               {{"kind", false}, std::string(models::ToString(model->kind))},
               {{"options", false}, SettingsText(model->options)},
               {{"chosen by the fit", false}, std::move(choices)}});
  }
  table.SayIfEmpty("There is no model.");
  return table;
}

Table DroppedTable(const ReportView& view) {
  Table table{.title = "Sensors and columns left out"};
  for (const data::DroppedColumn& dropped : view.component->data.dropped) {
    table.Add(
        {{{"column", false}, dropped.column}, {{"why", false}, dropped.why}});
  }
  table.SayIfEmpty("No column was left out.");
  return table;
}

namespace {

std::string RangeOfSizes(const models::RowsOfFolds& lists) {
  if (lists.empty()) return "-";
  const auto [least, most] = std::ranges::minmax(
      lists, {}, [](const auto& list) { return list.size(); });
  return least.size() == most.size()
             ? std::to_string(most.size())
             : fmt::format("{} to {}", least.size(), most.size());
}

}  // namespace

Table HoldoutTable(const ReportView& view) {
  Table table{.title = "How rows were held out"};
  for (const models::HoldoutRecord& holdout : view.component->holdouts) {
    table.Add(
        {{{"hold-out", false}, holdout.name},
         {{"folds"}, holdout.folds},
         {{"training rows"}, RangeOfSizes(holdout.train_rows)},
         {{"test rows"}, RangeOfSizes(holdout.test_rows)},
         {{"whole groups", false}, holdout.whole_groups ? "yes" : "no"},
         {{"unit of analysis", false},
          holdout.unit_of_analysis.empty() ? "-" : holdout.unit_of_analysis},
         {{"units"}, holdout.units},
         {{"what it does", false}, stats::HoldoutMeaning(holdout.name)}});
  }
  table.SayIfEmpty("There is no hold-out.");
  return table;
}

Table ProvenanceTable(const models::StudyRecord& record) {
  Table table{.title = "Provenance"};
  table.columns = {{"what", false}, {"value", false}};
  const auto add = [&](const std::string& what, const std::string& value) {
    if (!value.empty() && value != "-") table.rows.push_back({what, value});
  };
  add("errmap", record.version);
  add("schema", record.schema);
  add("seed", std::to_string(record.seed));
  const models::ProvenanceRecord& provenance = record.provenance;
  add("command line", provenance.command_line);
  add("compiler", provenance.compiler);
  for (const models::InputFileRecord& input : provenance.inputs) {
    add("sha256 of " + input.file, input.sha256);
  }
  add("libraries", SettingsText(provenance.libraries));
  const models::RecordJson configuration =
      models::ToJson(provenance.configuration);
  for (const auto& [key, value] : configuration.items()) {
    add("configuration: " + key, ValueText(value));
  }
  return table;
}

}  // namespace errmap::report
