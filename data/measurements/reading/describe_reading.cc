#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "data/column_header.h"
#include "data/files/shown_path.h"
#include "data/measurements/axis/directions.h"
#include "data/measurements/clock/time_units.h"
#include "data/measurements/reading/derived_columns.h"
#include "data/measurements/reading/table_in_reading.h"

namespace errmap::data {
namespace {

using Eigen::Index;

// Whether there are two sessions or more, of as many rows each: a clock that
// tells no dates shows a night of a day and an hour as an hour.
bool AreAlike(const FoundSessions& found) {
  std::vector<Index> counts(found.sessions.labels.size(), 0);
  for (const Index code : found.sessions.codes) {
    ++counts[code];
  }
  return counts.size() > 1 &&
         std::ranges::count(counts, counts[0]) == std::ssize(counts);
}

// Whether a row has the target, without which it is left out; all rows where
// none has.
std::vector<bool> HaveTarget(const CsvTable& table, std::size_t target) {
  std::vector<bool> have(table.num_rows, true);
  if (target >= table.columns.size()) return have;
  const ColumnValues& values = table.columns[target].values;
  for (std::size_t row = 0; row < have.size(); ++row) {
    have[row] = !std::isnan(values[row]);
  }
  if (std::ranges::count(have, true) == 0) have.assign(have.size(), true);
  return have;
}

// The sessions, and the number of cycles in them.
void DescribeSessions(const CsvTable& table,
                      const Clock& clock,
                      const Nights& nights,
                      const std::vector<bool>& have_target,
                      ReadTable* read) {
  Reading::Sessions& sessions = read->reading.sessions;
  const FoundSessions& found = read->found;
  if (!found.sessions.column.empty()) {
    sessions.column = found.sessions.column;
  }
  sessions.by = found.by;
  sessions.counter = found.counter;
  sessions.count = std::ssize(found.sessions.labels);
  sessions.evidence = found.evidence;
  sessions.sure = found.by != "one" || nights.sure;
  const auto doubt = [&](const std::string& alternative) {
    sessions.sure = false;
    sessions.alternative = alternative;
  };
  if (found.by == "column" && found.evidence == Evidence::kValues) {
    doubt("one");
  }
  if (!found.alternative.empty()) {
    doubt(found.alternative);
  }
  if (!read->repeated_rows.empty() && found.by == "clock") {
    doubt("fewer, without the rows that occur twice");
  }
  if (clock.hours_alone && found.by != "column" && !AreAlike(found)) {
    doubt("more, as times of day hide whole days");
  }
  if (std::isfinite(found.gap) && found.gap > 0.0) {
    sessions.gap_s = found.gap;
  }
  if (found.by == "one" && nights.other > 0.0) {
    sessions.alternative =
        "parted by pauses above " + CsvNumber(std::round(nights.other)) + " s";
  }
  std::vector<std::int64_t> first(found.sessions.labels.size(), -1);
  std::set<std::pair<Index, double>> cycles;
  const std::ptrdiff_t group = read->roles.group;
  for (std::size_t i = 0; i < found.sessions.codes.size(); ++i) {
    const Index code = found.sessions.codes[i];
    auto& at = first[code];
    if (at < 0) at = static_cast<std::int64_t>(read->log_rows[i]);
    const auto row = static_cast<std::size_t>(read->log_rows[i]);
    if (group != kNoColumn && have_target[row] && found.known[i]) {
      const CsvColumn& column = table.At(group);
      const std::string* const text = column.TextAt(row);
      if (text != nullptr && text->empty()) continue;
      cycles.emplace(code,
                     text == nullptr
                         ? column.values[row]
                         : static_cast<double>(text - column.texts.data()));
    }
  }
  std::ranges::sort(first);
  sessions.first_rows = std::move(first);
  if (group != kNoColumn) {
    read->reading.cycles.count = std::ssize(cycles);
  }
}

// Of a clock of whole minutes several rows may share one.
double StepWithinMinutes(const Eigen::VectorXd& time, double step) {
  constexpr double kMinute = 60.0;
  if (step != kMinute) return step;
  const Index n = time.size() - 1;
  const auto steps = time.tail(n).array() - time.head(n).array();
  const Index shared = (steps == 0.0).count();
  const Index next = (steps == kMinute).count();
  return step * static_cast<double>(next) / static_cast<double>(next + shared);
}

// Between rows that have the target.
double StepOf(const Eigen::VectorXd& time,
              const std::vector<Index>& rows,
              const std::vector<bool>& have_target) {
  std::vector<Index> places;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (have_target[rows[i]]) {
      places.push_back(static_cast<Index>(i));
    }
  }
  const Eigen::VectorXd of_rows = time(places);
  return StepWithinMinutes(of_rows, MedianStepOf(of_rows));
}

void DescribeTime(const TableInReading& in,
                  const Clock& clock,
                  const std::vector<bool>& have_target,
                  Reading::Time* time) {
  const CsvTable& table = in.table();
  time->unit = clock.unit;
  time->origin = clock.origin;
  time->evidence = clock.evidence;
  time->sure = clock.sure;
  time->alternative = clock.alternative;
  if (!clock.is_found()) return;
  time->column = table.At(clock.column).name;
  if (clock.date_column >= 0) {
    *time->column = table.At(clock.date_column).name + " + " + *time->column;
  }
  const double step = StepOf(clock.time, in.base_rows, have_target);
  if (std::isfinite(step)) time->step_s = step;
}

// The way whose rows the filters keep.
void ChooseWay(const std::vector<ColumnFilter>& filters,
               Reading::Direction* direction) {
  if (direction->values.size() != 2) return;
  for (const ColumnFilter& filter : filters) {
    if (filter.column != direction->column) continue;
    const auto place = PlaceOfWay(*direction, ValueText(filter));
    if (place) direction->chosen = direction->values[*place];
  }
}

}  // namespace

