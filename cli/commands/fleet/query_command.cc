#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/commands/fleet/fleet_commands.h"
#include "cli/commands/format_option.h"
#include "cli/fleet/store/store.h"
#include "cli/json_blocks.h"
#include "cli/report/table.h"
#include "cli/shell/command_options.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/standard_streams.h"

namespace errmap::cli {
namespace {

struct QueryArguments {
  std::string store;
  std::string sql;
  std::string format = "table";
};

Json JsonOf(const fleet::SqlValue& value) {
  return std::visit(
      [](const auto& held) -> Json {
        using Held = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<Held, std::monostate>) {
          return nullptr;
        } else {
          return held;
        }
      },
      value);
}

report::Cell CellOf(const fleet::SqlValue& value) {
  constexpr int kDigits = 6;
  return std::visit(
      [](const auto& held) -> report::Cell {
        using Held = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<Held, std::monostate>) {
          return {};
        } else if constexpr (std::is_same_v<Held, double>) {
          return report::Number{held, kDigits};
        } else {
          return held;
        }
      },
      value);
}

std::string JsonText(fleet::Statement* query) {
  Json columns = Json::array();
  for (int i = 0; i < query->num_columns(); ++i) {
    columns.push_back(query->ColumnName(i));
  }
  Json rows = Json::array();
  while (query->Next()) {
    Json row = Json::array();
    for (int i = 0; i < query->num_columns(); ++i) {
      row.push_back(JsonOf(query->Value(i)));
    }
    rows.push_back(std::move(row));
  }
  return DumpJson({{"schema", "errmap-query-1"},
                   {"columns", std::move(columns)},
                   {"rows", std::move(rows)}});
}

report::Table TableOf(fleet::Statement* query) {
  report::Table table;
  for (int i = 0; i < query->num_columns(); ++i) {
    table.columns.push_back({.name = query->ColumnName(i), .is_number = true});
  }
  while (query->Next()) {
    std::vector<report::Cell>& row = table.rows.emplace_back();
    for (int i = 0; i < query->num_columns(); ++i) {
      const fleet::SqlValue value = query->Value(i);
      if (std::holds_alternative<std::string>(value)) {
        table.columns[static_cast<std::size_t>(i)].is_number = false;
      }
      row.push_back(CellOf(value));
    }
  }
  return table;
}

int RunQuery(const QueryArguments& arguments) {
  fleet::Database store = fleet::OpenStore(fleet::StorePaths{arguments.store});
  store.StopWhere(InstallInterruptFlag());
  try {
    fleet::Statement query = store.PrepareQuery(arguments.sql);
    if (arguments.format == "json") {
      PrintResult(JsonText(&query));
    } else {
      const report::Table table = TableOf(&query);
      const auto text = report::TableText(table, arguments.format);
      PrintResult(text ? *text : report::TerminalTable(table));
    }
  } catch (const fleet::SqliteError& error) {
    if (InstallInterruptFlag()) return kInterrupted;
    throw UsageError(fmt::format(
        "SQL: {}; only one SELECT is allowed, and errmap query STORE \"SELECT "
        "sql FROM sqlite_schema\" shows the tables",
        error.what()));
  }
  return kDone;
}

}  // namespace

void AddQueryCommand(CLI::App* app, Run* run) {
  auto arguments = std::make_shared<QueryArguments>();
  CLI::App* command = AddCommand(
      app, "query", "Ask a fleet's database something in SQL; changes nothing");
  AddOption(
      command, "STORE DIR", arguments->store, "Folder with an errmap.sqlite")
      .Required();
  AddOption(command, "SQL TEXT", arguments->sql, "One SELECT, in quotes")
      .Required();
  AddTableFormatOption(command, "What to print", &arguments->format);
  SetFooter(
      command,
      "The view fleet has a line per component: name, status, choice, model, "
      "before and after\n(RMSE held out without and with the map), goal_"
      "standing, in the unit that it names; the tables\nhave the data file's "
      "own unit. cli/fleet/README.md has ten queries.\nExit status: 0 done, 2 "
      "wrong SQL, 3 no store, or one of a newer errmap.\nExample: errmap query "
      "fleet \"SELECT choice, count(*) FROM recommendations GROUP BY choice\"");
  OnRun(command, [arguments, run] { run->status = RunQuery(*arguments); });
}

}  // namespace errmap::cli
