#include "models/sensors/applicability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "data/text.h"
#include "fitting/least_squares/decompositions.h"
#include "models/history/history.h"
#include "models/history/view.h"
#include "models/inner_folds.h"
#include "models/scaling.h"
#include "models/sensors/standing_still.h"
#include "models/study/study.h"
#include "stats/indices.h"
#include "stats/order_statistic.h"

namespace errmap::models {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Of the variance of the states, what the directions leave to each column by
// itself; more of them than this many are told by no few days.
constexpr double kVarianceLeft = 0.01;
constexpr Index kMostDirections = 8;
// More columns than these are not told apart, at their number squared.
constexpr Index kMostColumns = 100;
// States kept: enough to cover a day every quarter of an hour or so.
constexpr Index kMostStates = 64;
// The covariance of more rows is the same but for the time it takes.
constexpr Index kMostRowsKept = 4000;
// The share of a held-out unit's readings that a limit must cover. It need not
// cover all: single readings fail.
constexpr double kReached = 0.99;
// Further days go somewhat beyond what the few seen ones reached.
constexpr double kMargin = 1.5;

MatrixXd StatesOf(const MatrixXd& inputs, const std::vector<Index>& columns) {
  return inputs(Eigen::all, columns);
}

// W and the variances that it leaves.
void FitFactors(const MatrixXd& scaled, Applicability* trained) {
  const Index size = scaled.cols();
  const MatrixXd covariance =
      scaled.transpose() * scaled / static_cast<double>(scaled.rows());
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(covariance);
  const double total = covariance.trace();
  double left = total;
  Index count = 0;
  while (count < std::min(size, kMostDirections) &&
         left > kVarianceLeft * total) {
    left -= eigen.eigenvalues()[size - 1 - count++];
  }
  count = std::max<Index>(count, 1);
  // Columns that never moved have no direction; they must not divide by it.
  constexpr double kLeastVariance = 1e-9;
  const VectorXd roots =
      eigen.eigenvalues().tail(count).cwiseMax(kLeastVariance).cwiseSqrt();
  trained->directions =
      eigen.eigenvectors().rightCols(count) * roots.asDiagonal();
  // A column that the directions hold whole would else have no scatter at all.
  constexpr double kLeastRest = 1e-4;
  trained->rest =
      (covariance.diagonal() - trained->directions.rowwise().squaredNorm())
          .cwiseMax(kLeastRest);
}

MatrixXd Scaled(const Applicability& trained, const MatrixXd& states) {
  return (states.rowwise() - trained.mean.transpose()).array().rowwise() /
         trained.scale.transpose().array();
}

// The columns of W are orthogonal, so W'W is diagonal.
MatrixXd Scores(const Applicability& trained, const MatrixXd& scaled) {
  const Eigen::RowVectorXd squares = trained.directions.colwise().squaredNorm();
  return (scaled * trained.directions).array().rowwise() / squares.array();
}

VectorXd SquaredDistances(const MatrixXd& scores, const MatrixXd& states) {
  VectorXd least = VectorXd::Constant(scores.rows(), kInfinity);
  for (Index k = 0; k < states.rows(); ++k) {
    least = least.cwiseMin(
        (scores.rowwise() - states.row(k)).rowwise().squaredNorm());
  }
  return least;
}

// States that leave no other far away: each next one is the farthest from those
// before it (Gonzalez 1985).
MatrixXd SpreadEvenly(const MatrixXd& scores) {
  std::vector<Index> chosen{0};
  VectorXd least = SquaredDistances(scores, scores.row(0));
  Index farthest = 0;
  while (static_cast<Index>(chosen.size()) < kMostStates &&
         least.maxCoeff(&farthest) > 0.0) {
    chosen.push_back(farthest);
    least = least.cwiseMin(SquaredDistances(scores, scores.row(farthest)));
  }
  return scores(chosen, Eigen::all);
}

// SessionReadings::precision, as these rows scatter.
MatrixXd PrecisionOf(const MatrixXd& scaled) {
  constexpr double kLeastVariance = 1e-4;  // as of `rest`
  MatrixXd covariance =
      scaled.transpose() * scaled / static_cast<double>(scaled.rows());
  covariance.diagonal().array() += kLeastVariance;
  return fitting::CholeskyInverse(covariance);
}

Applicability FitStates(const MatrixXd& states,
                        const std::vector<TrainedInput>& inputs,
                        const std::vector<Index>& columns) {
  Applicability trained;
  trained.columns = columns;
  trained.rows = states.rows();
  trained.mean = states.colwise().mean();
  std::vector<std::string> units;
  for (const Index column : columns) {
    units.push_back(
        inputs[static_cast<std::size_t>(column)].column.unit.symbol);
  }
  trained.scale = SpreadsOfUnits(states, units);
  const MatrixXd scaled = Scaled(trained, states);
  FitFactors(scaled, &trained);
  if (states.cols() <= kMostColumns) {
    trained.sessions = {.precision = PrecisionOf(scaled),
                        .scatter = VectorXd::Ones(states.cols()),
                        .units = 0,
                        .starts = {}};
  }
  trained.states = SpreadEvenly(Scores(trained, scaled));
  return trained;
}

// The kReached-th of these sizes.
double Reached(VectorXd sizes) {
  const auto rank = static_cast<std::size_t>(
      std::floor(kReached * static_cast<double>(sizes.size() - 1)));
  return stats::OrderStatistic(std::move(sizes), rank);
}

// (columns) The mean square of what they stand from where the others tell, over
// the variance that this should have.
VectorXd ScatterOf(const Applicability& trained, const MatrixXd& states) {
  const MatrixXd& precision = trained.sessions->precision;
  const MatrixXd pulled = Scaled(trained, states) * precision;
  return pulled.colwise().squaredNorm().transpose().array() /
         precision.diagonal().array() / static_cast<double>(states.rows());
}

// Limits from rows that had no part in what they are held against.
void SetLimits(const MatrixXd& states,
               const fitting::FoldCodes& folds,
               const std::vector<TrainedInput>& inputs,
               Applicability* trained) {
  constexpr double kLeastLimit = 1e-9;
  trained->distance_limit = kLeastLimit;
  trained->leverage_limit = kLeastLimit;
  trained->relation_limit = VectorXd::Constant(states.cols(), kLeastLimit);
  VectorXd scatter = VectorXd::Zero(states.cols());
  for (Index fold = 0; fold < folds.count(); ++fold) {
    const auto [rest, out] = folds.Split(fold);
    const Applicability of_rest =
        FitStates(states(rest, Eigen::all), inputs, trained->columns);
    const StateMeasures found = MeasureStates(of_rest, states(out, Eigen::all));
    if (of_rest.sessions) {
      scatter += ScatterOf(of_rest, states(out, Eigen::all));
    }
    trained->distance_limit =
        std::max(trained->distance_limit, kMargin * Reached(found.distance));
    trained->leverage_limit =
        std::max(trained->leverage_limit, kMargin * Reached(found.leverage));
    for (Index i = 0; i < states.cols(); ++i) {
      trained->relation_limit[i] =
          std::max(trained->relation_limit[i],
                   kMargin * Reached(found.relation.col(i).cwiseAbs()));
    }
  }
  const double mean = scatter.mean();
  if (!trained->sessions || !(mean > 0.0)) return;
  trained->sessions->precision *= static_cast<double>(folds.count()) / mean;
  trained->sessions->scatter = (scatter / mean).cwiseMax(1.0);
}

// Rows of each session, in their order.
std::vector<std::vector<Index>> RowsOfSessions(const data::Dataset& training) {
  auto rows = stats::IndicesByCode(training.session_codes());
  std::erase_if(rows, [](const auto& of_one) { return of_one.empty(); });
  return rows;
}

// How many of a session's rows are its first readings: one without times.
std::size_t CountFirstReadings(const data::Dataset& training,
                               const std::vector<Index>& rows) {
  const auto& log = training.log();
  if (log == nullptr || log->time_unit != "s") return 1;
  const auto time_of = [&](Index row) {
    return log->time[training.log_rows()[static_cast<std::size_t>(row)]];
  };
  constexpr double kSeconds = 20.0;  // in which no temperature moves
  const double until = time_of(rows.front()) + kSeconds;
  const auto end = std::ranges::find_if(
      rows, [&](Index row) { return time_of(row) > until; });
  return static_cast<std::size_t>(end - rows.begin());
}

std::optional<SessionStarts> StartsOf(const data::Dataset& training,
                                      const Applicability& trained,
                                      const MatrixXd& states) {
  constexpr std::size_t kFewestSessions = 4;
  const std::vector<std::vector<Index>> sessions = RowsOfSessions(training);
  if (sessions.size() < kFewestSessions) return std::nullopt;
  const MatrixXd scaled = Scaled(trained, states);
  MatrixXd first(std::ssize(sessions), scaled.cols());
  MatrixXd changes = MatrixXd::Zero(scaled.cols(), scaled.cols());
  for (Index i = 0; i < first.rows(); ++i) {
    const std::vector<Index>& rows = sessions[static_cast<std::size_t>(i)];
    const MatrixXd of_session = scaled(rows, Eigen::all);
    const auto count = static_cast<Index>(CountFirstReadings(training, rows));
    first.row(i) = of_session.topRows(count).colwise().mean();
    const MatrixXd since = of_session.rowwise() - first.row(i);
    changes += since.transpose() * since;
  }
  const VectorXd mean = first.colwise().mean();
  const MatrixXd apart = first.rowwise() - mean.transpose();
  return SessionStarts{.mean = mean,
                       .covariance = apart.transpose() * apart /
                                     static_cast<double>(sessions.size() - 1),
                       .changes = changes / static_cast<double>(scaled.rows()),
                       .sessions = std::ssize(sessions)};
}

// Applicability::repeats of the columns of these rows.
VectorXd RepeatsOf(const data::Dataset& training, const MatrixXd& states) {
  const std::vector<Index> sessions = training.session_codes();
  VectorXd repeats = VectorXd::Zero(states.cols());
  Eigen::ArrayXd run = Eigen::ArrayXd::Zero(states.cols());  // of repeats
  Eigen::ArrayXd longest = run;
  Index steps = 0;
  for (Index row = 1; row < states.rows(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    if (!sessions.empty() && sessions[at] != sessions[at - 1]) {
      run.setZero();
      continue;
    }
    ++steps;
    const Eigen::ArrayXd same =
        (states.row(row).array() == states.row(row - 1).array())
            .transpose()
            .cast<double>();
    repeats.array() += same;
    run = (run + 1.0) * same;
    longest = longest.max(run);
  }
  if (steps == 0) return {};
  const auto count = static_cast<double>(steps);
  // Of so many steps, a run of k repeats is to be expected once where one in
  // count^(1/k) repeats.
  const Eigen::ArrayXd by_run =
      (-std::log(count) / longest.max(std::numeric_limits<double>::min()))
          .exp();
  return (repeats / count).cwiseMax(by_run.matrix());
}

std::vector<Applicability::Derived> DerivedRanges(
    const FittedModel& fitted, const data::Dataset& training) {
  std::vector<Applicability::Derived> ranges;
  if (fitted.history == nullptr) return ranges;
  const MatrixXd values = fitted.FormInputs(training);
  Index i = 0;
  for (const std::string& name : fitted.history->form_inputs) {
    for (const DerivedInput& input : fitted.history->derived) {
      if (input.column.name != name) continue;
      ranges.push_back({.column = input.column,
                        .min = values.col(i).minCoeff(),
                        .max = values.col(i).maxCoeff()});
    }
    ++i;
  }
  return ranges;
}

void Worsen(RowFlag flag, RowFlag* worst) {
  if (flag.severity > worst->severity || std::isnan(flag.severity)) {
    *worst = std::move(flag);
  }
}

void JudgeRange(const data::ColumnInfo& column,
                double value,
                double min,
                double max,
                RowFlag* worst) {
  const double width = max - min;
  const double beyond = std::max(min - value, value - max);
  if (beyond <= kRangeTolerance * width) return;
  Worsen({.why = Outside::kRange,
          .column = column,
          .value = value,
          .low = min,
          .high = max,
          .severity = 1.0 + (width > 0.0 ? beyond / width : kInfinity)},
         worst);
}

void JudgeMeasure(Outside why, double value, double limit, RowFlag* worst) {
  if (!(value > limit)) return;
  Worsen({.why = why,
          .column = {},
          .value = value,
          .low = 0.0,
          .high = limit,
          .severity = value / limit},
         worst);
}

void JudgeState(const FittedModel& fitted,
                const StateMeasures& found,
                Index row,
                const MatrixXd& states,
                RowFlag* worst) {
  const Applicability& trained = *fitted.applicability;
  // One alone has no others to go with.
  for (Index i = 0; states.cols() > 1 && i < states.cols(); ++i) {
    const double size = std::abs(found.relation(row, i));
    const double limit = trained.relation_limit[i];
    if (!(size > limit)) continue;
    const double expected = found.expected(row, i);
    const double value = states(row, i);
    const double width = std::abs(value - expected) * limit / size;
    const Index column = trained.columns[static_cast<std::size_t>(i)];
    Worsen({.why = Outside::kRelation,
            .column = fitted.inputs[static_cast<std::size_t>(column)].column,
            .value = value,
            .low = expected - width,
            .high = expected + width,
            .severity = size / limit},
           worst);
  }
  // A column that is at fault says more than that the state is unlike.
  if (worst->outside()) return;
  JudgeMeasure(
      Outside::kDistance, found.distance[row], trained.distance_limit, worst);
  JudgeMeasure(
      Outside::kLeverage, found.leverage[row], trained.leverage_limit, worst);
}

// The columns of a thermal state: all inputs that are not positions.
struct StateColumns {
  std::vector<Index> of_map;
  std::vector<Index> of_training;  // the same
};

StateColumns StateColumnsOf(const FittedModel& fitted,
                            const data::Dataset& training) {
  StateColumns columns;
  for (std::size_t i = 0; i < fitted.inputs.size(); ++i) {
    const data::ColumnInfo& column = fitted.inputs[i].column;
    if (data::IsPosition(column)) continue;
    columns.of_map.push_back(static_cast<Index>(i));
    columns.of_training.push_back(training.FindInput(column.name));
  }
  return columns;
}

// All that FlagRows asks for.
std::optional<Applicability> LimitsOf(const FittedModel& fitted,
                                      const data::Dataset& training,
                                      const StateColumns& columns) {
  constexpr Index kFewestRows = 3;
  if (columns.of_map.empty() || training.num_rows() < kFewestRows) {
    return std::nullopt;
  }
  const data::Dataset rows = training.SelectRows(
      stats::SpreadSample(training.num_rows(), kMostRowsKept));
  const MatrixXd states = rows.input_values()(Eigen::all, columns.of_training);
  Applicability trained = FitStates(states, fitted.inputs, columns.of_map);
  trained.derived = DerivedRanges(fitted, training);
  const InnerFolds inner = MakeInnerFolds(rows, {});
  SetLimits(states, inner.folds, fitted.inputs, &trained);
  if (trained.sessions) trained.sessions->units = inner.units;
  return trained;
}

}  // namespace

std::string_view ToString(Outside outside) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"no", "range", "relation", "distance", "leverage"});
  return data::NameOf(kNames, outside);
}

