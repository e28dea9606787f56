#include "cli/machine/record/machine_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "data/text.h"
#include "data/units.h"

namespace errmap::machine {
namespace {

using report::Cell;
using report::Number;
using report::Table;

// As people read lengths.
struct Shown {
  double scale;
  std::string symbol;
};

Shown ShownUnit(const MachineRecord& machine) {
  const data::Unit unit = data::UnitOfSymbol(machine.unit);
  return {unit.display_scale, unit.display_symbol};
}

Cell Length(double value, const Shown& shown) {
  return Number{value, 3, shown.scale};
}

// "0.92 0.95 0.90"
Cell Shares(const ByDirectionRecord& shares) {
  if (std::isnan(shares[0] + shares[1] + shares[2])) return Cell();
  return fmt::format("{:.2f} {:.2f} {:.2f}", shares[0], shares[1], shares[2]);
}

Cell Interval95(const std::array<double, 2>& ends, const Shown& shown) {
  if (std::isnan(ends[0] + ends[1])) return Cell();
  return fmt::format(
      "{:.3g} to {:.3g}", shown.scale * ends[0], shown.scale * ends[1]);
}

// How many times smaller the 95th percentile is than without compensation.
Cell Ratio(const MachineRecord& machine, double p95) {
  return Number{machine.choices.front().p95 / p95, 3};
}

Table PositioningColumns(const MachineRecord& machine, const char* title) {
  return {.title = fmt::format("{}, {}", title, ShownUnit(machine).symbol),
          .columns = {{"axis", false},
                      {"maps", false},
                      {"A accuracy"},
                      {"E systematic"},
                      {"M mean"},
                      {"B reversal"},
                      {"R repeatability"}}};
}

void AddPositioning(const MachineRecord& machine,
                    std::vector<PositioningRecord> MachineChoiceRecord::*member,
                    Table* table) {
  const Shown shown = ShownUnit(machine);
  for (const MachineChoiceRecord& choice : machine.choices) {
    for (const PositioningRecord& figures : choice.*member) {
      table->rows.push_back({figures.component,
                             choice.name,
                             Length(figures.accuracy, shown),
                             Length(figures.systematic, shown),
                             Length(figures.mean_bidirectional, shown),
                             Length(figures.reversal, shown),
                             Length(figures.repeatability, shown)});
    }
  }
}

// How the half-widths of a choice were found.
std::string CalibrationOf(const MachineChoiceRecord& choice) {
  if (choice.held_out.empty()) {
    return "of the components' intervals, taken as independent";
  }
  return fmt::format(
      "by the errors at the tool on {}, each session held out of the fits in "
      "its turn",
      data::JoinWords(choice.held_out, ", "));
}

Table ToolTipTable(const MachineRecord& machine) {
  const Shown shown = ShownUnit(machine);
  Table table{
      .title = fmt::format(
          "Error at the tool of {}, {}", machine.name, shown.symbol),
      .note = fmt::format(
          "Tool less work, length in {}, at the poses of {} on sessions that "
          "no fit saw ({}).{}",
          machine.sensitive,
          machine.points,
          data::JoinWords(machine.later, ", "),
          machine.later.size() < 2
              ? ""
              : " Over days: 95 % interval of the geometric mean of the days' "
                "95th percentiles."),
      .columns = {{"maps", false},
                  {"points"},
                  {"RMS"},
                  {"95th percentile"},
                  {"over days"},
                  {"largest"},
                  {"times smaller"}}};
  for (const MachineChoiceRecord& choice : machine.choices) {
    if (choice.why) {
      table.note += fmt::format(" {}: {}.", choice.name, *choice.why);
      continue;
    }
    table.rows.push_back({choice.name,
                          choice.points,
                          Length(choice.rms, shown),
                          Length(choice.p95, shown),
                          Interval95(choice.p95_ci95, shown),
                          Length(choice.max, shown),
                          Ratio(machine, choice.p95)});
  }
  return table;
}

Table ToolTipDayTable(const MachineRecord& machine) {
  const Shown shown = ShownUnit(machine);
  Table table{
      .title = fmt::format("Error at the tool by day, {}", shown.symbol),
      .columns = {{"maps", false},
                  {"session"},
                  {"points"},
                  {"RMS"},
                  {"95th percentile"},
                  {"largest"},
                  {"within 90 %: X Y Z"}}};
  for (const MachineChoiceRecord& choice : machine.choices) {
    for (const MachineDayRecord& day : choice.days) {
      table.rows.push_back({choice.name,
                            day.session,
                            day.points,
                            Length(day.rms, shown),
                            Length(day.p95, shown),
                            Length(day.max, shown),
                            Shares(day.within_90)});
    }
  }
  return table;
}

Table ToolTipIntervalTable(const MachineRecord& machine) {
  const Shown shown = ShownUnit(machine);
  Table table{.title = fmt::format("Stated 90 % intervals of the error at the "
                                   "tool, {}",
                                   shown.symbol),
              .note = "Half-widths, mean over the points.",
              .columns = {{"maps", false},
                          {"direction", false},
                          {"half-width"},
                          {"share within"}}};
  // Of choices that were calibrated alike.
  std::map<std::string, std::vector<std::string>> calibrated;
  for (const MachineChoiceRecord& choice : machine.choices) {
    for (std::size_t d = 0; d < choice.half_width_90.size(); ++d) {
      if (std::isnan(choice.half_width_90[d])) continue;
      std::vector<std::string>& names = calibrated[CalibrationOf(choice)];
      if (names.empty() || names.back() != choice.name) {
        names.push_back(choice.name);
      }
      table.rows.push_back({choice.name,
                            std::string(1, static_cast<char>('X' + d)),
                            Length(choice.half_width_90[d], shown),
                            Number{choice.within_90[d], 3}});
    }
  }
  for (const auto& [how, names] : calibrated) {
    table.note +=
        calibrated.size() == 1
            ? fmt::format(" They are {}.", how)
            : fmt::format(" {}: {}.", data::JoinWords(names, ", "), how);
  }
  return table;
}

Table PositioningTable(const MachineRecord& machine) {
  Table table = PositioningColumns(machine, "Positioning by ISO 230-2:2014");
  table.note =
      "Of the readings of those sessions, less the map: the runs are its "
      "cycles, warm-up included.";
  AddPositioning(machine, &MachineChoiceRecord::positioning, &table);
  return table;
}

Table DiagonalTable(const MachineRecord& machine) {
  Table table = PositioningColumns(
      machine, "Diagonals of the work volume, ISO 230-6:2002");
  table.columns.front().name = "diagonal";
  table.note =
      "Named by the signs of X, Y and Z along it (n: falling, 0: standing); "
      "true errors along it, both ways, runs of those sessions, warm-up "
      "included.";
  AddPositioning(machine, &MachineChoiceRecord::diagonals, &table);
  return table;
}

Table MachinePartTable(const MachineRecord& machine) {
  const Shown shown = ShownUnit(machine);
  Table table{
      .title = fmt::format("What each component leaves at the tool, RMS, {}",
                           shown.symbol),
      .note =
          "Readings of those sessions less the map, noise included, times the "
          "RMS of what one unit of it moves the tool by.",
      .columns = {{"component", false}}};
  std::vector<const MachineChoiceRecord*> shown_choices;
  for (const MachineChoiceRecord& choice : machine.choices) {
    if (choice.parts.empty()) continue;
    table.columns.push_back({choice.name});
    shown_choices.push_back(&choice);
  }
  if (shown_choices.empty()) return table;
  // In the order of the last choice, which is the one that is advised.
  for (const MachinePartRecord& part : shown_choices.back()->parts) {
    std::vector<Cell> row = {part.error};
    for (const MachineChoiceRecord* choice : shown_choices) {
      const auto found = std::ranges::find(
          choice->parts, part.error, &MachinePartRecord::error);
      row.push_back(found == choice->parts.end() ? Cell()
                                                 : Length(found->rms, shown));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table MachineMapTable(const MachineRecord& machine) {
  Table table{
      .title = "Maps of the machine",
      .columns = {{"component", false}, {"maps", false}, {"model", false}}};
  for (const MachineChoiceRecord& choice : machine.choices) {
    for (const MachineMapRecord& map : choice.maps) {
      table.rows.push_back({map.component, choice.name, map.model});
    }
  }
  return table;
}

}  // namespace

std::vector<Table> MachineTables(const MachineRecord& machine) {
  return {ToolTipTable(machine),
          ToolTipDayTable(machine),
          ToolTipIntervalTable(machine),
          PositioningTable(machine),
          DiagonalTable(machine),
          MachinePartTable(machine),
          MachineMapTable(machine)};
}

std::vector<Table> ScreenTables(const MachineRecord& machine) {
  return {ToolTipTable(machine),
          ToolTipIntervalTable(machine),
          PositioningTable(machine),
          DiagonalTable(machine)};
}

}  // namespace errmap::machine