void DescribeReading(TableInReading* in) {
  const CsvTable& table = in->table();
  const DatasetSelection& selection = in->selection;
  ReadTable* const read = &in->read;
  Reading& reading = read->reading;
  if (read->roles.target < table.columns.size()) {
    reading.target.column = table.columns[read->roles.target].name;
    reading.target.unit = UnitOfColumn(*reading.target.column).symbol;
    reading.target.evidence =
        selection.target.empty() ? Evidence::kName : Evidence::kUser;
    reading.target.sure = true;
  }
  const Axis& axis = read->axis;
  if (axis.column >= 0) {
    read->position = table.At(axis.column).name;
    reading.position = {.column = read->position,
                        .evidence = axis.evidence,
                        .sure = axis.sure,
                        .alternative = axis.alternative};
    if (reading.target.column &&
        IsReadOf(table.At(read->roles.target), table.At(axis.column))) {
      reading.target.sure = false;
      reading.target.alternative =
          *reading.target.column + "-" + read->position;
    }
  } else {
    reading.position.sure = true;
  }
  const bool is_used = !selection.with_log || read->found.time_column >= 0;
  const std::vector<bool> have_target = HaveTarget(table, read->roles.target);
  DescribeTime(*in, is_used ? in->clock : Clock(), have_target, &reading.time);
  if (!read->found.sessions.labels.empty()) {
    DescribeSessions(table, in->clock, in->nights, have_target, read);
  }
  reading.rows -= std::ssize(reading.rows_left_out);
  if (selection.faults == FaultPolicy::kDropRows) {
    reading.rows -= std::ssize(read->repeated_rows);
  }
  if (!read->passes.empty()) {  // rows for a map in use are not filtered
    const std::int64_t in_use = std::ranges::count(read->passes, true);
    reading.rows_filtered = reading.rows - in_use;
    reading.rows = in_use;
  }
  ChooseWay(read->where, &reading.direction);
  for (const Index row : read->repeated_rows) {
    reading.rows_left_out.push_back(
        {.row = row, .why = "repeats another value for value"});
  }
  for (const auto& part : in->given.parts) {
    reading.files.push_back(ShownPath(part.second));
  }
  if (in->given.parts.empty()) reading.files = {ShownPath(in->given.file)};
}

}  // namespace errmap::data
