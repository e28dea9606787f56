#include "data/measurements/faults/thermometers.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace errmap::data {
namespace {

using Eigen::Index;

// Single cells are wrong in at most this share of the rows, yet always some.
constexpr Index kCellShare = 20;
constexpr Index kFewCells = 3;

}  // namespace

double DegreeIn(const Unit& unit) {
  const Unit degc = UnitOfSymbol("degC");
  return Converted(1.0, degc, unit) - Converted(0.0, degc, unit);
}

ColumnFault MakeFault(const MeasuredColumns& measured,
                      FaultKind kind,
                      Index input,
                      std::vector<Index> rows,
                      double value,
                      Bounds held) {
  const bool of_cells =
      kind <= FaultKind::kJump && static_cast<Index>(rows.size()) <=
                                      MostCells(measured.target_values.size());
  return {.kind = kind,
          .input = input,
          .rows = std::move(rows),
          .of_cells = of_cells,
          .value = value,
          .low = held.low,
          .high = held.high};
}

Index MostCells(Index num_rows) {
  return std::max(kFewCells, num_rows / kCellShare);
}

std::vector<Index> SoundRows(const MeasuredColumns& measured,
                             std::span<const Thermometer> thermometers) {
  std::vector<bool> is_sound(
      static_cast<std::size_t>(measured.target_values.size()), true);
  for (const Thermometer& t : thermometers) {
    for (const Index row : t.wrong) {
      is_sound[static_cast<std::size_t>(row)] = false;
    }
  }
  std::vector<Index> rows;
  for (std::size_t row = 0; row < is_sound.size(); ++row) {
    if (is_sound[row]) rows.push_back(static_cast<Index>(row));
  }
  return rows;
}

std::vector<double> ValuesAt(const MeasuredColumns& measured,
                             const std::vector<Index>& rows,
                             Index input) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Index row : rows) {
    values.push_back(measured.input_values(row, input));
  }
  return values;
}

double MedianOf(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace errmap::data
