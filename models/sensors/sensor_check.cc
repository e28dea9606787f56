#include "models/sensors/sensor_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "data/text.h"
#include "models/map_experience.h"
#include "models/sensors/session_readings.h"
#include "models/trained_range.h"
#include "stats/not_a_number.h"
#include "stats/order_statistic.h"

namespace errmap::models {
namespace {

const data::ColumnInfo& ColumnOf(const FittedModel& fitted, Index state) {
  const Index input =
      fitted.applicability->columns[static_cast<std::size_t>(state)];
  return fitted.inputs[static_cast<std::size_t>(input)].column;
}

std::optional<SensorFaultFound> OfAnotherUnit(const FittedModel& fitted,
                                              const MatrixXd& readings) {
  for (const InputOutside& input : InputsOutside(fitted.inputs, readings)) {
    if (input.looks_like.empty()) continue;
    return SensorFaultFound{
        .fault = SensorFault::kUnit,
        .columns =
            {fitted.inputs[static_cast<std::size_t>(input.input)].column},
        .value = input.max,
        .looks_like = input.looks_like};
  }
  return std::nullopt;
}

// Rows at the end of a column that repeat the last reading.
Index LengthOfLastRun(const MatrixXd& states, Index column) {
  Index length = 1;
  while (length < states.rows() && states(states.rows() - 1 - length, column) ==
                                       states(states.rows() - 1, column)) {
    ++length;
  }
  return length;
}

// One reading for as long as hardly ever in training.
std::optional<SensorFaultFound> Frozen(const FittedModel& fitted,
                                       const MatrixXd& states) {
  constexpr double kRare = 1e-3;  // of all columns together
  const VectorXd& repeats = fitted.applicability->repeats;
  std::vector<Index> lengths;
  for (Index column = 0; column < repeats.size(); ++column) {
    lengths.push_back(LengthOfLastRun(states, column));
  }
  for (Index column = 0; column < repeats.size(); ++column) {
    const Index length = lengths[static_cast<std::size_t>(column)];
    const double chance =
        static_cast<double>(repeats.size()) *
        std::pow(repeats[column], static_cast<double>(length - 1));
    // A control that reads its sensors once a minute repeats them all.
    const Index also = std::ranges::count_if(
        lengths, [length](Index other) { return other >= length; });
    if (length < 3 || !(chance < kRare) || 2 * also > repeats.size()) continue;
    return SensorFaultFound{.fault = SensorFault::kFrozen,
                            .columns = {ColumnOf(fitted, column)},
                            .value = states(states.rows() - 1, column),
                            .looks_like = ""};
  }
  return std::nullopt;
}

// A fault that may be, and by how much more likely it makes the readings than
// is asked of it.
struct Suspect {
  SensorFaultFound found;
  double likelier = 0.0;
  double shown = 0.0;  // as `likelier`, by how its column itself scatters
};

// What is asked of one, beyond the number of faults that may be: the more there
// are, the likelier one of them fits by chance (tests/benchmarks/mornings.py).
constexpr double kAsked = 0.5;

// Each column, and each pair in one unit.
std::vector<Suspect> SuspectsOf(const FittedModel& fitted,
                                const MatrixXd& states) {
  std::vector<Suspect> suspects;
  const SessionLikelihood readings(fitted, states);
  const VectorXd& scatter = fitted.applicability->sessions->scatter;
  const auto columns = static_cast<double>(states.cols());
  const double asked = readings.LogDensity() + kAsked +
                       std::log(0.5 * columns * (columns + 1.0));
  for (Index i = 0; i < states.cols(); ++i) {
    const data::ColumnInfo& one = ColumnOf(fitted, i);
    suspects.push_back(
        {.found = {.fault = SensorFault::kOff,
                   .columns = {one},
                   .value = readings.Shift(i)},
         .likelier = readings.LogDensityShifted(i) - asked,
         .shown = readings.LogDensityShifted(i, scatter[i]) - asked});
    for (Index j = i + 1; j < states.cols(); ++j) {
      const data::ColumnInfo& other = ColumnOf(fitted, j);
      if (one.unit.symbol != other.unit.symbol) continue;
      const double likelier = readings.LogDensitySwapped(i, j) - asked;
      suspects.push_back(
          {.found = {.fault = SensorFault::kSwapped, .columns = {one, other}},
           .likelier = likelier,
           .shown = likelier});
    }
  }
  return suspects;
}

MatrixXd WholeRows(const MatrixXd& states) {
  std::vector<Index> rows;
  for (Index row = 0; row < states.rows(); ++row) {
    if (states.row(row).allFinite()) rows.push_back(row);
  }
  return states(rows, Eigen::all);
}

// How far half of the other columns in its unit, or more, go beyond what was
// trained: that far what they tell of this one is extrapolated.
double OthersBeyond(const FittedModel& fitted,
                    const MatrixXd& states,
                    const data::ColumnInfo& column) {
  std::vector<double> beyond;
  for (Index i = 0; i < states.cols(); ++i) {
    const data::ColumnInfo& other = ColumnOf(fitted, i);
    if (other.name == column.name || other.unit.symbol != column.unit.symbol) {
      continue;
    }
    const TrainedInput& input = fitted.inputs[static_cast<std::size_t>(
        fitted.applicability->columns[static_cast<std::size_t>(i)])];
    beyond.push_back(std::max({states.col(i).maxCoeff() - input.max,
                               input.min - states.col(i).minCoeff(),
                               0.0}));
  }
  return beyond.empty() ? 0.0 : stats::UpperMedian(std::move(beyond));
}

// Less than what the others are beyond the trained range proves no shift.
bool IsExtrapolated(const FittedModel& fitted,
                    const MatrixXd& states,
                    const SensorFaultFound& found) {
  return found.fault == SensorFault::kOff &&
         std::abs(found.value) <=
             OthersBeyond(fitted, states, found.columns.front());
}

// The fault that explains best how the readings go together.
std::optional<SensorFaultFound> AgainstTheOthers(const FittedModel& fitted,
                                                 const MatrixXd& states) {
  // Of two, neither is told by others.
  if (!fitted.applicability->sessions || states.cols() < 3) return std::nullopt;
  const std::vector<Suspect> suspects = SuspectsOf(fitted, states);
  const auto best = std::ranges::max_element(suspects, {}, &Suspect::likelier);
  if (!(best->shown > 0.0)) return std::nullopt;
  if (IsExtrapolated(fitted, states, best->found)) return std::nullopt;
  return best->found;
}

std::vector<double> WithoutEmpty(const VectorXd& readings) {
  std::vector<double> values;
  for (const double value : readings) {
    if (!std::isnan(value)) values.push_back(value);
  }
  return values;
}

// A sensor without any reading: no row is whole, so the others cannot be held
// against each other.
std::optional<SensorFaultFound> Silent(const FittedModel& fitted,
                                       const MatrixXd& states) {
  for (Index column = 0; column < states.cols(); ++column) {
    if (!states.col(column).array().isNaN().all()) continue;
    return SensorFaultFound{.fault = SensorFault::kDead,
                            .columns = {ColumnOf(fitted, column)},
                            .value = stats::kNaN,
                            .looks_like = ""};
  }
  return std::nullopt;
}

// Empties the cells with spikes and returns the first.
std::optional<SensorFaultFound> TakeSpikes(const FittedModel& fitted,
                                           MatrixXd* readings) {
  const std::vector<Spike> spikes = FindSpikes(fitted.inputs, *readings);
  for (const Spike& spike : spikes) {
    (*readings)(spike.row, spike.input) = stats::kNaN;
  }
  if (spikes.empty()) return std::nullopt;
  const Spike& first = spikes.front();
  return SensorFaultFound{
      .fault = SensorFault::kSpike,
      .columns = {fitted.inputs[static_cast<std::size_t>(first.input)].column},
      .value = first.value,
      .row = first.row};
}

// A column that reads one value where it cannot be.
void CallDead(const FittedModel& fitted,
              const MatrixXd& readings,
              SensorFaultFound* found) {
  if (found->fault != SensorFault::kOff &&
      found->fault != SensorFault::kFrozen) {
    return;
  }
  for (std::size_t i = 0; i < fitted.inputs.size(); ++i) {
    const TrainedInput& input = fitted.inputs[i];
    if (input.column.name != found->columns.front().name) continue;
    const std::vector<double> values =
        WithoutEmpty(readings.col(static_cast<Index>(i)));
    const double value = values.front();
    const double width = input.max - input.min;
    const double beyond = std::max(input.min - value, value - input.max);
    if (std::ranges::count(values, value) == std::ssize(values) &&
        (value == 0.0 ? beyond > 0.0 : beyond > 2.0 * width)) {
      found->fault = SensorFault::kDead;
      found->value = value;
    }
  }
}

}  // namespace

std::string_view ToString(SensorFault fault) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"unit", "dead", "frozen", "swapped", "off", "spike"});
  return data::NameOf(kNames, fault);
}

std::optional<SensorFaultFound> FindSensorFault(const FittedModel& fitted,
                                                const MatrixXd& all_readings) {
  if (auto unit = OfAnotherUnit(fitted, all_readings)) return unit;
  if (fitted.applicability == nullptr) return std::nullopt;
  MatrixXd readings = all_readings;
  auto spike = TakeSpikes(fitted, &readings);
  const MatrixXd all = readings(Eigen::all, fitted.applicability->columns);
  if (auto silent = Silent(fitted, all)) return silent;
  const MatrixXd states = WholeRows(all);
  if (states.rows() == 0) return spike;
  // What hangs soon stands elsewhere, too.
  auto found = Frozen(fitted, states);
  if (!found) found = AgainstTheOthers(fitted, states);
  if (found) CallDead(fitted, readings, &*found);
  return found ? found : spike;
}

}  // namespace errmap::models
