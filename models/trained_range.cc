#include "models/trained_range.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "stats/order_statistic.h"

namespace errmap::models {
namespace {

using Eigen::Index;

bool IsWithin(const TrainedInput& input, double value) {
  return value >= input.min && value <= input.max;
}

// Within the trained range and as much again around it: another day is warmer,
// and another axis longer, but not by 273.
bool IsNear(const TrainedInput& input, double min, double max) {
  const double width = input.max - input.min;
  return min >= input.min - width && max <= input.max + width;
}

std::string LooksLike(const TrainedInput& input, double min, double max) {
  const data::Unit& unit = input.column.unit;
  if (unit.quantity == data::Quantity::kOther || IsNear(input, min, max)) {
    return "";
  }
  for (const data::Unit& other : data::UnitsOf(unit.quantity)) {
    if (other.symbol != unit.symbol &&
        IsNear(input,
               data::Converted(min, other, unit),
               data::Converted(max, other, unit))) {
      return other.symbol;
    }
  }
  return "";
}

std::vector<Index> RowsOfSpikes(const TrainedInput& input,
                                const Eigen::VectorXd& readings) {
  constexpr double kFar = 3.0;
  constexpr std::size_t kOneIn = 5;
  std::vector<double> values;
  std::ranges::copy_if(readings, std::back_inserter(values), [](double value) {
    return !std::isnan(value);
  });
  if (values.size() < kOneIn) return {};
  const double middle = stats::OrderStatistic(values, values.size() / 2);
  const double far = kFar * (input.max - input.min);
  std::vector<Index> rows;
  for (Index row = 0; row < readings.size(); ++row) {
    if (std::abs(readings[row] - middle) > far) rows.push_back(row);
  }
  return kOneIn * rows.size() > values.size() ? std::vector<Index>{} : rows;
}

}  // namespace

std::vector<Spike> FindSpikes(const std::vector<TrainedInput>& inputs,
                              const Eigen::MatrixXd& readings) {
  std::vector<Spike> spikes;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].column.unit.quantity != data::Quantity::kTemperature ||
        !(inputs[i].max > inputs[i].min)) {
      continue;
    }
    const auto input = static_cast<Index>(i);
    for (const Index row : RowsOfSpikes(inputs[i], readings.col(input))) {
      spikes.push_back(
          {.input = input, .row = row, .value = readings(row, input)});
    }
  }
  return spikes;
}

std::vector<InputOutside> InputsOutside(const std::vector<TrainedInput>& inputs,
                                        const Eigen::MatrixXd& values) {
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
              const Eigen::MatrixXd& values,
              Index row) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!IsWithin(inputs[i], values(row, static_cast<Index>(i)))) return false;
  }
  return true;
}

}  // namespace errmap::models
