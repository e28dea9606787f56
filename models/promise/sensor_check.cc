#include "models/promise/sensor_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "models/history/history.h"
#include "models/map_experience.h"
#include "models/promise/applicability.h"
#include "models/trained_range.h"
#include "stats/distributions.h"
#include "stats/error_metrics.h"
#include "stats/spread_sample.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double MedianOfColumn(VectorXd values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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
  for (Index column = 0; column < repeats.size(); ++column) {
    const Index length = LengthOfLastRun(states, column);
    const double chance =
        static_cast<double>(repeats.size()) *
        std::pow(repeats[column], static_cast<double>(length - 1));
    // A control that reads its sensors once a minute repeats them all.
    const Index also = std::ranges::count_if(
        Eigen::VectorXi::LinSpaced(static_cast<int>(repeats.size()),
                                   0,
                                   static_cast<int>(repeats.size()) - 1),
        [&](int other) { return LengthOfLastRun(states, other) >= length; });
    if (length < 3 || !(chance < kRare) || 2 * also > repeats.size()) continue;
    return SensorFaultFound{.fault = SensorFault::kFrozen,
                            .columns = {ColumnOf(fitted, column)},
                            .value = states(states.rows() - 1, column),
                            .looks_like = ""};
  }
  return std::nullopt;
}

// How far each column stands from what the others tell, in the middle of the
// rows; 1 is the limit.
VectorXd RelationsOf(const Applicability& trained, const MatrixXd& states) {
  const StateMeasures found = MeasureStates(trained, states);
  VectorXd ratios(states.cols());
  for (Index i = 0; i < states.cols(); ++i) {
    ratios[i] = MedianOfColumn(found.relation.col(i).cwiseAbs()) /
                trained.relation_limit[i];
  }
  return ratios;
}

// The largest of them, and how far the state is from those of training: in one
// far from all, such as after harder duty, several seem off in turn.
double WorstOf(const Applicability& trained, const MatrixXd& states) {
  return std::max(RelationsOf(trained, states).maxCoeff(),
                  MedianOfColumn(MeasureStates(trained, states).distance) /
                      trained.distance_limit);
}

// What is left where the column reads what the others tell.
struct WithoutColumn {
  double left = 0.0;   // largest of RelationsOf, and of the distance likewise
  double shift = 0.0;  // of the column, its unit
};
WithoutColumn Without(const Applicability& trained,
                      const MatrixXd& states,
                      Index column) {
  const StateMeasures found = MeasureStates(trained, states);
  MatrixXd mended = states;
  mended.col(column) = found.expected.col(column);
  return {
      .left = WorstOf(trained, mended),
      .shift = MedianOfColumn(states.col(column) - found.expected.col(column))};
}

std::optional<SensorFaultFound> AgainstTheOthers(const FittedModel& fitted,
                                                 const MatrixXd& states) {
  const Applicability& trained = *fitted.applicability;
  if (states.cols() < 3) return std::nullopt;
  const VectorXd ratios = RelationsOf(trained, states);
  if (!(ratios.maxCoeff() > 1.0)) return std::nullopt;
  SensorFaultFound off{
      .fault = SensorFault::kOff, .columns = {}, .looks_like = ""};
  double least = 1.0;
  for (Index column = 0; column < states.cols(); ++column) {
    if (!(ratios[column] > 1.0)) continue;
    const WithoutColumn without = Without(trained, states, column);
    if (!(without.left < least)) continue;
    least = without.left;
    off.columns = {ColumnOf(fitted, column)};
    off.value = without.shift;
  }
  SensorFaultFound swapped{
      .fault = SensorFault::kSwapped, .columns = {}, .looks_like = ""};
  double least_swapped = 1.0;
  for (Index i = 0; i < states.cols(); ++i) {
    for (Index j = i + 1; j < states.cols(); ++j) {
      if (!(std::max(ratios[i], ratios[j]) > 1.0) ||
          ColumnOf(fitted, i).unit.symbol != ColumnOf(fitted, j).unit.symbol) {
        continue;
      }
      MatrixXd mended = states;
      mended.col(i).swap(mended.col(j));
      const double left = WorstOf(trained, mended);
      if (!(left < least_swapped)) continue;
      least_swapped = left;
      swapped.columns = {ColumnOf(fitted, i), ColumnOf(fitted, j)};
    }
  }
  // A swap mends two columns by no free figure, so it is believed first.
  if (!swapped.columns.empty()) return swapped;
  if (!off.columns.empty()) return off;
  return std::nullopt;
}

