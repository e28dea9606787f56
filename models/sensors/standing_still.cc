#include "models/sensors/standing_still.h"

#include <algorithm>
#include <cmath>

#include "stats/order_statistic.h"

namespace errmap::models {
namespace {

// A pause counts as so many rows: nothing is known of what happened in it.
constexpr double kPause = 3.0;

double MiddleOf(std::vector<double> values) {
  return values.empty() ? 0.0 : stats::UpperMedian(std::move(values));
}

VectorXd RangesOf(const MatrixXd& states) {
  if (states.rows() == 0) return VectorXd::Zero(states.cols());
  return states.colwise().maxCoeff() - states.colwise().minCoeff();
}

// Thermometers that moved as others did: places in `columns`.
std::vector<Index> Watched(const data::Dataset& training,
                           const std::vector<Index>& columns,
                           const VectorXd& ranges) {
  constexpr double kLeastShare = 0.25;
  const auto unit = [&](Index i) -> const data::Unit& {
    const Index column = columns[static_cast<std::size_t>(i)];
    return training.inputs()[static_cast<std::size_t>(column)].unit;
  };
  std::vector<Index> watched;
  for (Index i = 0; i < ranges.size(); ++i) {
    if (unit(i).quantity != data::Quantity::kTemperature) continue;
    std::vector<double> alike;
    for (Index k = 0; k < ranges.size(); ++k) {
      if (unit(k) == unit(i)) alike.push_back(ranges[k]);
    }
    if (ranges[i] > 0.0 &&
        ranges[i] >= kLeastShare * MiddleOf(std::move(alike))) {
      watched.push_back(i);
    }
  }
  return watched;
}

// The least difference of two values, but for how sums of them are rounded.
double Resolution(const VectorXd& column) {
  constexpr double kRounding = 1e-6;
  std::vector<double> values(column.begin(), column.end());
  std::ranges::sort(values);
  const double least = kRounding * (values.back() - values.front());
  double resolution = values.back() - values.front();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double gap = values[i] - values[i - 1];
    if (gap > least) resolution = std::min(resolution, gap);
  }
  return resolution;
}

// Sessions as runs of rows.
std::vector<Index> FirstRowsOf(const data::Dataset& training) {
  const std::vector<Index> codes = training.session_codes();
  std::vector<Index> first;
  for (Index row = 0; row < training.num_rows(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    if (row == 0 || (!codes.empty() && codes[at] != codes[at - 1])) {
      first.push_back(row);
    }
  }
  first.push_back(training.num_rows());
  return first;
}

// What `common` moved while `column` held a value.
double MovedMeanwhile(const VectorXd& column,
                      const VectorXd& common,
                      const std::vector<Index>& first) {
  double most = 0.0;
  for (std::size_t k = 0; k + 1 < first.size(); ++k) {
    Index since = first[k];
    for (Index row = first[k]; row < first[k + 1]; ++row) {
      if (column[row] != column[since]) since = row;
      most = std::max(most, std::abs(common[row] - common[since]));
    }
  }
  return most;
}

// Seconds from each row to the next of its session. Empty where times are not
// known.
VectorXd StepsOf(const data::Dataset& training,
                 const std::vector<Index>& first,
                 double* typical) {
  const auto& log = training.log();
  if (log == nullptr || log->time_unit != "s") return {};
  VectorXd steps = VectorXd::Zero(training.num_rows());
  std::vector<double> all;
  for (std::size_t k = 0; k + 1 < first.size(); ++k) {
    for (Index row = first[k]; row + 1 < first[k + 1]; ++row) {
      const auto at = static_cast<std::size_t>(row);
      steps[row] = log->time[training.log_rows()[at + 1]] -
                   log->time[training.log_rows()[at]];
      if (steps[row] > 0.0) all.push_back(steps[row]);
    }
  }
  *typical = MiddleOf(std::move(all));
  return steps;
}

// How a column changes from row to row.
struct Changes {
  double turns = 0.0;    // of its rows, those where it turns
  double longest = 0.0;  // for which it held a value (s)
  double largest = 0.0;  // in the time of a row
};

Changes ChangesOf(const VectorXd& column,
                  const std::vector<Index>& first,
                  const VectorXd& steps,
                  double typical) {
  Changes found;
  double rows = 0.0;
  for (std::size_t k = 0; k + 1 < first.size(); ++k) {
    double way = 0.0;
    double held = 0.0;
    for (Index row = first[k]; row + 1 < first[k + 1]; ++row) {
      const double change = column[row + 1] - column[row];
      rows += 1.0;
      found.turns += change * way < 0.0 ? 1.0 : 0.0;
      held =
          change == 0.0 ? held + std::min(steps[row], kPause * typical) : 0.0;
      if (change != 0.0) way = change;
      found.longest = std::max(found.longest, held);
      found.largest =
          std::max(found.largest,
                   std::abs(change) / std::max(1.0, steps[row] / typical));
    }
  }
  if (rows > 0.0) found.turns /= rows;
  return found;
}

// The longest time without a column that turns.
double LongestWithoutTurn(const MatrixXd& states,
                          const std::vector<Index>& watched,
                          const std::vector<Index>& first,
                          const VectorXd& steps) {
  double longest = 0.0;
  for (std::size_t k = 0; k + 1 < first.size(); ++k) {
    VectorXd way = VectorXd::Zero(states.cols());
    double since = 0.0;
    for (Index row = first[k]; row + 1 < first[k + 1]; ++row) {
      since += steps[row];
      longest = std::max(longest, since);
      for (const Index i : watched) {
        const double change = states(row + 1, i) - states(row, i);
        if (change * way[i] < 0.0) since = 0.0;
        if (change != 0.0) way[i] = change;
      }
    }
  }
  return longest;
}

}  // namespace

StandingStill LearnStandingStill(const data::Dataset& training,
                                 const std::vector<Index>& columns) {
  constexpr double kLeast = 0.05;
  constexpr double kMargin = 3.0;
  constexpr double kJumpMargin = 2.0;
  constexpr double kSteps = 5.0;
  constexpr double kRows = 10.0;
  constexpr double kNoisy = 0.2;
  const MatrixXd states = training.input_values()(Eigen::all, columns);
  const VectorXd none = VectorXd::Zero(states.cols());
  StandingStill learnt{.others_move = none,
                       .resolution = none,
                       .quiet = none,
                       .jump = none,
                       .pace = none};
  const VectorXd ranges = RangesOf(states);
  const std::vector<Index> watched = Watched(training, columns, ranges);
  if (watched.empty()) return learnt;
  const auto others = std::max(1.0, static_cast<double>(watched.size()) - 1.0);
  VectorXd common = VectorXd::Zero(states.rows());
  for (const Index i : watched) {
    common += states.col(i) / (ranges[i] * others);
  }
  const std::vector<Index> first = FirstRowsOf(training);
  double typical = 0.0;
  const VectorXd steps = StepsOf(training, first, &typical);
  const VectorXd seen = steps.cwiseMin(kPause * typical);
  const bool has_times = typical > 0.0;
  const double ten_rows = kRows * typical;
  for (const Index i : watched) {
    const VectorXd column = states.col(i);
    const double range = ranges[i];
    learnt.resolution[i] = Resolution(column) / range;
    const double five_steps = kSteps * learnt.resolution[i];
    learnt.others_move[i] = std::max(
        {kLeast, kMargin * MovedMeanwhile(column, common, first), five_steps});
    if (!has_times) continue;
    const Changes changes = ChangesOf(column, first, steps, typical);
    if (changes.turns >= kNoisy) {
      learnt.quiet[i] = std::max(kMargin * changes.longest, ten_rows);
    }
    const double fastest = kJumpMargin * changes.largest / range;
    learnt.jump[i] = std::max({kLeast, fastest, five_steps});
    learnt.pace[i] = fastest / typical;
  }
  if (has_times) {
    learnt.silence = std::max(
        kMargin * LongestWithoutTurn(states, watched, first, seen), ten_rows);
  }
  return learnt;
}

}  // namespace errmap::models
