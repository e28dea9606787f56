#include "data/measurements/reading/read_table.h"

#include <algorithm>
#include <utility>

#include "data/argument_name.h"
#include "data/column_header.h"
#include "data/columns.h"
#include "data/measurements/axis/directions.h"
#include "data/measurements/clock/clock.h"
#include "data/measurements/clock/digit_dates.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/faults/row_faults.h"
#include "data/measurements/reading/derived_columns.h"
#include "data/measurements/reading/merged_cells.h"
#include "data/measurements/reading/table_in_reading.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

constexpr std::size_t kNoTarget = static_cast<std::size_t>(-1);

// What a spreadsheet or a program wrote otherwise than it was meant.
void TakeAsMeant(TableInReading* in) {
  in->read.table = Borrowed(in->given);
  FillMergedCells(&in->read.table);
  in->read.date_parts = WriteDates(&in->read.table);
}

// "-correction_um": the error that a correction is against; or a difference.
void TakeTarget(TableInReading* in) {
  const std::string& target = in->selection.target;
  std::optional<DerivedTarget> derived = FindDerivedTarget(in->given, target);
  if (!derived) return;  // a column, or to be refused by its name
  // In the place of the only one: its values are neither an axis nor an input.
  in->PutColumn(derived->of.value_or(in->table().columns.size()),
                std::move(derived->column));
  if (target.starts_with('-')) in->read.reading.target.sign = -1;
}

// A note in the file may have given the column a unit, which its name lacks.
DatasetSelection WithTargetInFull(const CsvTable& table,
                                  DatasetSelection selection) {
  std::string& target = selection.target;
  if (target.empty() || table.Find(target) >= 0) return selection;
  const std::string sign = target.starts_with('-') ? "-" : "";
  const auto is_meant = [&](const CsvColumn& column) {
    return sign + ReadHeader(column.name).base == target;
  };
  const auto found = std::ranges::find_if(table.columns, is_meant);
  if (std::ranges::count_if(table.columns, is_meant) == 1) {
    target = sign + found->name;
  }
  return selection;
}

// A study names the cycles that were found by the column that they then got.
DatasetSelection WithoutDerivedCycles(const TableInReading& in) {
  DatasetSelection selection = in.selection;
  if (selection.group == kCycleColumn && in.given.Find(kCycleColumn) < 0) {
    selection.group.clear();
  }
  return selection;
}

// Of columns of which the axis was read and commanded, and a target.
void RequireDifferences(const TableInReading& in) {
  const Axis& axis = in.read.axis;
  if (!in.selection.target.empty() || axis.column < 0) return;
  for (const std::size_t measured : axis.measured) {
    RequireDifference(
        in.table(),
        in.read.roles.target,
        {.read = measured, .commanded = static_cast<std::size_t>(axis.column)});
  }
}

void TakeRowsThatPass(TableInReading* in) {
  in->read.passes = RowsThatPass(in->table(), in->read.where);
  const std::vector<bool> is_base = in->IsBaseRow();
  for (std::size_t row = 0; row < is_base.size(); ++row) {
    in->read.passes[row] = in->read.passes[row] && is_base[row];
  }
  if (!in->selection.only_to_judge && !in->clock.DatesRise()) {
    // Rows are compared as given, but for rows put in order and for a target
    // that is a difference of columns given.
    const bool as_given = in->given.num_rows == in->table().num_rows &&
                          in->read.reading.order != "time" &&
                          in->read.roles.target < in->given.columns.size();
    in->read.repeated_rows = RepeatedRows(as_given ? in->given : in->table(),
                                          in->read.roles.target,
                                          in->read.passes);
  }
  if (in->selection.faults == FaultPolicy::kDropRows) {
    for (const Index row : in->read.repeated_rows) {
      in->read.passes[row] = false;
    }
  }
  if (in->selection.with_log) in->read.log_rows = MarkedRows(in->read.passes);
}

// The clock of the rows of the log, which are among the base rows.
SessionClues CluesOfLog(const TableInReading& in) {
  SessionClues clues{.clock = in.clock,
                     .nights = in.nights,
                     .cycles = {in.read.roles.group,
                                in.FirstThatCounts(Counted::kPasses),
                                in.FirstThatCounts(Counted::kElapsed),
                                in.FirstThatCounts(Counted::kWays)},
                     .cycles_in_sessions = in.cycles_in_sessions,
                     .blocks = in.FirstThatCounts(Counted::kBlocks),
                     .ordered = in.ordered,
                     .rows_repeat = !in.read.repeated_rows.empty()};
  const bool has_passes = in.Passes().is_commanded;
  if (in.read.log_rows.size() == in.base_rows.size()) {
    if (has_passes) clues.passes = in.Passes().passes;
    return clues;
  }
  std::vector<Index> places;
  auto at = in.base_rows.begin();
  for (const Index row : in.read.log_rows) {
    at = std::lower_bound(at, in.base_rows.end(), row);
    places.push_back(at - in.base_rows.begin());
  }
  clues.clock.time = in.clock.time(places);
  clues.clock.known.clear();
  for (const Index place : places) {
    const auto i = static_cast<std::size_t>(place);
    clues.clock.known.push_back(in.clock.known[i]);
    if (has_passes) clues.passes.push_back(in.Passes().passes[i]);
  }
  return clues;
}

