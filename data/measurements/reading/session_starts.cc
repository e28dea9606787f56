#include "data/measurements/reading/session_starts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "data/column_header.h"
#include "data/column_words.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/faults/thermometers.h"
#include "data/units.h"

namespace errmap::data {
namespace {

using Eigen::Index;

constexpr Index kBeside = 3;  // rows, whose median is not a spike

// What a thermometer does at each row, in parts of its range, and of several
// the upper median: what most of them reach at least.
struct Warmth {
  Eigen::ArrayXd rise;  // from the row before, of medians too; 0 near the ends
  Eigen::ArrayXd left;  // of all rises, from this row on; 1 near the ends
};

// The medians of each row and the two behind it.
Eigen::ArrayXd MediansFrom(const Eigen::VectorXd& values) {
  const Index n = values.size() - kBeside + 1;
  const auto first = values.head(n).array();
  const auto second = values.segment(1, n).array();
  const auto third = values.tail(n).array();
  return first.min(second).max(first.max(second).min(third));
}

// Nothing where it does not warm by more than its noise and a degree.
std::optional<Warmth> WarmthOf(const Eigen::VectorXd& values,
                               const Unit& unit) {
  constexpr double kNoises = 10.0;
  const Index n = values.size();
  const Eigen::ArrayXd levels = MediansFrom(values);
  const Eigen::ArrayXd steps = values.tail(n - 1) - values.head(n - 1);
  const Eigen::ArrayXd sizes = steps.abs();
  const double least = levels.minCoeff();
  const double range = levels.maxCoeff() - least;
  const double degree =
      unit.quantity == Quantity::kTemperature ? DegreeIn(unit) : 1.0;
  const double noise = kNoises * MedianOf({sizes.begin(), sizes.end()});
  if (!(range >= std::max(noise, degree))) return std::nullopt;
  Warmth warmth{.rise = Eigen::ArrayXd::Zero(n),
                .left = Eigen::ArrayXd::Ones(n)};
  for (Index i = kBeside; i < levels.size(); ++i) {
    warmth.rise[i] =
        std::max(steps[i - 1], levels[i] - levels[i - kBeside]) / range;
    warmth.left[i] = (levels[i] - least) / range;
  }
  return warmth;
}

std::vector<Warmth> WarmthOfThermometers(const CsvTable& table,
                                         const std::vector<Index>& rows) {
  std::vector<Warmth> found;
  for (const CsvColumn& column : table.columns) {
    if (!NamesTemperature(column.name) || !column.exceptions.empty()) continue;
    if (auto warmth =
            WarmthOf(ValuesOfRows(column, rows), UnitOfColumn(column.name))) {
      found.push_back(*std::move(warmth));
    }
  }
  return found;
}

double MedianAt(const std::vector<Warmth>& thermometers,
                Eigen::ArrayXd Warmth::*what,
                Index row) {
  std::vector<double> values;
  for (const Warmth& warmth : thermometers) {
    values.push_back((warmth.*what)[row]);
  }
  return MedianOf(std::move(values));
}

}  // namespace

ColdStarts FindColdStarts(const CsvTable& table,
                          const std::vector<Index>& rows,
                          const std::vector<Index>& passes) {
  constexpr std::size_t kFewest = 12;  // rows
  constexpr double kDeep = 0.2;        // of the range
  constexpr double kAtRest = 0.35;     // of the range
  constexpr double kOther = 3.0;       // times as deep as all others
  if (rows.size() < kFewest) return {};
  const std::vector<Warmth> thermometers = WarmthOfThermometers(table, rows);
  if (thermometers.empty()) return {};
  ColdStarts found;
  double least = INFINITY;
  double most_other = 0.0;
  double most_left = 0.0;
  for (Index i = 0; i < std::ssize(rows); ++i) {
    const double fall = -MedianAt(thermometers, &Warmth::rise, i);
    if (fall < kDeep) {
      most_other = std::max(most_other, fall);
      continue;
    }
    found.rows.push_back(i);
    least = std::min(least, fall);
    most_left = std::max(most_left, MedianAt(thermometers, &Warmth::left, i));
  }
  if (found.rows.empty() || least < kOther * most_other) return {};
  const bool are_passes =
      !passes.empty() && passes.back() + 1 < 2 * (std::ssize(found.rows) + 1);
  found.at_rest = most_left <= kAtRest && !are_passes;
  return found;
}

namespace {

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