// The later third, where sensors of different places differ most; of many rows
// some tell as much.
MatrixXd LateRows(const MatrixXd& states) {
  constexpr Index kMostRows = 64;
  const Index late =
      std::min(states.rows(), std::max<Index>(1, states.rows() / 3));
  const MatrixXd rows = states.bottomRows(late);
  return rows(stats::SpreadSample(late, kMostRows), Eigen::all);
}

MatrixXd WholeRows(const MatrixXd& states) {
  std::vector<Index> rows;
  for (Index row = 0; row < states.rows(); ++row) {
    if (states.row(row).allFinite()) rows.push_back(row);
  }
  return states(rows, Eigen::all);
}

// Whether first readings less those of the starts (`found`) look like a log
// that begins inside: the other columns stand as they do later in sessions,
// where `change` is the mean, or the `worst` may have warmed so far itself.
bool LooksBegunInside(const VectorXd& found,
                      const VectorXd& weight,
                      const VectorXd& change,
                      Index worst) {
  constexpr double kOthersWarm = 0.3;  // 1: as the mean row of sessions
  constexpr double kItselfWarm = 3.0;
  std::vector<Index> others;
  for (Index i = 0; i < found.size(); ++i) {
    if (i != worst) others.push_back(i);
  }
  const VectorXd apart = found(others).array() - found(others).mean();
  const VectorXd changes = change(others).array() - change(others).mean();
  const double all = weight(others).dot(changes);
  if (all > 0.0 && weight(others).dot(apart) > kOthersWarm * all) return true;
  const double share = (found[worst] - MedianOfColumn(found)) / change[worst];
  return share > 0.0 && share < kItselfWarm;
}

data::Dataset Swapped(const data::Dataset& rows,
                      const data::ColumnInfo& one,
                      const data::ColumnInfo& other) {
  std::vector<data::ColumnInfo> inputs = rows.inputs();
  std::swap(inputs[static_cast<std::size_t>(rows.FindInput(one.name))],
            inputs[static_cast<std::size_t>(rows.FindInput(other.name))]);
  data::Dataset swapped =
      rows.WithInputs(std::move(inputs), rows.input_values());
  return rows.log() == nullptr ? swapped
                               : swapped.WithLog(rows.log(), rows.log_rows());
}

double RmseWith(const FittedModel& fitted, const data::Dataset& rows) {
  return stats::RootMeanSquare(rows.target_values() - fitted.Predict(rows));
}

// A column that reads one value where it cannot be.
void CallDead(const FittedModel& fitted,
              const MatrixXd& readings,
              SensorFaultFound* found) {
  if (found->fault != SensorFault::kOff) return;
  for (std::size_t i = 0; i < fitted.inputs.size(); ++i) {
    const TrainedInput& input = fitted.inputs[i];
    if (input.column.name != found->columns.front().name) continue;
    const VectorXd values = readings.col(static_cast<Index>(i));
    const double width = input.max - input.min;
    const double beyond =
        std::max(input.min - values[0], values[0] - input.max);
    if ((values.array() == values[0]).all() &&
        (values[0] == 0.0 ? beyond > 0.0 : beyond > 2.0 * width)) {
      found->fault = SensorFault::kDead;
      found->value = values[0];
    }
  }
}

}  // namespace

std::string_view ToString(SensorFault fault) {
  switch (fault) {
    case SensorFault::kUnit:
      return "unit";
    case SensorFault::kDead:
      return "dead";
    case SensorFault::kFrozen:
      return "frozen";
    case SensorFault::kSwapped:
      return "swapped";
    case SensorFault::kOff:
      return "off";
  }
  return "";
}