StateMeasures MeasureStates(const Applicability& trained,
                            const MatrixXd& states) {
  const MatrixXd scaled = Scaled(trained, states);
  const MatrixXd scores = Scores(trained, scaled);
  const auto rows = static_cast<double>(trained.rows);
  StateMeasures found;
  found.distance = SquaredDistances(scores, trained.states).cwiseSqrt();
  found.leverage =
      scores.rowwise().squaredNorm().array() / (rows - 1.0) + 1.0 / rows;
  MatrixXd covariance = trained.directions * trained.directions.transpose();
  covariance.diagonal() += trained.rest;
  const MatrixXd precision = fitting::CholeskyInverse(covariance);
  // Of a normal vector with precision P, x_j less its mean given the others is
  // (P x)_j / P_jj, with variance 1 / P_jj.
  const MatrixXd pulled = scaled * precision;
  const Eigen::RowVectorXd own = precision.diagonal().transpose();
  found.relation = pulled.array().rowwise() / own.array().sqrt();
  const Eigen::RowVectorXd back =
      trained.scale.transpose().array() / own.array();
  found.expected = states.array() - pulled.array().rowwise() * back.array();
  return found;
}

std::optional<Applicability> MakeApplicability(const FittedModel& fitted,
                                               const data::Dataset& training) {
  const StateColumns columns = StateColumnsOf(fitted, training);
  std::optional<Applicability> trained = LimitsOf(fitted, training, columns);
  if (!trained) return trained;
  const MatrixXd states =
      training.input_values()(Eigen::all, columns.of_training);
  trained->repeats = RepeatsOf(training, states);
  trained->standing = LearnStandingStill(training, columns.of_training);
  if (trained->sessions) {
    trained->sessions->starts = StartsOf(training, *trained, states);
  }
  return trained;
}

