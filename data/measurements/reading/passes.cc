#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "data/argument_name.h"
#include "data/columns.h"
#include "data/measurements/axis/directions.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/reading/derived_columns.h"
#include "data/measurements/reading/table_in_reading.h"
#include "data/text.h"

namespace errmap::data {

using Eigen::Index;

namespace {

void FilterByDirection(TableInReading* in) {
  const std::string& wanted = in->selection.direction;
  if (wanted.empty() || in->table().Find(wanted) >= 0) return;
  const Reading::Direction& found = in->read.reading.direction;
  if (const auto way = PlaceOfWay(found, wanted)) {
    if (found.column) {  // else all rows go this way
      in->read.where.push_back(
          {.column = *found.column, .value = found.labels[*way]});
    }
    return;
  }
  const std::string values = JoinWords(found.values, ", ");
  ThrowUnusable(in->given,
                "no rows go " + QuotedText(wanted) +
                    (values.empty() ? "; no direction was found"
                                    : "; directions found: " + values) +
                    "; name another with " + ArgumentName("direction"));
}

// "1.9", "1.10": as numbers the tenth cycle is the first one.
bool LabelsInParts(const TableInReading& in) {
  if (in.read.roles.group == kNoColumn || !in.selection.group.empty()) {
    return false;
  }
  const CsvColumn& column = in.table().At(in.read.roles.group);
  return !column.is_text() &&
         std::ranges::any_of(column.values, [](double value) {
           return value != std::floor(value) && !std::isnan(value);
         });
}

// By a column of this name, in the place of another that is called so.
void NumberPassesAs(TableInReading* in, std::string name) {
  const Motion& motion = in->Passes();
  std::vector<double> numbers(in->table().num_rows, std::nan(""));
  for (std::size_t i = 0; i < in->base_rows.size(); ++i) {
    numbers[in->base_rows[i]] = static_cast<double>(motion.passes[i] + 1);
  }
  const std::ptrdiff_t named = in->table().Find(name);
  const std::size_t place =
      named < 0 ? in->table().columns.size() : static_cast<std::size_t>(named);
  in->PutColumn(place, NumberColumn(name, std::move(numbers)));
  in->read.roles.group = static_cast<std::ptrdiff_t>(place);
  in->read.reading.cycles = {.column = std::move(name),
                             .by = "position",
                             .count = motion.num_passes,
                             .evidence = Evidence::kValues,
                             .sure = true};
}

// The rows at which another value begins.
std::vector<Index> ChangesOf(const TableInReading& in, std::size_t column) {
  std::vector<Index> codes;
  for (const std::size_t code :
       LabelsOf(in.table(), in.table().columns[column], in.base_rows, kNoLimit)
           .codes) {
    codes.push_back(static_cast<Index>(code));
  }
  return RunStarts(codes);
}

// Of columns that are called sessions or runs, or count blocks of rows, one
// that parts what another parts already: "Run" in "Session". -1: none.
std::ptrdiff_t CyclesInSessions(const TableInReading& in) {
  std::vector<std::pair<std::size_t, std::vector<Index>>> parting;
  for (std::size_t i = 0; i < in.table().columns.size(); ++i) {
    const CsvColumn& column = in.table().columns[i];
    const bool counts =
        std::ranges::any_of(in.read.counters, [&](const Counter& counter) {
          return counter.column == i && counter.counts == Counted::kBlocks;
        });
    if (counts || IsCalled(column.name, Word::kSession) ||
        IsCalled(column.name, Word::kRun)) {
      parting.emplace_back(i, ChangesOf(in, i));
    }
  }
  constexpr std::size_t kFewestRows = 3;
  for (const auto& [column, fine] : parting) {
    if (Says(in.table().columns[column].name, Word::kDay) ||
        kFewestRows * fine.size() > in.base_rows.size()) {
      continue;
    }
    for (const auto& [session, coarse] : parting) {
      if (coarse.size() > 1 && 2 * coarse.size() <= fine.size() &&
          std::ranges::includes(fine, coarse)) {
        return static_cast<std::ptrdiff_t>(column);
      }
    }
  }
  return kNoColumn;
}

// Where the axis shows no passes: what counts within sessions.
void TakeCyclesInSessions(TableInReading* in) {
  const std::ptrdiff_t column = CyclesInSessions(*in);
  if (column == kNoColumn) return;
  in->cycles_in_sessions = column;
  in->read.roles.group = column;
  std::erase_if(in->read.counters, [&](const Counter& counter) {
    return std::cmp_equal(counter.column, column);
  });
  in->read.reading.cycles.column = in->table().At(column).name;
  in->read.reading.cycles.by = "column";
  in->read.reading.cycles.evidence = Evidence::kName;
  in->read.reading.cycles.sure = true;
}

}  // namespace

void FindWays(TableInReading* in) {
  Reading::Direction& direction = in->read.reading.direction;
  std::ptrdiff_t named =
      NamedDirection(in->table(), in->selection, in->base_rows);
  const bool tells = in->read.axis.motion.both_ways && in->ordered;
  if (named < 0 && tells) {
    named = DirectionByValues(in->table(),
                              in->read.roles.target,
                              in->base_rows,
                              in->read.axis.motion);
  }
  in->read.roles.direction = named;
  if (named >= 0) {
    direction = ReadDirection(in->table(),
                              in->table().At(named),
                              in->base_rows,
                              in->Passes(),
                              in->ordered);
  } else if (tells) {
    in->read.table.columns.push_back(
        DirectionColumn(in->table(), in->base_rows, in->read.axis.motion));
    direction = {.column = kDirectionColumn,
                 .by = "position",
                 .values = {"up", "down"},
                 .labels = {"up", "down"},
                 .evidence = Evidence::kValues,
                 .sure = true};
  } else if (in->read.axis.motion.is_commanded && in->ordered) {
    const auto up = std::ranges::count(in->read.axis.motion.directions, 1);
    direction.by = "position";
    direction.values = {2 * up > std::ssize(in->base_rows) ? "up" : "down"};
    direction.evidence = Evidence::kValues;
    direction.sure = true;
  }
  FilterByDirection(in);
}

void FindColumnsThatCount(TableInReading* in) {
  if (!in->ordered) return;
  ReadTable& read = in->read;
  const Motion& motion = in->Passes();
  read.counters = FindCounters(in->table(),
                               in->selection,
                               read.roles.target,
                               in->base_rows,
                               motion.is_commanded ? motion : Motion());
  std::erase_if(read.counters, [&](const Counter& counter) {
    return static_cast<std::ptrdiff_t>(counter.column) == read.axis.column;
  });
}

void FindCycles(TableInReading* in) {
  Reading::Cycles& cycles = in->read.reading.cycles;
  if (LabelsInParts(*in) && in->Passes().is_commanded && in->ordered) {
    NumberPassesAs(in, in->table().At(in->read.roles.group).name);
    return;
  }
  if (in->read.roles.group != kNoColumn) {
    cycles.column = in->table().At(in->read.roles.group).name;
    cycles.by = "column";
    cycles.evidence =
        in->selection.group.empty() ? Evidence::kName : Evidence::kUser;
    cycles.sure = true;
    return;
  }
  const Motion& motion = in->Passes();
  constexpr Index kFewestPasses = 2;
  const bool shows_passes = motion.is_commanded &&
                            motion.num_passes >= kFewestPasses &&
                            motion.num_passes * 3 <= std::ssize(in->base_rows);
  if (!in->ordered) return;
  if (!shows_passes) {
    if (in->selection.session.empty()) TakeCyclesInSessions(in);
    return;
  }
  if (in->given.Find(kCycleColumn) >= 0) return;
  const std::ptrdiff_t counter = in->FirstThatCounts(Counted::kPasses);
  if (counter >= 0) {
    in->read.roles.group = counter;
    cycles = {.column = in->table().At(counter).name,
              .by = "column",
              .count = motion.num_passes,
              .evidence = Evidence::kValues,
              .sure = true};
    return;
  }
  NumberPassesAs(in, kCycleColumn);
}

void FindBlocksInLabels(TableInReading* in) {
  if (!in->ordered || in->clock.is_found() ||
      in->FirstThatCounts(Counted::kBlocks) >= 0) {
    return;
  }
  for (std::size_t i = 0; i < in->table().columns.size(); ++i) {
    const CsvColumn& column = in->table().columns[i];
    if (i == in->read.roles.target || !column.has_name ||
        (!column.is_text() && !KeepsRecord(column.name))) {
      continue;
    }
    auto sessions = FindSessionsInLabels(in->table(), column, in->base_rows);
    if (!sessions) continue;
    in->read.table.columns.push_back(std::move(*sessions));
    in->read.counters.push_back(
        {in->table().columns.size() - 1, Counted::kBlocks});
    return;
  }
}

}  // namespace errmap::data
