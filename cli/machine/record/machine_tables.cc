#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "cli/machine/record/machine_record.h"
#include "cli/report/number_text.h"
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

Table TableOfPositioning(
    const MachineRecord& machine,
    const char* title,
    const char* along,
    std::vector<PositioningRecord> MachineChoiceRecord::*member) {
  const Shown shown = ShownUnit(machine);
  Table table{.title = fmt::format("{}, {}", title, shown.symbol)};
  for (const MachineChoiceRecord& choice : machine.choices) {
    for (const PositioningRecord& figures : choice.*member) {
      table.Add({{{along, false}, figures.component},
                 {{"maps", false}, choice.name},
                 {{"A accuracy"}, Length(figures.accuracy, shown)},
                 {{"E systematic"}, Length(figures.systematic, shown)},
                 {{"M mean"}, Length(figures.mean_bidirectional, shown)},
                 {{"B reversal"}, Length(figures.reversal, shown)},
                 {{"R repeatability"}, Length(figures.repeatability, shown)}});
    }
  }
  return table;
}

// How the half-widths of a choice were found.
std::string CalibrationOf(const MachineChoiceRecord& choice) {
  if (choice.held_out.empty()) {
    return "of the components' intervals, taken as independent";
  }
  return fmt::format(
      "from the errors at the tool in sessions {}, each held out in turn",
      data::JoinWords(choice.held_out, ", "));
}

Table ToolTipTable(const MachineRecord& machine) {
  const Shown shown = ShownUnit(machine);
  Table table{
      .title = fmt::format(
          "Error at the tool of {}, {}", machine.name, shown.symbol),
      .note = fmt::format(
          "Tool minus work, length in {}, at the poses of {} in sessions that "
          "no fit saw: {}.{}",
          machine.sensitive,
          machine.points,
          data::JoinWords(machine.later, ", "),
          machine.later.size() < 2
              ? ""
              : " Over days: 95 % interval of the geometric mean of the days' "
                "95th percentiles; -: too few days.")};
  for (const MachineChoiceRecord& choice : machine.choices) {
    if (choice.why) {
      table.note += fmt::format(" {}: {}.", choice.name, *choice.why);
      continue;
    }
    table.Add({{{"maps", false}, choice.name},
               {{"points"}, choice.points},
               {{"RMS"}, Length(choice.rms, shown)},
               {{"95th percentile"}, Length(choice.p95, shown)},
               {{"over days"}, Interval95(choice.p95_ci95, shown)},
               {{"largest"}, Length(choice.max, shown)},
               {{"times smaller"}, Ratio(machine, choice.p95)}});
  }
  return table;
}

Table ToolTipDayTable(const MachineRecord& machine) {
  const Shown shown = ShownUnit(machine);
  Table table{.title =
                  fmt::format("Error at the tool by day, {}", shown.symbol)};
  for (const MachineChoiceRecord& choice : machine.choices) {
    for (const MachineDayRecord& day : choice.days) {
      table.Add({{{"maps", false}, choice.name},
                 {{"session"}, day.session},
                 {{"points"}, day.points},
                 {{"RMS"}, Length(day.rms, shown)},
                 {{"95th percentile"}, Length(day.p95, shown)},
                 {{"largest"}, Length(day.max, shown)},
                 {{"within 90 %: X Y Z"}, Shares(day.within_90)}});
    }
  }
  return table;
}

Table ToolTipIntervalTable(const MachineRecord& machine) {
  const Shown shown = ShownUnit(machine);
  Table table{.title = fmt::format("Stated 90 % intervals of the error at the "
                                   "tool, {}",
                                   shown.symbol),
              .note = "Half-widths, mean over the points."};
  // Of choices that were calibrated alike.
  std::map<std::string, std::vector<std::string>> calibrated;
  for (const MachineChoiceRecord& choice : machine.choices) {
    for (std::size_t d = 0; d < choice.half_width_90.size(); ++d) {
      if (std::isnan(choice.half_width_90[d])) continue;
      std::vector<std::string>& names = calibrated[CalibrationOf(choice)];
      if (names.empty() || names.back() != choice.name) {
        names.push_back(choice.name);
      }
      table.Add(
          {{{"maps", false}, choice.name},
           {{"direction", false}, std::string(1, static_cast<char>('X' + d))},
           {{"half-width"}, Length(choice.half_width_90[d], shown)},
           {{"share within"}, Number{choice.within_90[d], 3}}});
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
  Table table = TableOfPositioning(machine,
                                   "Positioning by ISO 230-2:2014",
                                   "axis",
                                   &MachineChoiceRecord::positioning);
  table.note =
      "Readings of those sessions minus the map: the runs are its "
      "cycles, warm-up included.";
  return table;
}

Table DiagonalTable(const MachineRecord& machine) {
  Table table =
      TableOfPositioning(machine,
                         "Diagonals of the work volume, ISO 230-6:2002",
                         "diagonal",
                         &MachineChoiceRecord::diagonals);
  table.note =
      "The name has the signs of X, Y and Z (n: falling, 0: constant). True "
      "errors in both directions in those sessions, warm-up included.";
  return table;
}

Table MachinePartTable(const MachineRecord& machine) {
  const Shown shown = ShownUnit(machine);
  Table table{
      .title = fmt::format("What each component leaves at the tool, RMS, {}",
                           shown.symbol),
      .note =
          "Readings of those sessions minus the map, noise included, times the "
          "RMS movement of the tool per unit of it.",
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
  Table table{.title = "Maps of the machine"};
  for (const MachineChoiceRecord& choice : machine.choices) {
    for (const MachineMapRecord& map : choice.maps) {
      table.Add({{{"component", false}, map.component},
                 {{"maps", false}, choice.name},
                 {{"model", false}, map.model}});
    }
  }
  return table;
}

// " mostly along X", of the axes of the plane; "" without one.
std::string MainDirection(const MachineRecord& machine) {
  if (!machine.plane) return "";
  double across = 0.0;
  double up = 0.0;
  for (const models::PlaneCell& cell : machine.choices.front().cells) {
    if (std::isnan(cell.mean_across + cell.mean_up)) continue;
    const auto points = static_cast<double>(cell.points);
    across += points * std::abs(cell.mean_across);
    up += points * std::abs(cell.mean_up);
  }
  return ", mostly along " +
         (across > up ? machine.plane->across : machine.plane->up);
}

}  // namespace

std::string MachineAnswer(const MachineRecord& machine) {
  if (machine.choices.empty()) return "";
  const MachineChoiceRecord& before = machine.choices.front();
  const MachineChoiceRecord& after = machine.choices.back();
  const report::ErrorText text(data::UnitOfSymbol(machine.unit), before.max);
  std::string answer =
      fmt::format("Without maps the tool is off by up to {}{}.",
                  text.WithUnit(before.max),
                  MainDirection(machine));
  if (std::isfinite(after.max)) {
    answer += fmt::format(" The {} maps leave up to {}, {:.0f} % {}.",
                          after.name,
                          text.WithUnit(after.max),
                          100.0 * std::abs(1.0 - after.max / before.max),
                          after.max > before.max ? "more" : "less");
  }
  return answer;
}

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
