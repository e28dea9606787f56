#include "cli/report/fit_tables.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace errmap::cli {
namespace {

// A number, text or truth as one line; lists and objects as JSON.
std::string ValueText(const Json& value) {
  if (value.is_string()) return TextOf(value);
  if (value.is_null()) return "-";
  if (value.is_number_float()) return FigureText(NumberOf(value), 6);
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string SettingsText(const Json& object) {
  std::string text;
  if (!object.is_object()) return text;
  for (const auto& [key, value] : object.items()) {
    text += fmt::format(
        "{}{} = {}", text.empty() ? "" : ", ", key, ValueText(value));
  }
  return text;
}

void SayIfEmpty(const std::string& why, ReportTable* table) {
  if (table->rows.empty()) table->missing = why;
}

std::string StopText(const Json& fit) {
  const std::string stop = TextAt(fit, "stop");
  if (stop.empty()) return "-";
  return stop + (IsTrue(fit, "converged") ? "" : " (not converged)");
}

double RootOfTwice(double cost) {
  return cost >= 0.0 ? std::sqrt(2.0 * cost) : kNotThere;
}

ReportTable Coefficients(const Json& regression) {
  ReportTable table{.title = "Coefficients"};
  table.note =
      "In the target's own unit. Terms chosen with these rows have optimistic "
      "p-values and intervals.";
  if (!IsTrue(regression, "after_selection")) {
    table.note = "In the target's own unit.";
  }
  table.columns = {{"term", false},
                   {"estimate"},
                   {"standard error"},
                   {"t"},
                   {"p"},
                   {"95 % from"},
                   {"95 % to"},
                   {"standardised"},
                   {"VIF"},
                   {"chosen in, %", true, "share of bootstrap repetitions"}};
  const Json& terms = At(regression, "coefficients");
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Json& term = At(terms, i);
    const Json& interval = At(term, "ci95");
    constexpr double kPercent = 100.0;
    table.rows.push_back(
        {TextAt(term, "term"),
         FigureText(NumberAt(term, "estimate"), 7),
         FigureText(NumberAt(term, "standard_error")),
         FigureText(NumberAt(term, "t")),
         PText(NumberAt(term, "p")),
         FigureText(NumberOf(At(interval, std::size_t{0})), 5),
         FigureText(NumberOf(At(interval, std::size_t{1})), 5),
         FigureText(NumberAt(term, "standardised")),
         FigureText(NumberAt(term, "vif")),
         FigureText(kPercent * NumberAt(term, "bootstrap_inclusion"), 3)});
  }
  SayIfEmpty("The coefficients' statistics were not kept.", &table);
  return table;
}

ReportTable ExcludedTerms(const Json& regression) {
  ReportTable table{.title = "Terms left out"};
  table.columns = {{"term", false}, {"F if it entered"}, {"p"}};
  const Json& terms = At(regression, "excluded");
  constexpr std::size_t kMost = 40;
  for (std::size_t i = 0; i < std::min(terms.size(), kMost); ++i) {
    const Json& term = At(terms, i);
    table.rows.push_back({TextAt(term, "term"),
                          FigureText(NumberAt(term, "f")),
                          PText(NumberAt(term, "p"))});
  }
  if (terms.size() > kMost) {
    table.note = fmt::format(
        "The first {} of {}; all are in results.json.", kMost, terms.size());
  }
  SayIfEmpty("No term was left out.", &table);
  return table;
}

ReportTable AliasedTerms(const Json& regression) {
  ReportTable table{.title = "Aliased terms"};
  table.note = "The terms in the model determine them.";
  table.columns = {{"term", false}, {"why", false}};
  const Json& terms = At(regression, "aliased");
  for (std::size_t i = 0; i < terms.size(); ++i) {
    table.rows.push_back(
        {TextAt(At(terms, i), "term"), TextAt(At(terms, i), "why")});
  }
  SayIfEmpty("No term is aliased.", &table);
  return table;
}

std::string RegressionSummary(const ReportView& view, const Json& regression) {
  const double s = NumberAt(regression, "s");
  if (!std::isfinite(s)) return "";
  return fmt::format(
      "s {}{}, R2 {}, adjusted R2 {}, predicted R2 {} (PRESS {}), condition "
      "number {}, effective rank {}.",
      FigureText(s * view.scale),
      view.shown_unit.empty() ? "" : " " + view.shown_unit,
      FigureText(NumberAt(regression, "r2"), 6),
      FigureText(NumberAt(regression, "adjusted_r2"), 6),
      FigureText(NumberAt(regression, "predicted_r2"), 6),
      FigureText(NumberAt(regression, "press")),
      FigureText(NumberAt(regression, "condition")),
      CountText(NumberAt(regression, "effective_rank")));
}

}  // namespace

