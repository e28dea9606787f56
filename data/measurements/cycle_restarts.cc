#include "data/measurements/cycle_restarts.h"

#include <algorithm>

#include "data/column_words.h"

namespace errmap::data {
namespace {

using Eigen::Index;

std::size_t At(const std::vector<Index>& rows, std::size_t i) {
  return static_cast<std::size_t>(rows[i]);
}

// Whether a run of rows begins here in another column that may be called a
// session and is not a cycle. What changes with each row numbers the rows.
bool OtherRunBegins(const CsvTable& table,
                    const std::string& cycles,
                    const std::vector<Index>& rows,
                    std::size_t i) {
  return std::ranges::any_of(table.columns, [&](const CsvColumn& column) {
    const auto changes = [&](std::size_t row) {
      return table.CellText(column, At(rows, row)) !=
             table.CellText(column, At(rows, row - 1));
    };
    return column.name != cycles && !IsCalled(column.name, Word::kCycle) &&
           (IsCalled(column.name, Word::kSession) ||
            IsCalled(column.name, Word::kRun) ||
            IsCalled(column.name, Word::kCounter)) &&
           changes(i) && !(i > 1 && changes(i - 1));
  });
}

}  // namespace

std::optional<CycleRestarts> FindCycleRestarts(
    const CsvTable& table,
    const std::vector<Index>& rows,
    const std::vector<std::ptrdiff_t>& cycles) {
  for (const std::ptrdiff_t index : cycles) {
    if (index < 0) continue;
    const CsvColumn& column = table.At(index);
    if (column.is_text() || !column.exceptions.empty()) continue;
    CycleRestarts found{.column = column.name,
                        .begins = std::vector<bool>(rows.size(), false)};
    double way = 0.0;  // of the first step
    std::size_t runs = 1;
    std::size_t back = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double step =
          column.values[At(rows, i)] - column.values[At(rows, i - 1)];
      if (way == 0.0) way = step;
      runs += step != 0.0 ? 1 : 0;
      if (way * step < 0.0) {
        found.begins[i] = true;
        ++back;
      }
    }
    if (back > 0 && runs >= 2 * back && rows.size() >= 2 * runs) return found;
  }
  return std::nullopt;
}

bool CountOver(const CycleRestarts& restarts,
               const CsvColumn& date,
               const std::vector<Index>& rows) {
  std::ptrdiff_t days = 1;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    days += date.TextAt(At(rows, i)) != date.TextAt(At(rows, i - 1)) ? 1 : 0;
  }
  return 1 + std::ranges::count(restarts.begins, true) < days;
}

bool PartFurther(const CycleRestarts& restarts,
                 const Grouping& sessions,
                 const CsvTable& table,
                 const std::vector<Index>& rows) {
  const std::vector<Index>& codes = sessions.codes;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const bool begins = restarts.begins[i];
    const bool is_other = codes[i] != codes[i - 1];
    if ((is_other && !begins) ||
        (begins && !is_other &&
         !OtherRunBegins(table, restarts.column, rows, i))) {
      return false;
    }
  }
  return 1 + std::ranges::count(restarts.begins, true) >
         std::ssize(sessions.labels);
}

}  // namespace errmap::data
