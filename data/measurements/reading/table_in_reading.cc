#include "data/measurements/reading/table_in_reading.h"

#include <algorithm>
#include <utility>

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
    is_base[static_cast<std::size_t>(row)] = true;
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

}  // namespace errmap::data