std::vector<RowFlag> FlagRows(const FittedModel& fitted,
                              const MatrixXd& inputs,
                              const MatrixXd& form_inputs) {
  std::vector<RowFlag> flags(static_cast<std::size_t>(inputs.rows()));
  for (std::size_t row = 0; row < flags.size(); ++row) {
    for (std::size_t i = 0; i < fitted.inputs.size(); ++i) {
      const TrainedInput& input = fitted.inputs[i];
      JudgeRange(input.column,
                 inputs(static_cast<Index>(row), static_cast<Index>(i)),
                 input.min,
                 input.max,
                 &flags[row]);
    }
  }
  if (fitted.applicability == nullptr) return flags;
  const Applicability& trained = *fitted.applicability;
  std::size_t at = 0;
  for (Index i = 0; i < form_inputs.cols() && at < trained.derived.size();
       ++i) {
    const Applicability::Derived& derived = trained.derived[at];
    if (fitted.history->form_inputs[static_cast<std::size_t>(i)] !=
        derived.column.name) {
      continue;
    }
    for (std::size_t row = 0; row < flags.size(); ++row) {
      JudgeRange(derived.column,
                 form_inputs(static_cast<Index>(row), i),
                 derived.min,
                 derived.max,
                 &flags[row]);
    }
    ++at;
  }
  const MatrixXd states = StatesOf(inputs, trained.columns);
  const StateMeasures found = MeasureStates(trained, states);
  for (std::size_t row = 0; row < flags.size(); ++row) {
    JudgeState(fitted, found, static_cast<Index>(row), states, &flags[row]);
  }
  return flags;
}

