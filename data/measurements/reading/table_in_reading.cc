#include "data/measurements/reading/table_in_reading.h"

#include <algorithm>
#include <set>
#include <utility>

#include "data/column_words.h"
#include "data/columns.h"
#include "data/measurements/axis/directions.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/faults/row_faults.h"
#include "data/text.h"

namespace errmap::data {

void TableInReading::PutColumn(std::size_t place, CsvColumn column) {
  std::vector<CsvColumn>& columns = read.table.columns;
  if (place < columns.size()) {
    columns[place] = std::move(column);
  } else {
    columns.push_back(std::move(column));
  }
}

std::vector<bool> TableInReading::IsBaseRow() const {
  std::vector<bool> is_base(table().num_rows, false);
  for (const Eigen::Index row : base_rows) {
    is_base[row] = true;
  }
  return is_base;
}

const Motion& TableInReading::Passes() const {
  static const Motion kNone;
  return read.axis.motion.passes.size() == base_rows.size() ? read.axis.motion
                                                            : kNone;
}

std::ptrdiff_t TableInReading::FirstCalled(Word word) const {
  const auto found = std::ranges::find_if(
      table().columns,
      [&](const CsvColumn& column) { return IsCalled(column.name, word); });
  return found == table().columns.end() ? -1 : found - table().columns.begin();
}

std::ptrdiff_t TableInReading::FirstThatCounts(Counted counted) const {
  const auto found =
      std::ranges::find(read.counters, counted, &Counter::counts);
  return found == read.counters.end()
             ? -1
             : static_cast<std::ptrdiff_t>(found->column);
}

using Eigen::Index;

namespace {

// A way that the positions are to tell.
bool IsDerived(const CsvTable& given, const ColumnFilter& filter) {
  return filter.column == kDirectionColumn && given.Find(kDirectionColumn) < 0;
}

// Rows with the time of another; -1 where some have none.
Index NumTimesAgain(const Clock& clock) {
  if (std::ranges::count(clock.known, false) > 0) return -1;
  const std::set<double> times(clock.time.begin(), clock.time.end());
  return clock.time.size() - std::ssize(times);
}

void LeaveOutWords(TableInReading* in, std::vector<bool>* passes) {
  const std::vector<Index> left_out = LeaveOutTotals(
      in->table(), in->read.roles.group, in->selection.missing, passes);
  if (left_out.empty()) return;
  std::vector<Index> kept = AllRows(in->table().num_rows);
  for (const Index row : left_out) {
    kept[row] = -1;
    in->read.reading.rows_left_out.push_back(
        {.row = row, .why = "holds words where the others have numbers"});
  }
  // Their words are not times either.
  for (CsvColumn& column : in->read.table.columns) {
    if (column.is_text()) column = TakeRows(column, kept);
  }
}

}  // namespace

std::vector<Index> LeaveOutTotals(const CsvTable& table,
                                  std::ptrdiff_t group,
                                  MissingPolicy missing,
                                  std::vector<bool>* passes) {
  std::vector<bool> numbering;
  for (const CsvColumn& column : table.columns) {
    numbering.push_back(KeepsRecord(column.name) ||
                        IsCalled(column.name, Word::kTime));
  }
  if (group != kNoColumn) numbering[group] = true;
  return LeaveOutRowsOfWords(table, numbering, missing, passes);
}

void ChooseBaseRows(TableInReading* in) {
  std::vector<ColumnFilter> filters;
  for (const ColumnFilter& filter : in->selection.where) {
    if (!IsDerived(in->given, filter)) filters.push_back(filter);
  }
  std::vector<bool> passes = RowsThatPass(in->table(), filters);
  LeaveOutWords(in, &passes);
  in->base_rows = MarkedRows(passes);
}

bool LeaveOutSavedTwice(TableInReading* in) {
  if (!in->clock.dated || in->clock.DatesRise()) return false;
  std::vector<bool> is_kept = in->IsBaseRow();
  const std::vector<Index> again = RepeatedRows(
      in->table(), in->read.roles.target, is_kept, NumTimesAgain(in->clock));
  if (again.empty()) return false;
  for (const Index row : again) {
    is_kept[row] = false;
    in->read.reading.rows_left_out.push_back(
        {.row = row, .why = "occurs twice, with its time"});
  }
  in->base_rows = MarkedRows(is_kept);
  in->read.table.Remark(
      CountText(again.size(), "row") +
      (again.size() == 1
           ? " occurs twice, with its time; it is read once"
           : " occur twice, with their times; each is read once"));
  return true;
}

}  // namespace errmap::data
