#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "cli/report/plot.h"
#include "cli/report/tables/report_tables.h"
#include "cli/report/text/answers/verdict_text.h"
#include "data/text.h"
#include "stats/comparison/paired_comparison.h"
#include "stats/error_metrics.h"

namespace errmap::report {
namespace {

using models::ComponentRecord;
using models::FindNamed;
using stats::ErrorMetrics;

// Where a cell stands; `holdout` "": of the model in general.
struct Place {
  const ComponentRecord& component;
  const ModelRecord& model;
  std::string holdout;
  const ResultRecord* result;  // null: failed
};

struct ResultColumn {
  std::string key;  // in files, and in the layouts below
  Cell (*cell)(const Place& place);
  bool is_number = true;
  /// As in Table::Column, on terminals.
  const char* name = "";
  const char* above = "";
  std::size_t gap = 2;
  /// On pages.
  const char* page = "";
  const char* explanation = "";
};

// Not shown to differ in practice from the lowest error of its hold-out.
bool IsInterchangeable(const Place& place) {
  return place.result != nullptr && place.result->tier == 1;
}

Cell Interchangeable(const Place& place) {
  if (place.result == nullptr) return {};
  return IsInterchangeable(place) ? "yes" : "no";
}

// That the model differs from the recommended one.
Cell Established(const Place& place) {
  const auto& advice = place.component.recommendation;
  if (!advice || advice->model == place.model.name) return {};
  const models::PairRecord* pair =
      FindPair(place.component, place.holdout, advice->model, place.model.name);
  if (pair == nullptr) return {};
  return pair->established ? "yes" : "no";
}

template <std::size_t kEnd>
Cell EndOfInterval(const Place& place) {
  if (place.result == nullptr) return {};
  return Error{place.result->ci95[kEnd], place.component.display.scale};
}

Cell Known(double value) { return std::isnan(value) ? Cell() : Number{value}; }

template <ErrorMetrics ResultRecord::*kRows, auto kFigure>
Cell Metric(const Place& place) {
  if (place.result == nullptr) return {};
  const auto value = (place.result->*kRows).*kFigure;
  if constexpr (std::integral<std::remove_const_t<decltype(value)>>) {
    return value;
  } else if constexpr (kFigure == &ErrorMetrics::r2) {
    return Known(value);
  } else {
    return Error{value, place.component.display.scale};
  }
}

Cell ModelName(const Place& place) {
  const std::string& name = place.model.name;
  const std::string shown = data::Printable(name);
  // Beside the recommended one stand those that are as good.
  const auto& advice = place.component.recommendation;
  const char* const mark = advice && advice->model == name ? "* "
                           : IsInterchangeable(place)      ? "= "
                                                           : "  ";
  return Word{name, mark + shown, name};
}

Cell Status(const Place& place) {
  return ToString(place.result != nullptr ? models::ModelStatus::kOk
                                          : models::ModelStatus::kFailed);
}

Cell SensorCount(const Place& place) {
  if (!place.model.sensors) return {};
  return static_cast<std::int64_t>(place.model.sensors->size());
}

Cell TrainingRmse(const Place& place) {
  if (place.result == nullptr) return "failed";
  return Metric<&ResultRecord::train, &ErrorMetrics::rmse>(place);
}

Cell RmseInterval(const Place& place) {
  if (place.result == nullptr) return {};
  return Interval{place.result->ci95};
}

Cell RmseWithInterval(const Place& place) {
  if (place.result != nullptr) {
    return Interval{place.result->ci95, place.result->test.rmse};
  }
  return place.model.status == models::ModelStatus::kFailed ? "failed" : Cell();
}

Cell Tier(const Place& place) {
  return place.result != nullptr ? Cell(place.result->tier) : Cell();
}

// How many times its error among neighbours a model has on unseen groups.
Cell Gap(const Place& place) {
  const auto& gap = place.component.gap;
  if (!gap) return {};
  const auto row = std::ranges::find(
      gap->models, place.model.name, &models::InterpolationGap::Row::model);
  if (row == gap->models.end()) return {};
  constexpr double kLarge = 1000.0;
  if (row->ratio < kLarge) return Fixed{row->ratio, 1};
  return Number{row->ratio, 1};
}

Cell Goal(const Place& place) {
  if (place.result == nullptr) return {};
  switch (place.result->goal_standing) {
    case models::GoalStanding::kMet:
      return "yes";
    case models::GoalStanding::kMetAfterRezeroing:
      return Word{"after re-zeroing", "re-zeroed", "after re-zeroing"};
    case models::GoalStanding::kMissed:
      return "no";
    default:
      return {};
  }
}

// Of the rows that were scored, without re-zeroing.
Cell NeverRezeroed(const Place& place) {
  const auto& rezero = place.component.rezero;
  if (!rezero || rezero->holdout != place.holdout) return {};
  const auto found = std::ranges::find(
      rezero->models, place.model.name, &models::RezeroedModelRecord::model);
  if (found == rezero->models.end()) return {};
  return Error{found->never, place.component.display.scale};
}

double FoldSeconds(const ResultRecord& result) {
  double seconds = 0.0;
  for (const models::FoldRecord& fold : result.folds) {
    seconds += fold.fit.value.fit_seconds;
  }
  return seconds;
}

Cell FitSeconds(const Place& place) {
  return place.result != nullptr ? Number{FoldSeconds(*place.result)} : Cell();
}

Cell AllFitSeconds(const Place& place) {
  double seconds = place.model.final ? place.model.final->fit_seconds : 0.0;
  for (const auto& [holdout, result] : place.model.results) {
    seconds += FoldSeconds(result);
  }
  return Fixed{seconds, 3};
}

Cell PredictNs(const Place& place) {
  if (std::isnan(place.model.predict_ns)) return {};
  return Fixed{place.model.predict_ns, 0};
}

Cell PAgainstRecommended(const Place& place) {
  const auto& advice = place.component.recommendation;
  if (!advice) return {};
  if (place.model.name == advice->model) {
    return Word{"recommended", "", "recommended"};
  }
  const models::PairRecord* pair =
      FindPair(place.component, place.holdout, advice->model, place.model.name);
  if (pair == nullptr) return {};
  return CorrectedP(*pair, pair->established ? ", established" : "");
}

Cell UnitOf(const Place& place) {
  const std::string& shown = place.component.display.unit;
  return Word{shown, shown, place.component.data.unit};
}

// Of the rows trained on or held out: "train_rmse", ...
template <ErrorMetrics ResultRecord::*kRows>
void AddMetrics(const std::string& rows, std::vector<ResultColumn>* columns) {
  columns->insert(
      columns->end(),
      {{.key = rows + "_n", .cell = &Metric<kRows, &ErrorMetrics::n>},
       {.key = rows + "_rmse",
        .cell = &Metric<kRows, &ErrorMetrics::rmse>,
        .name = "RMSE",
        .page = "RMSE"},
       {.key = rows + "_mean", .cell = &Metric<kRows, &ErrorMetrics::mean>},
       {.key = rows + "_sd", .cell = &Metric<kRows, &ErrorMetrics::sd>},
       {.key = rows + "_mae", .cell = &Metric<kRows, &ErrorMetrics::mae>},
       {.key = rows + "_min", .cell = &Metric<kRows, &ErrorMetrics::min>},
       {.key = rows + "_max", .cell = &Metric<kRows, &ErrorMetrics::max>},
       {.key = rows + "_range", .cell = &Metric<kRows, &ErrorMetrics::range>},
       {.key = rows + "_r2", .cell = &Metric<kRows, &ErrorMetrics::r2>}});
}

// Every column there is. A new one is declared here and named in the layouts
// below that show it.
const std::vector<ResultColumn>& Columns() {
  static const std::vector<ResultColumn> columns = [] {
    std::vector<ResultColumn> all{
        {.key = "component",
         .cell = [](const Place& p) -> Cell { return p.component.name; },
         .is_number = false},
        {.key = "holdout",
         .cell = [](const Place& p) -> Cell { return p.holdout; },
         .is_number = false},
        {.key = "model",
         .cell = &ModelName,
         .is_number = false,
         .name = "  model",
         .page = "model"},
        {.key = "kind",
         .cell = [](const Place& p) -> Cell { return ToString(p.model.kind); },
         .is_number = false},
        {.key = "status", .cell = &Status, .is_number = false},
        {.key = "parameters",
         .cell = [](const Place& p) -> Cell { return p.model.parameters; },
         .name = "parameters",
         .page = "parameters"},
        {.key = "sensors",
         .cell = &SensorCount,
         .name = "sensors",
         .page = "sensors"},
        {.key = "training", .cell = &TrainingRmse, .name = "training"},
        {.key = "ci95", .cell = &RmseInterval, .name = "95 %", .gap = 1},
        {.key = "test_ci95_low", .cell = &EndOfInterval<0>},
        {.key = "test_ci95_high", .cell = &EndOfInterval<1>},
        {.key = "error", .cell = &RmseWithInterval, .page = "RMSE"},
        {.key = "tier", .cell = &Tier, .name = "tier", .page = "tier"},
        {.key = "interchangeable",
         .cell = &Interchangeable,
         .is_number = false},
        {.key = "gap", .cell = &Gap, .name = "ratio"},
        {.key = "goal",
         .cell = &Goal,
         .is_number = false,
         .name = "goal",
         .page = "goal"},
        {.key = "never_rezeroed",
         .cell = &NeverRezeroed,
         .name = "no re-zero",
         .page = "never re-zeroed",
         .explanation = "RMSE"},
        {.key = "p_recommended", .cell = &PAgainstRecommended, .name = "p"},
        {.key = "established", .cell = &Established, .is_number = false},
        {.key = "fit_seconds", .cell = &FitSeconds},
        {.key = "all_fit_seconds",
         .cell = &AllFitSeconds,
         .name = "s",
         .above = "fit"},
        {.key = "predict_ns",
         .cell = &PredictNs,
         .name = "ns",
         .above = "predict",
         .page = "predict, ns"},
        {.key = "unit", .cell = &UnitOf, .is_number = false}};
    AddMetrics<&ResultRecord::test>("test", &all);
    AddMetrics<&ResultRecord::train>("train", &all);
    return all;
  }();
  return columns;
}

const ResultColumn& ColumnOf(std::string_view key) {
  return *std::ranges::find(Columns(), key, &ResultColumn::key);
}

// A column of a table: of one hold-out, or "": of each row's, or of none; with
// a name of its own, or "".
struct Slot {
  const ResultColumn* column;
  std::string holdout;
  std::string name;
};

std::vector<Slot> SlotsOf(std::initializer_list<const char*> keys,
                          const std::string& holdout = "",
                          const std::string& name = "") {
  std::vector<Slot> slots;
  for (const char* key : keys) slots.push_back({&ColumnOf(key), holdout, name});
  return slots;
}

void Append(std::vector<Slot> more, std::vector<Slot>* slots) {
  slots->insert(slots->end(), more.begin(), more.end());
}

void AddRow(const ComponentRecord& component,
            const ModelRecord& model,
            const std::vector<Slot>& slots,
            const std::string& holdout,
            Table* table) {
  std::vector<Cell>& row = table->rows.emplace_back();
  for (const Slot& slot : slots) {
    const std::string& of = slot.holdout.empty() ? holdout : slot.holdout;
    row.push_back(
        slot.column->cell({component, model, of, ResultOf(model, of)}));
  }
}

// A row of each of these models.
void AddRows(const ReportView& view,
             const std::vector<const ModelRecord*>& models,
             const std::vector<Slot>& slots,
             const std::string& holdout,
             Table* table) {
  for (const ModelRecord* model : models) {
    if (model->name == view.recommended) table->marked = table->rows.size();
    AddRow(*view.component, *model, slots, holdout, table);
  }
}

// As terminals show it, with the columns' own names.
Table TerminalRows(const ReportView& view,
                   const std::vector<const ModelRecord*>& models,
                   const std::vector<Slot>& slots,
                   const std::string& holdout) {
  Table table{.error = ErrorTextOf(*view.component)};
  for (const Slot& slot : slots) {
    table.columns.push_back(
        {.name = slot.name.empty() ? slot.column->name : slot.name,
         .is_number = slot.column->is_number,
         .above = slot.column->above,
         .gap = slot.column->gap});
  }
  AddRows(view, models, slots, holdout, &table);
  return table;
}

std::vector<std::string> HoldoutNames(const ComponentRecord& component) {
  std::vector<std::string> names;
  for (const models::HoldoutRecord& holdout : component.holdouts) {
    names.push_back(holdout.name);
  }
  return names;
}

}  // namespace

Cell CorrectedP(const models::PairRecord& pair, const char* after) {
  const double least = pair.smallest_p * static_cast<double>(pair.holm_pairs);
  if (least > stats::kSignificance && !pair.established) return {};
  return P{pair.p_holm, after};
}

Table LeaderboardRows(const models::StudyRecord& record) {
  const std::vector<Slot> slots = SlotsOf(
      {"component",       "holdout",    "model",         "kind",
       "status",          "parameters", "test_n",        "test_rmse",
       "test_mean",       "test_sd",    "test_mae",      "test_min",
       "test_max",        "test_range", "test_r2",       "train_n",
       "train_rmse",      "train_mean", "train_sd",      "train_mae",
       "train_min",       "train_max",  "train_range",   "train_r2",
       "fit_seconds",     "predict_ns", "test_ci95_low", "test_ci95_high",
       "interchangeable", "gap",        "sensors",       "goal",
       "established",     "unit"});
  Table table{.nothing = ""};
  for (const Slot& slot : slots) {
    table.columns.push_back({slot.column->key, slot.column->is_number});
  }
  for (const ComponentRecord& component : record.components) {
    for (const std::string& holdout : HoldoutNames(component)) {
      for (const ModelRecord& model : component.models) {
        AddRow(component, model, slots, holdout, &table);
      }
    }
  }
  return table;
}

std::string DrawnRowsWords(const ReportView& view) {
  std::vector<std::string> names;
  std::int64_t most = 0;
  for (const ModelRecord* model : view.models) {
    if (!model->final || !model->final->choices) continue;
    for (const auto& [option, value] : *model->final->choices) {
      if (option != "rows") continue;
      names.push_back(model->name);
      most = std::max(most, std::get<std::int64_t>(value));
    }
  }
  if (names.empty()) return "";
  return fmt::format("{} trained on {} of {} rows (rows=all uses all).",
                     data::JoinWords(names, ", "),
                     most,
                     view.component->data.rows);
}

std::string StandInWords(const ReportView& view, std::size_t most_rows) {
  constexpr std::string_view kOfATemperature = "poly:temperature";
  const std::size_t shown = std::min(most_rows, view.models.size());
  for (const ModelRecord* model : std::span(view.models).first(shown)) {
    const auto& inputs = model->inputs_used;
    if (model->name != kOfATemperature || !inputs || inputs->size() != 1 ||
        !model->sensors || !model->sensors->empty()) {
      continue;
    }
    const std::string& input = inputs->front();
    return fmt::format("{} is a line over {}, as there is no thermometer.",
                       model->name,
                       data::Printable(input));
  }
  return "";
}

Table TerminalLeaderboard(const ReportView& view, std::size_t most_rows) {
  const ComponentRecord& component = *view.component;
  std::vector<Slot> slots = SlotsOf({"model", "sensors"});
  Append(SlotsOf({"test_rmse", "ci95"}, view.decisive), &slots);
  // 80 columns hold one of the two and the models' names.
  if (component.rezero) {
    Append(SlotsOf({"never_rezeroed"}, view.decisive), &slots);
  } else if (const std::string& other = view.neighbours; !other.empty()) {
    Append(SlotsOf({"test_rmse"}, other, UnseenWords(view, other)), &slots);
  }
  if (!view.later.empty()) {
    Append(SlotsOf({"test_rmse"}, view.later, "later"), &slots);
  }
  if (std::isfinite(component.goal)) {
    Append(SlotsOf({"goal"}, view.decisive), &slots);
  }
  // The recommended one is always in the table.
  std::vector<const ModelRecord*> models = view.models;
  if (const auto recommended =
          std::ranges::find(models, view.recommended, &ModelRecord::name);
      recommended - models.begin() >= static_cast<std::ptrdiff_t>(most_rows) &&
      recommended != models.end()) {
    std::rotate(models.begin() + static_cast<std::ptrdiff_t>(most_rows) - 1,
                recommended,
                recommended + 1);
  }
  models.resize(std::min(models.size(), most_rows));
  Table table = TerminalRows(view, models, slots, view.decisive);
  const std::string symbol = table.error->symbol();
  for (const std::size_t unseen : {2, 3}) {
    table.columns[unseen].group = UnseenWords(view, view.decisive) +
                                  (symbol.empty() ? "" : ", " + symbol);
  }
  return table;
}

Table TerminalDetails(const ReportView& view, const std::string& holdout) {
  const std::vector<Slot> slots = SlotsOf(
      {"model", "training", "test_rmse", "ci95", "tier", "p_recommended"});
  return TerminalRows(view, view.models, slots, holdout);
}

Table TerminalTimes(const ReportView& view) {
  std::vector<Slot> slots = SlotsOf({"model", "parameters"});
  if (view.component->gap) Append(SlotsOf({"gap"}), &slots);
  Append(SlotsOf({"all_fit_seconds", "predict_ns"}), &slots);
  return TerminalRows(view, view.models, slots, "");
}

Table SummaryRows(const models::StudyRecord& record) {
  Table table{.columns = {{.name = "component", .is_number = false},
                          {.name = "use", .is_number = false},
                          {.name = "RMSE"},
                          {.name = "95 %", .gap = 1},
                          {.name = "proven", .is_number = false},
                          {.name = "goal", .is_number = false}}};
  for (const ComponentRecord& component : record.components) {
    const std::string name = data::Printable(component.name);
    const auto& advice = component.recommendation;
    const ModelRecord* found =
        advice ? FindNamed(component.models, advice->model) : nullptr;
    if (found == nullptr) {
      table.rows.push_back({name, "nothing"});
      table.rows.back().resize(table.columns.size());
      continue;
    }
    const ErrorText error = ErrorTextOf(component);
    const ModelRecord& model = *found;
    std::string interval = "-";
    if (std::isfinite(advice->ci95[0])) {
      interval =
          fmt::format("{}-{}", error(advice->ci95[0]), error(advice->ci95[1]));
    }
    table.rows.push_back(
        {name,
         data::Printable(advice->model),
         error.WithUnit(advice->rmse),
         interval,
         !advice->against_baseline || model.choice == models::Choice::kBaseline
             ? "-"
         : *advice->against_baseline == models::Confidence::kEstablished ? "yes"
                                                                         : "no",
         Goal({component,
               model,
               advice->holdout,
               ResultOf(model, advice->holdout)})});
  }
  return table;
}

Table PageLeaderboard(const ReportView& view) {
  const std::string& decisive = view.decisive;
  std::vector<Slot> slots = SlotsOf({"model"});
  Append(SlotsOf({"error"}, decisive), &slots);
  for (const std::string& holdout : view.holdouts) {
    if (holdout != decisive) Append(SlotsOf({"test_rmse"}, holdout), &slots);
  }
  if (view.component->rezero) {
    Append(SlotsOf({"never_rezeroed"}, decisive), &slots);
  }
  Append(SlotsOf({"goal"}, decisive), &slots);
  Append(SlotsOf({"sensors", "parameters", "predict_ns"}), &slots);
  Table table;
  table.error = ErrorTextOf(view);
  for (const Slot& slot : slots) {
    const ResultColumn& column = *slot.column;
    const bool is_error = std::string_view(column.page) == "RMSE";
    table.columns.push_back(
        {.name = is_error ? WithUnit(slot.holdout + " RMSE", view.shown_unit)
                          : column.page,
         .is_number = column.is_number,
         .explanation =
             is_error ? UnseenWords(view, slot.holdout) : column.explanation});
    if (column.key != "error") continue;
    table.columns.back().explanation += "; 95 % interval";
  }
  AddRows(view, view.models, slots, "", &table);
  for (const ModelRecord* model : view.models) {
    if (!model->why) continue;
    table.note += fmt::format("{} failed: {}. ", model->name, *model->why);
  }
  if (const std::string drawn = DrawnRowsWords(view); !drawn.empty()) {
    table.note += drawn + " ";
  }
  if (const std::string other = StandInWords(view, view.models.size());
      !other.empty()) {
    table.note += other + " ";
  }
  table.note += fmt::format("{}.", kIntervalCoverage);
  table.SayIfEmpty("No model was fitted.");
  return table;
}

}  // namespace errmap::report
