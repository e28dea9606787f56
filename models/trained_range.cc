#include "models/trained_range.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "data/measurements/faults/thermometers.h"
#include "models/map_experience.h"
#include "stats/order_statistic.h"

namespace errmap::models {
namespace {

bool IsWithin(const TrainedInput& input, double value) {
  return std::max(input.min - value, value - input.max) <=
         kRangeTolerance * (input.max - input.min);
}

// Within the trained range and as much again around it: another day is warmer,
// and another axis longer, but not by 273.
bool IsNear(const TrainedInput& input, double min, double max) {
  const double width = input.max - input.min;
  return min >= input.min - width && max <= input.max + width;
}

// A length or an angle is travelled, a temperature read where it stands.
bool IsTravelled(const TrainedInput& input, double min, double max) {
  constexpr double kLeastTravel = 0.2;
  return input.column.unit.quantity == data::Quantity::kTemperature ||
         max - min >= kLeastTravel * (input.max - input.min);
}

// Whether readings from min to max are like those of training.
bool IsLike(const TrainedInput& input, double min, double max) {
  return IsNear(input, min, max) && IsTravelled(input, min, max);
}

std::string LooksLike(const TrainedInput& input, double min, double max) {
  const data::Unit& unit = input.column.unit;
  if (unit.quantity == data::Quantity::kOther || IsLike(input, min, max)) {
    return "";
  }
  std::string nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const data::Unit& other : data::UnitsOf(unit.quantity)) {
    const double low = data::Converted(min, other, unit);
    const double high = data::Converted(max, other, unit);
    const double apart = std::abs(low - input.min) + std::abs(high - input.max);
    if (other.symbol == unit.symbol || !IsLike(input, low, high) ||
        apart >= least) {
      continue;
    }
    least = apart;
    nearest = other.symbol;
  }
  return nearest;
}

// (k) The readings that there are, in order of the rows.
struct Readings {
  std::vector<Index> rows;
  std::vector<double> values;
};

Readings WithoutEmpty(const VectorXd& column) {
  Readings readings;
  for (Index row = 0; row < column.size(); ++row) {
    if (std::isnan(column[row])) continue;
    readings.rows.push_back(row);
    readings.values.push_back(column[row]);
  }
  return readings;
}

// Readings beyond `far` from the middle one, in runs that leave the readings
// beside them by as much: a machine warms, and a night cools, step by step.
std::vector<Index> RowsOfSpikes(const Readings& readings, double far) {
  const std::vector<double>& values = readings.values;
  const double middle = stats::OrderStatistic(values, values.size() / 2);
  const auto is_far = [&](std::size_t i) {
    return std::abs(values[i] - middle) > far;
  };
  const auto jumps = [&](std::size_t i) {
    return i == 0 || i == values.size() ||
           std::abs(values[i] - values[i - 1]) > far;
  };
  std::vector<Index> rows;
  for (std::size_t begin = 0; begin < values.size(); ++begin) {
    if (!is_far(begin)) continue;
    std::size_t end = begin;
    while (end < values.size() && is_far(end)) ++end;
    if (jumps(begin) && jumps(end)) {
      rows.insert(rows.end(),
                  readings.rows.begin() + static_cast<std::ptrdiff_t>(begin),
                  readings.rows.begin() + static_cast<std::ptrdiff_t>(end));
    }
    begin = end;
  }
  return rows;
}

std::vector<Index> RowsOfSpikes(const TrainedInput& input,
                                const VectorXd& column) {
  constexpr double kFar = 3.0;        // trained ranges
  constexpr double kLeastFar = 10.0;  // degC
  constexpr std::size_t kFewest = 3;
  constexpr std::size_t kOneIn = 5;
  const Readings readings = WithoutEmpty(column);
  const std::size_t count = readings.values.size();
  if (count < kFewest) return {};
  const double far = std::max(kFar * (input.max - input.min),
                              kLeastFar * data::DegreeIn(input.column.unit));
  const std::vector<Index> rows = RowsOfSpikes(readings, far);
  return rows.size() > std::max<std::size_t>(1, count / kOneIn)
             ? std::vector<Index>{}
             : rows;
}

}  // namespace

std::vector<Spike> FindSpikes(const std::vector<TrainedInput>& inputs,
                              const MatrixXd& readings) {
  std::vector<Spike> spikes;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].column.unit.quantity != data::Quantity::kTemperature)
      continue;
    const auto input = static_cast<Index>(i);
    for (const Index row : RowsOfSpikes(inputs[i], readings.col(input))) {
      spikes.push_back(
          {.input = input, .row = row, .value = readings(row, input)});
    }
  }
  return spikes;
}

std::vector<InputOutside> InputsOutside(const std::vector<TrainedInput>& inputs,
                                        const MatrixXd& values) {
  std::vector<InputOutside> outside;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto column = values.col(static_cast<Index>(i));
    InputOutside found{.input = static_cast<Index>(i),
                       .min = std::numeric_limits<double>::infinity(),
                       .max = -std::numeric_limits<double>::infinity()};
    Index num_readings = 0;
    for (const double value : column) {
      if (std::isnan(value)) continue;
      ++num_readings;
      found.num_rows += IsWithin(inputs[i], value) ? 0 : 1;
      found.min = std::min(found.min, value);
      found.max = std::max(found.max, value);
    }
    if (found.num_rows == 0) continue;
    if (2 * found.num_rows > num_readings) {
      found.looks_like = LooksLike(inputs[i], found.min, found.max);
    }
    outside.push_back(std::move(found));
  }
  return outside;
}

bool IsInside(const std::vector<TrainedInput>& inputs,
              const MatrixXd& values,
              Index row) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!IsWithin(inputs[i], values(row, static_cast<Index>(i)))) return false;
  }
  return true;
}

}  // namespace errmap::models