std::vector<bool> InsideOfFolds(const FittedModel& fitted,
                                const data::Dataset& dataset,
                                const Holdout& holdout) {
  const data::Dataset& judged = holdout.Source(dataset);
  std::vector<Index> columns;
  std::vector<Index> of_judged;
  for (const TrainedInput& input : fitted.inputs) {
    columns.push_back(dataset.FindInput(input.column.name));
    of_judged.push_back(judged.FindInput(input.column.name));
  }
  std::vector<bool> inside;
  for (const stats::Fold& fold : holdout.folds) {
    const data::Dataset training = dataset.SelectRows(fold.train);
    FittedModel of_fold = fitted;
    of_fold.inputs = DescribeInputs(training, columns);
    of_fold.applicability = nullptr;
    if (auto trained =
            LimitsOf(of_fold, training, StateColumnsOf(of_fold, training))) {
      of_fold.applicability =
          std::make_shared<const Applicability>(std::move(*trained));
    }
    const data::Dataset held = judged.SelectRows(fold.test);
    for (const RowFlag& flag :
         FlagRows(of_fold,
                  held.input_values()(Eigen::all, of_judged),
                  of_fold.FormInputs(held))) {
      inside.push_back(!flag.outside());
    }
  }
  return inside;
}

}  // namespace errmap::models
