#include "cli/report/tables/fit_tables.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/report/number_text.h"
#include "cli/report/plot.h"
#include "models/study/record/record_json.h"
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

void SayWhyEmpty(const std::string& why, Table* table) {
  if (table->rows.empty()) table->missing = why;
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
      "Operations and bytes of state of one step of the exported program "
      "(errmap cost times it).";
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
  SayWhyEmpty("No map was judged.", &table);
  return table;
}

Table RunTable(const ReportView& view) {
  Table table{.title = "Run summary"};
  table.note =
      "The fits to all rows, as the report's Table 4; sqrt(2 E) of the scaled "
      "target. Times were measured on the machine that fitted.";
  table.columns = {{"model", false},
                   {"inputs"},
                   {"parameters"},
                   {"iterations"},
                   {"evaluations"},
                   {"µs per iteration"},
                   {"sd, µs"},
                   {"µs per iteration and parameter"},
                   {"elapsed, s"},
                   {"sqrt(2 E) first"},
                   {"sqrt(2 E) last"},
                   {"stop", false},
                   {"message", false}};
  for (const ModelRecord* model : view.models) {
    if (!model->final) continue;
    constexpr double kMicroseconds = 1e6;
    const models::SummaryRecord& fit = model->final->summary.value;
    const auto parameters = static_cast<double>(model->parameters.value_or(0));
    const double time = kMicroseconds * fit.mean_iteration_seconds;
    // Equations solved at once have a sum of squares in the target's unit.
    const bool is_scaled = fit.iterations > 0;
    if (model->name == view.recommended) table.marked = table.rows.size();
    table.rows.push_back(
        {model->name,
         model->inputs_used ? Cell(std::ssize(*model->inputs_used)) : Cell(),
         model->parameters,
         fit.iterations,
         fit.evaluations,
         Number{time},
         Number{kMicroseconds * fit.sd_iteration_seconds, 3},
         Number{parameters > 0.0 ? time / parameters : models::kNotKnown, 3},
         Number{model->final->fit_seconds, 3},
         Number{RootOfTwice(fit.initial_cost)},
         Number{is_scaled ? RootOfTwice(fit.final_cost) : models::kNotKnown},
         StopText(fit),
         fit.message});
  }
  SayWhyEmpty("The fits to all rows were not kept.", &table);
  return table;
}

Table FoldTable(const ReportView& view) {
  Table table{.title = "Every fold"};
  table.error = ErrorTextOf(view);
  table.columns = {{"model", false},
                   {"hold-out", false},
                   {"fold"},
                   {WithUnit("training RMSE", view.shown_unit)},
                   {WithUnit("test RMSE", view.shown_unit)},
                   {"iterations"},
                   {"evaluations"},
                   {"fit, s"},
                   {"stop", false}};
  for (const ModelRecord* model : view.models) {
    for (const std::string& holdout : view.holdouts) {
      const ResultRecord* result = ResultOf(*model, holdout);
      if (result == nullptr) continue;
      for (std::size_t i = 0; i < result->folds.size(); ++i) {
        const models::FoldRecord& fold = result->folds[i];
        const models::SummaryRecord& fit = fold.fit.value.summary.value;
        table.rows.push_back({model->name,
                              holdout,
                              std::to_string(i),
                              Error{fold.train_rmse},
                              Error{fold.test_rmse},
                              fit.iterations,
                              fit.evaluations,
                              Number{fold.fit.value.fit_seconds, 3},
                              StopText(fit)});
      }
    }
  }
  SayWhyEmpty("No fold was fitted.", &table);
  return table;
}

Table StartTable(const ReportView& view) {
  Table table{.title = "Every start"};
  table.error = ErrorTextOf(view);
  table.columns = {{"model", false},
                   {"seed"},
                   {"sqrt(2 E) last"},
                   {"iterations"},
                   {"stop", false},
                   {WithUnit("inner hold-out RMSE", view.shown_unit)},
                   {"chosen", false}};
  for (const ModelRecord* model : view.models) {
    if (!model->final || !model->final->starts) continue;
    for (const models::StartResult& start : model->final->starts->table) {
      table.rows.push_back({model->name,
                            std::to_string(start.seed),
                            Number{RootOfTwice(start.final_cost), 5},
                            start.iterations,
                            std::string(fitting::ToString(start.stop)),
                            Error{start.holdout_rmse},
                            start.chosen ? "yes" : "no"});
    }
  }
  SayWhyEmpty("No model was fitted from several starts.", &table);
  return table;
}

Table MemorisationTable(const ReportView& view) {
  Table table{.title = "Can the nets learn noise?"};
  table.note =
      "The same fit to shuffled targets: what it explains then is memory, not "
      "machine.";
  table.columns = {{"model", false},
                   {"R2 on shuffled targets"},
                   {"R2 on the targets"},
                   {"weights per row"},
                   {"effective parameters"},
                   {"in words", false}};
  for (const ModelRecord* model : view.models) {
    if (!model->memorisation) continue;
    const models::MemorisationRecord& check = *model->memorisation;
    table.rows.push_back({model->name,
                          Number{check.shuffled_r2, 3},
                          Number{check.train_r2, 4},
                          Number{check.weights_per_row, 3},
                          Number{check.effective_parameters, 4},
                          check.sentence});
  }
  SayWhyEmpty("No net was checked.", &table);
  return table;
}

Table OptionTable(const ReportView& view) {
  Table table{.title = "Options that took effect"};
  table.columns = {{"model", false},
                   {"kind", false},
                   {"options", false},
                   {"chosen by the fit", false}};
  for (const ModelRecord* model : view.models) {
    std::string choices;
    if (model->final && model->final->choices) {
      choices = SettingsText(*model->final->choices);
    }
    table.rows.push_back({model->name,
                          std::string(models::ToString(model->kind)),
                          SettingsText(model->options),
                          std::move(choices)});
  }
  SayWhyEmpty("There is no model.", &table);
  return table;
}

Table DroppedTable(const ReportView& view) {
  Table table{.title = "Sensors and columns left out"};
  table.columns = {{"column", false}, {"why", false}};
  for (const data::DroppedColumn& dropped : view.component->data.dropped) {
    table.rows.push_back({dropped.column, dropped.why});
  }
  SayWhyEmpty("No column was left out.", &table);
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
  table.columns = {{"hold-out", false},
                   {"folds"},
                   {"training rows"},
                   {"test rows"},
                   {"whole groups", false},
                   {"unit of analysis", false},
                   {"units"},
                   {"what it does", false}};
  for (const models::HoldoutRecord& holdout : view.component->holdouts) {
    table.rows.push_back(
        {holdout.name,
         holdout.folds,
         RangeOfSizes(holdout.train_rows),
         RangeOfSizes(holdout.test_rows),
         holdout.whole_groups ? "yes" : "no",
         holdout.unit_of_analysis.empty() ? "-" : holdout.unit_of_analysis,
         holdout.units,
         stats::HoldoutMeaning(holdout.name)});
  }
  SayWhyEmpty("There is no hold-out.", &table);
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