// Rows that stand twice go back in time, which is not what is wrong.
void FindSessionsOfRows(TableInReading* in) {
  try {
    in->read.found =
        in->selection.only_to_judge
            ? FindSessions(in->table(), in->selection, in->read.log_rows)
            : FindSessions(in->table(),
                           in->selection,
                           in->read.log_rows,
                           CluesOfLog(*in));
  } catch (const InputError&) {
    if (in->read.repeated_rows.empty() ||
        in->selection.faults == FaultPolicy::kDropRows) {
      throw;
    }
    throw InputError(
        PrintablePath(in->table().file) + ": " +
        std::to_string(in->read.repeated_rows.size()) +
        " rows repeat others value for value, the first at line " +
        std::to_string(in->table().LineOfRow(
            static_cast<std::size_t>(in->read.repeated_rows.front()))) +
        "; " + ArgumentName("faults", "drop-rows") + " leaves them out");
  }
}

// Nights that only a clock can tell need all of it.
void RequireClock(const TableInReading& in) {
  const auto& lacks = in.clock.lacks;
  if (!lacks || !in.read.found.sessions.column.empty() ||
      in.read.found.by == "counter") {
    return;
  }
  RefuseMissingCell(
      in.table(), {lacks->first, ColumnUse::kOther}, lacks->second);
}

// The steps from the rows' order to the cycles.
void ReadRowsToLearn(TableInReading* in) {
  PutInOrder(in, RowsFor::kLearning);
  RequireDifferences(*in);
  FindWays(in);
  FindColumnsThatCount(in);
  FindCycles(in);
  FindBlocksInLabels(in);
  if (!in->selection.group.empty() && in->read.roles.group == kNoColumn) {
    RequireColumn(in->table(), in->selection.group, ArgumentName("group"));
  }
}

}  // namespace

ReadTable ReadRoles(const CsvTable& table, const DatasetSelection& given) {
  const DatasetSelection selection = WithTargetInFull(table, given);
  TableInReading in{.given = table, .selection = selection};
  in.read.where = selection.where;
  TakeAsMeant(&in);
  TakeTarget(&in);
  in.read.roles = ChooseRoles(in.table(), WithoutDerivedCycles(in));
  in.read.reading.rows = static_cast<std::int64_t>(table.num_rows);
  ChooseBaseRows(&in);
  if (!selection.only_to_judge) ReadRowsToLearn(&in);
  TakeRowsThatPass(&in);
  if (selection.with_log) {
    FindSessionsOfRows(&in);
    if (!selection.only_to_judge) RequireClock(in);
  }
  if (!selection.only_to_judge) DescribeReading(&in);
  return std::move(in.read);
}

ReadTable ReadRowsForMap(const CsvTable& table,
                         const DatasetSelection& selection) {
  TableInReading in{.given = table, .selection = selection};
  TakeAsMeant(&in);
  const std::ptrdiff_t target = in.table().Find(selection.target);
  in.read.roles.target =
      target < 0 ? kNoTarget : static_cast<std::size_t>(target);
  in.read.roles.group = CycleColumn(in.table());
  in.read.reading.rows = static_cast<std::int64_t>(table.num_rows);
  in.base_rows = AllRows(table.num_rows);
  PutInOrder(&in, RowsFor::kAnswering);
  FindWays(&in);
  FindCycles(&in);
  in.read.log_rows = in.base_rows;
  try {
    FindSessionsOfRows(&in);
  } catch (const InputError&) {
    // A map without a memory needs none; one with it says so later.
  }
  DescribeReading(&in);
  return std::move(in.read);
}

FoundSessions FindSessions(const CsvTable& table,
                           const DatasetSelection& selection,
                           const std::vector<Index>& rows) {
  SessionClues clues{.clock = FindClock(table, selection, rows)};
  const std::ptrdiff_t target = table.Find(selection.target);
  const Axis axis =
      FindAxis(table,
               selection,
               target < 0 ? kNoTarget : static_cast<std::size_t>(target),
               rows);
  clues.ordered = !axis.motion.is_sorted;
  if (clues.ordered) GoOnOverMidnight(table, rows, &clues.clock);
  if (axis.motion.is_commanded) clues.passes = axis.motion.passes;
  clues.nights = FindNights(clues.clock, axis.motion, selection);
  clues.cycles = {CycleColumn(table)};
  return FindSessions(table, selection, rows, std::move(clues));
}

}  // namespace errmap::data