ReportTable RunTable(const ReportView& view) {
  ReportTable table{.title = "Run summary"};
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
  for (const ViewedModel& model : view.models) {
    const Json& fit = At(*model.json, "final");
    if (!fit.is_object()) continue;
    constexpr double kMicroseconds = 1e6;
    const double parameters = NumberAt(*model.json, "parameters");
    const double time = kMicroseconds * NumberAt(fit, "mean_iteration_seconds");
    const Json& inputs = At(*model.json, "inputs_used");
    if (model.name == view.recommended) table.marked = table.rows.size();
    table.rows.push_back(
        {model.name,
         inputs.is_array() ? std::to_string(inputs.size()) : "-",
         CountText(parameters),
         CountText(NumberAt(fit, "iterations")),
         CountText(NumberAt(fit, "evaluations")),
         FigureText(time),
         FigureText(kMicroseconds * NumberAt(fit, "sd_iteration_seconds"), 3),
         FigureText(parameters > 0.0 ? time / parameters : kNotThere, 3),
         FigureText(NumberAt(fit, "fit_seconds"), 3),
         FigureText(RootOfTwice(NumberAt(fit, "initial_cost"))),
         FigureText(RootOfTwice(NumberAt(fit, "final_cost"))),
         StopText(fit),
         TextAt(fit, "message")});
  }
  SayIfEmpty("The fits to all rows were not kept.", &table);
  return table;
}

ReportTable FoldTable(const ReportView& view) {
  const ErrorText error = ErrorTextOf(view);
  ReportTable table{.title = "Every fold"};
  table.columns = {{"model", false},
                   {"hold-out", false},
                   {"fold"},
                   {WithUnit("training RMSE", view.shown_unit)},
                   {WithUnit("test RMSE", view.shown_unit)},
                   {"iterations"},
                   {"evaluations"},
                   {"fit, s"},
                   {"stop", false}};
  for (const ViewedModel& model : view.models) {
    for (const std::string& holdout : view.holdouts) {
      const Json& folds = At(ResultOf(view, model.name, holdout), "folds");
      for (std::size_t i = 0; i < folds.size(); ++i) {
        const Json& fold = At(folds, i);
        const double train = NumberAt(fold, "train_rmse");
        const double test = NumberAt(fold, "test_rmse");
        table.rows.push_back({model.name,
                              holdout,
                              std::to_string(i),
                              std::isfinite(train) ? error(train) : "-",
                              std::isfinite(test) ? error(test) : "-",
                              CountText(NumberAt(fold, "iterations")),
                              CountText(NumberAt(fold, "evaluations")),
                              FigureText(NumberAt(fold, "fit_seconds"), 3),
                              StopText(fold)});
      }
    }
  }
  SayIfEmpty("No fold was fitted.", &table);
  return table;
}