std::optional<SensorFaultFound> SwapThatExplains(const FittedModel& fitted,
                                                 const data::Dataset& probes,
                                                 const MatrixXd& readings) {
  constexpr Index kFewestProbes = 3;
  constexpr double kWrong = 1.5;  // times the promise
  constexpr double kRight = 1.2;
  constexpr double kLeastGain = 0.5;  // of both RelationsOf together
  if (fitted.applicability == nullptr || fitted.held_out == nullptr ||
      probes.num_rows() < kFewestProbes) {
    return std::nullopt;
  }
  const Applicability& trained = *fitted.applicability;
  const MatrixXd states =
      LateRows(WholeRows(readings(Eigen::all, trained.columns)));
  if (states.rows() == 0 || states.cols() < 3) return std::nullopt;
  const double promised = fitted.held_out->rmse;
  const double before = RmseWith(fitted, probes);
  if (!(before > kWrong * promised)) return std::nullopt;
  const VectorXd ratios = RelationsOf(trained, states);
  double least = std::min(kRight * promised, 0.5 * before);
  std::optional<SensorFaultFound> found;
  for (Index i = 0; i < states.cols(); ++i) {
    for (Index j = i + 1; j < states.cols(); ++j) {
      const data::ColumnInfo& one = ColumnOf(fitted, i);
      const data::ColumnInfo& other = ColumnOf(fitted, j);
      if (one.unit.symbol != other.unit.symbol) continue;
      MatrixXd mended = states;
      mended.col(i).swap(mended.col(j));
      const VectorXd after = RelationsOf(trained, mended);
      if (!(after[i] + after[j] + kLeastGain < ratios[i] + ratios[j])) continue;
      const double left = RmseWith(fitted, Swapped(probes, one, other));
      if (!(left < least)) continue;
      least = left;
      found = SensorFaultFound{.fault = SensorFault::kSwapped,
                               .columns = {one, other},
                               .looks_like = ""};
    }
  }
  return found;
}

std::optional<SensorFaultFound> OffAtStart(const FittedModel& fitted,
                                           const VectorXd& readings) {
  constexpr double kFalseAlarms = 1e-3;  // of all columns together
  // Of fewer, the others may have warmed as well as the one be off.
  constexpr Index kFewestColumns = 4;
  if (fitted.history == nullptr) return std::nullopt;
  const std::vector<StartReading>& starts = fitted.history->start_readings;
  const auto count = std::ssize(starts);
  if (count < kFewestColumns) return std::nullopt;
  VectorXd found(count);
  VectorXd sd(count);
  VectorXd weight(count);
  std::vector<const TrainedInput*> inputs;
  for (Index i = 0; i < count; ++i) {
    const StartReading& start = starts[static_cast<std::size_t>(i)];
    const auto at = std::ranges::find(
        fitted.inputs, start.column, [](const TrainedInput& input) {
          return input.column.name;
        });
    inputs.push_back(&*at);
    found[i] = readings[at - fitted.inputs.begin()] - start.mean;
    sd[i] = start.sd;
    weight[i] = start.weight;
  }
  if (!found.allFinite()) return std::nullopt;
  // Few starts tell the scatter of each badly.
  const double pooled =
      std::sqrt(sd.squaredNorm() / static_cast<double>(count));
  const VectorXd scale = (0.5 * (sd.array().square() + pooled * pooled)).sqrt();
  // As the others stand to each other, whatever the room's temperature: the
  // median is not drawn along by the one that is off.
  const VectorXd apart = found.array() - MedianOfColumn(found);
  constexpr double kDegreesOfFreedom = 5.0;
  const double limit = stats::StudentQuantile(
      1.0 - 0.5 * kFalseAlarms / static_cast<double>(count), kDegreesOfFreedom);
  const VectorXd sizes = apart.array().abs() / scale.array();
  Index worst = 0;
  if (!(sizes.maxCoeff(&worst) > limit)) return std::nullopt;
  // What w is made of in session_start.cc, without its scale.
  const Eigen::ArrayXd variance = sd.array().square() + pooled * pooled;
  const VectorXd change =
      weight.array() * variance / (weight.array().square() * variance).sum();
  if (LooksBegunInside(found, weight, change, worst)) return std::nullopt;
  return SensorFaultFound{
      .fault = SensorFault::kOff,
      .columns = {inputs[static_cast<std::size_t>(worst)]->column},
      .value = apart[worst],
      .looks_like = ""};
}

std::optional<SensorFaultFound> FindSensorFault(const FittedModel& fitted,
                                                const MatrixXd& readings,
                                                bool from_start) {
  if (auto unit = OfAnotherUnit(fitted, readings)) return unit;
  if (fitted.applicability == nullptr) return std::nullopt;
  const MatrixXd states =
      WholeRows(readings(Eigen::all, fitted.applicability->columns));
  if (states.rows() == 0) return std::nullopt;
  auto found = AgainstTheOthers(fitted, LateRows(states));
  if (!found && from_start) {
    found = OffAtStart(fitted, readings.row(0).transpose());
  }
  if (!found) found = Frozen(fitted, states);
  if (found) CallDead(fitted, readings, &*found);
  return found;
}

}  // namespace errmap::models
