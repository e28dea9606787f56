#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "cli/report/text/answers/data_words.h"
#include "cli/report/wrap_text.h"
#include "cli/study_setup/study_options.h"
#include "cli/study_setup/toml/study_file.h"
#include "cli/study_setup/toml/toml_text.h"
#include "data/measurements/column_roles.h"
#include "data/text.h"
#include "stats/holdout.h"

namespace errmap::study_setup {
namespace {

using Filters = std::vector<data::ColumnFilter>;

// The distinct combinations of values of these columns, as they appear.
std::vector<Filters> Combinations(
    const data::CsvTable& table,
    const std::vector<const data::CsvColumn*>& columns) {
  std::vector<Filters> combinations;
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    Filters filters;
    for (const data::CsvColumn* column : columns) {
      const double number = column->values[row];
      if (std::isnan(number)) {
        filters.push_back({column->name, table.CellText(*column, row)});
      } else {
        filters.push_back({column->name, number});
      }
    }
    if (std::ranges::find(combinations, filters) == combinations.end()) {
      combinations.push_back(std::move(filters));
    }
  }
  return combinations;
}

std::string WhereText(const Filters& filters) {
  std::vector<std::string> parts;
  for (const data::ColumnFilter& filter : filters) {
    const auto* const text = std::get_if<std::string>(&filter.value);
    parts.push_back(TomlKey(filter.column) + " = " +
                    (text != nullptr ? TomlText(*text) : ValueText(filter)));
  }
  return fmt::format("{{ {} }}", data::JoinWords(parts, ", "));
}

std::string Commented(const std::string& text) {
  std::string commented = "# ";
  for (const char c : text) {
    commented += c;
    if (c == '\n') commented += "# ";
  }
  return commented;
}

// A list of the study, or those of the first component as a comment.
std::string ListKey(const char* key,
                    const std::vector<std::string>& list,
                    const std::vector<std::string>& of_first) {
  if (!list.empty()) return fmt::format("{} = {}\n", key, TomlList(list));
  return "# Not set, since they differ between components.\n" +
         Commented(fmt::format("{} = {}", key, TomlList(of_first))) + "\n";
}

std::string StudyKeys(const StudyPlan& plan) {
  constexpr std::size_t kWidth = 78;
  std::string text = fmt::format(
      "seed = {}   # of all random choices\n\n"
      "{}\n",
      plan.config.seed,
      Commented(report::WrapText(
          "Rows to judge by: " + stats::HoldoutFormsText() +
              ". Whole held-out sessions show the error on another day.",
          kWidth)));
  text += ListKey(
      "holdouts", plan.config.holdouts, plan.components.front().HoldoutNames());
  text +=
      "\n# Maps to compare; those with options may have a [[model]] each,\n"
      "# see the end of this file.\n";
  text += ListKey(
      "models", plan.config.models, plan.components.front().ModelNames());
  text += fmt::format(
      "{}rezero = {}   # judge maps that are re-zeroed this often\n",
      plan.config.rezero.empty() ? "# " : "",
      TomlText(plan.config.rezero.empty() ? "2h:noise=0.5um"
                                          : plan.config.rezero));
  return text;
}

std::string FoundText(const models::ComponentPlan& component) {
  const data::PreparedDataset& prepared = component.comparison.data;
  const data::Dataset& dataset = prepared.dataset;
  std::string text = "# " + report::Count(dataset.num_rows(), "row") +
                     data::Printable(report::UnitsWords(dataset));
  if (!dataset.has_groups()) text += ": name the column of cycles with group";
  text += "\n";
  for (const data::DroppedColumn& dropped : prepared.dropped) {
    text += fmt::format("# {} is left out: {}\n",
                        data::Printable(dropped.column),
                        data::Printable(dropped.why));
  }
  return text;
}

// By key the lines of what the data were found to be; the others get examples.
std::map<std::string_view, std::string> FoundKeys(
    const data::PreparedDataset& prepared) {
  const data::Dataset& dataset = prepared.dataset;
  std::map<std::string_view, std::string> lines = {
      {"inputs",
       "# All that were found; without # exactly these.\n" +
           Commented("inputs = " + TomlList(dataset.InputNames()))}};
  const auto add = [&](const char* key, const std::string& column) {
    if (column.empty()) return;
    lines[key] = fmt::format("{} = {}", key, TomlText(column));
  };
  add("target", dataset.target().name);
  if (dataset.has_groups()) add("group", dataset.groups().column);
  add("session", dataset.log()->sessions.column);
  add("time", prepared.time_column);
  if (dataset.align() == data::Alignment::kFirst) {
    lines["align"] =
        "align = \"first\"   # subtract each session's first value";
  }
  return lines;
}

std::string LengthKey(const char* key,
                      double value,
                      const std::string& example,
                      const data::Unit& unit,
                      const char* what) {
  const bool is_given = std::isfinite(value);
  const std::string& symbol = unit.symbol;
  return fmt::format("{}{} = {}   # {}{}{}\n",
                     is_given ? "" : "# ",
                     key,
                     is_given ? fmt::format("{}", value) : example,
                     what,
                     symbol.empty() ? "" : "; a bare number is in ",
                     symbol);
}

std::string ComponentText(const models::ComponentPlan& component,
                          const ComponentConfig& config,
                          const std::string& data) {
  const data::Dataset& dataset = component.comparison.data.dataset;
  const data::Unit& unit = dataset.target().unit;
  std::string text = "\n[[component]]\n" + FoundText(component);
  text += "name = " + TomlText(config.name) + "\n";
  text += "data = " + TomlText(data) + "   # beside this file\n";
  text += config.selection.where.empty()
              ? std::string(
                    "# where = { direction = \"down\" }   # only rows "
                    "with this value\n")
              : "where = " + WhereText(config.selection.where) + "\n";
  const std::map<std::string_view, std::string> found =
      FoundKeys(component.comparison.data);
  ForSelectionOptions(config.selection,
                      [&](const StudyOption& option, const auto&... /*said*/) {
                        const auto at = found.find(option.key);
                        text += at == found.end()
                                    ? fmt::format("# {}\n", option.example)
                                    : at->second + "\n";
                      });
  text +=
      LengthKey("goal",
                component.comparison.goal,
                unit.quantity == data::Quantity::kLength ? "\"2um\"" : "0.5",
                unit,
                "RMSE wanted on held-out rows");
  text += LengthKey("indifference",
                    component.comparison.indifference,
                    "0",
                    unit,
                    "a difference in RMSE that does not matter");
  return text;
}

}  // namespace