ReportTable StartTable(const ReportView& view) {
  const ErrorText error = ErrorTextOf(view);
  ReportTable table{.title = "Every start"};
  table.columns = {{"model", false},
                   {"seed"},
                   {"sqrt(2 E) last"},
                   {"iterations"},
                   {"stop", false},
                   {WithUnit("inner hold-out RMSE", view.shown_unit)},
                   {"chosen", false}};
  for (const ViewedModel& model : view.models) {
    const Json& starts = At(*model.json, {"final", "starts", "table"});
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const Json& start = At(starts, i);
      const double rmse = NumberAt(start, "holdout_rmse");
      table.rows.push_back(
          {model.name,
           CountText(NumberAt(start, "seed")),
           FigureText(RootOfTwice(NumberAt(start, "final_cost")), 5),
           CountText(NumberAt(start, "iterations")),
           TextAt(start, "stop"),
           std::isfinite(rmse) ? error(rmse) : "-",
           IsTrue(start, "chosen") ? "yes" : "no"});
    }
  }
  SayIfEmpty("No model was fitted from several starts.", &table);
  return table;
}

ReportTable MemorisationTable(const ReportView& view) {
  ReportTable table{.title = "Can the nets learn noise?"};
  table.note =
      "The same fit to shuffled targets: what it explains then is memory, not "
      "machine.";
  table.columns = {{"model", false},
                   {"R2 on shuffled targets"},
                   {"R2 on the targets"},
                   {"rows per weight", true},
                   {"effective parameters"},
                   {"in words", false}};
  table.columns[3].name = "weights per row";
  for (const ViewedModel& model : view.models) {
    const Json& check = At(*model.json, "memorisation");
    if (!check.is_object()) continue;
    table.rows.push_back(
        {model.name,
         FigureText(NumberAt(check, "shuffled_r2"), 3),
         FigureText(NumberAt(check, "train_r2"), 4),
         FigureText(NumberAt(check, "weights_per_row"), 3),
         FigureText(NumberAt(check, "effective_parameters"), 4),
         TextAt(check, "sentence")});
  }
  SayIfEmpty("No net was checked.", &table);
  return table;
}

std::vector<PolynomialTables> PolynomialTablesOf(const ReportView& view) {
  std::vector<PolynomialTables> all;
  for (const ViewedModel& model : view.models) {
    const Json& regression = At(*model.json, "regression");
    const std::string equation = TextAt(*model.json, "equation");
    if (equation.empty() && !regression.is_object()) continue;
    if (model.kind == "baseline") continue;
    PolynomialTables tables{.model = model.name,
                            .equation = equation,
                            .method = TextAt(regression, "method"),
                            .summary = RegressionSummary(view, regression),
                            .coefficients = Coefficients(regression),
                            .excluded = ExcludedTerms(regression),
                            .aliased = AliasedTerms(regression)};
    if (!regression.is_object()) {
      tables.excluded.missing = "Which terms were left out was not kept.";
      tables.aliased.missing = "Which terms are aliased was not kept.";
    }
    const auto place = model.name == view.recommended ? all.begin() : all.end();
    all.insert(place, std::move(tables));
  }
  return all;
}

ReportTable OptionTable(const ReportView& view) {
  ReportTable table{.title = "Options that took effect"};
  table.columns = {{"model", false},
                   {"kind", false},
                   {"options", false},
                   {"chosen by the fit", false}};
  for (const ViewedModel& model : view.models) {
    table.rows.push_back({model.name,
                          model.kind,
                          SettingsText(At(*model.json, "options")),
                          SettingsText(At(*model.json, {"final", "choices"}))});
  }
  SayIfEmpty("There is no model.", &table);
  return table;
}

ReportTable DroppedTable(const ReportView& view) {
  ReportTable table{.title = "Sensors and columns left out"};
  table.columns = {{"column", false}, {"why", false}};
  const Json& dropped = At(*view.component, {"data", "dropped"});
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    table.rows.push_back(
        {TextAt(At(dropped, i), "column"), TextAt(At(dropped, i), "why")});
  }
  SayIfEmpty("No column was left out.", &table);
  return table;
}

namespace {

// What a SPEC means, in words.
std::string HoldoutWords(const std::string& name) {
  const std::string kind = name.substr(0, name.find(':'));
  if (kind == "every") {
    return "every K-th row is held out; its neighbours of the same group are "
           "in the training rows";
  }
  if (kind == "groups") {
    return "whole groups are held out in turn, K runs of them";
  }
  if (kind == "sessions") {
    return "whole sessions are held out in turn, K runs of them";
  }
  if (kind == "blocks") return "K runs of rows are held out in turn";
  if (kind == "leave-one-group-out") return "each group is held out in turn";
  if (kind == "kfold") {
    return "rows are shuffled and held out in K parts; their neighbours are in "
           "the training rows";
  }
  if (kind == "forward") return "earlier groups predict the next ones";
  if (kind == "random") return "a random share of the rows is held out";
  if (kind == "file") return "all rows train, the rows of a file test";
  return "-";
}

std::string RangeOfSizes(const Json& lists) {
  std::size_t least = std::string::npos;
  std::size_t most = 0;
  for (const Json& list : lists) {
    if (!list.is_array()) continue;
    least = std::min(least, list.size());
    most = std::max(most, list.size());
  }
  if (least == std::string::npos) return "-";
  return least == most ? std::to_string(most)
                       : fmt::format("{} to {}", least, most);
}

}  // namespace

ReportTable HoldoutTable(const ReportView& view) {
  ReportTable table{.title = "How rows were held out"};
  table.columns = {{"hold-out", false},
                   {"folds"},
                   {"training rows"},
                   {"test rows"},
                   {"whole groups", false},
                   {"unit of analysis", false},
                   {"units"},
                   {"what it does", false}};
  const Json& holdouts = At(*view.component, "holdouts");
  for (std::size_t i = 0; i < holdouts.size(); ++i) {
    const Json& holdout = At(holdouts, i);
    const std::string name = TextAt(holdout, "name");
    const Json& whole = At(holdout, "whole_groups");
    const std::string unit = TextAt(holdout, "unit_of_analysis");
    table.rows.push_back(
        {name,
         CountText(NumberAt(holdout, "folds")),
         RangeOfSizes(At(holdout, "train_rows")),
         RangeOfSizes(At(holdout, "test_rows")),
         whole.is_boolean() ? (whole.get<bool>() ? "yes" : "no") : "-",
         unit.empty() ? "-" : unit,
         CountText(NumberAt(holdout, "units")),
         HoldoutWords(name)});
  }
  SayIfEmpty("There is no hold-out.", &table);
  return table;
}

ReportTable ProvenanceTable(const Json& results) {
  ReportTable table{.title = "Provenance"};
  table.columns = {{"what", false}, {"value", false}};
  const auto add = [&](const std::string& what, const std::string& value) {
    if (!value.empty() && value != "-") table.rows.push_back({what, value});
  };
  add("errmap", TextAt(results, "version"));
  add("schema", TextAt(results, "schema"));
  add("seed", CountText(NumberAt(results, "seed")));
  const Json& provenance = At(results, "provenance");
  add("command line", TextAt(provenance, "command_line"));
  add("compiler", TextAt(provenance, "compiler"));
  const Json& inputs = At(provenance, "inputs");
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    add("sha256 of " + TextAt(At(inputs, i), "file"),
        TextAt(At(inputs, i), "sha256"));
  }
  const Json& components = At(results, "components");
  for (std::size_t i = 0; !inputs.is_array() && i < components.size(); ++i) {
    const Json& data = At(At(components, i), "data");
    add("sha256 of " + TextAt(data, "file"), TextAt(data, "sha256"));
  }
  add("libraries", SettingsText(At(provenance, "libraries")));
  const Json& configuration = At(provenance, "configuration");
  if (configuration.is_object()) {
    for (const auto& [key, value] : configuration.items()) {
      add("configuration: " + key, ValueText(value));
    }
  }
  SayIfEmpty("The document does not say where it comes from.", &table);
  return table;
}

}  // namespace errmap::cli