StudyConfig ProposeStudy(const data::CsvTable& table) {
  constexpr std::size_t kMostComponents = 100;
  std::vector<const data::CsvColumn*> parting;
  for (const data::CsvColumn& column : table.columns) {
    if (data::PartsComponents(table, column)) parting.push_back(&column);
  }
  std::vector<Filters> combinations = Combinations(table, parting);
  if (combinations.size() > kMostComponents) combinations = {Filters{}};
  StudyConfig config;
  for (Filters& where : combinations) {
    ComponentConfig component;
    component.data = table.file;
    component.selection.where = std::move(where);
    config.components.push_back(std::move(component));
  }
  return config;
}

std::string StudyFileText(const StudyPlan& plan,
                          const std::string& data,
                          const std::string& usage) {
  std::string text =
      "# A study for errmap: " + usage +
      "\n# Keys after # are examples or defaults. Lengths are in the "
      "target's unit.\n\n";
  text += StudyKeys(plan);
  for (std::size_t i = 0; i < plan.components.size(); ++i) {
    text += ComponentText(plan.components[i], plan.config.components[i], data);
  }
  return text +
         "\n# [[model]]\n"
         "# use = \"poly:stepwise\"\n"
         "# criterion = \"bic\"\n"
         "# degree = 2\n";
}

}  // namespace errmap::study_setup
