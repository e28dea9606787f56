#include "models/fleet/watch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <nlohmann/json.hpp>

#include "data/formats/nesting.h"
#include "data/input_error.h"
#include "data/text.h"
#include "fitting/least_squares/decompositions.h"
#include "models/study/record/record_json.h"
#include "stats/distributions.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kFewestSessions = 3;

// What the spread common to all sensors counts in that of one, in sessions.
constexpr double kPriorSessions = 1.0;
// Odd days are more frequent than t has them: by so much wider, of 252 healthy
// days of simulated machines 1 instead of 3 has a corrected p below 0.0025.
constexpr double kSensorWidening = 1.25;

// Makes mean, weights and variance, by the inverse covariance P: value less
// what the others tell is (x - mean)' P / diag(P), its variance 1 / diag(P).
SensorRelations RegressOnOthers(const MatrixXd& values) {
  // A channel that shows one value has no scatter; in units of the reading.
  constexpr double kLeastVariance = 1e-5;
  SensorRelations found;
  found.mean = values.colwise().mean();
  const MatrixXd centred = values.rowwise() - found.mean.transpose();
  const Index size = values.cols();
  const MatrixXd covariance =
      centred.transpose() * centred / static_cast<double>(values.rows()) +
      kLeastVariance * MatrixXd::Identity(size, size);
  const MatrixXd precision =
      covariance.llt().solve(MatrixXd::Identity(size, size));
  found.variance = precision.diagonal().cwiseInverse();
  found.weights = precision * found.variance.asDiagonal();
  return found;
}

// Of the distances of one sensor's others to their usual one, what widens the
// variance of its shift.
Eigen::ArrayXXd Widening(const MatrixXd& distances, const VectorXd& usual) {
  constexpr double kLeast = 1e-12;
  return 1.0 +
         distances.array().rowwise() / usual.array().max(kLeast).transpose();
}

std::vector<Index> SensorsOf(const data::Dataset& dataset) {
  std::vector<Index> sensors;
  for (Index i = 0; i < dataset.num_inputs(); ++i) {
    const data::ColumnInfo& column = dataset.inputs()[std::size_t(i)];
    if (!data::StartsWithIgnoringCase(column.name, "position")) {
      sensors.push_back(i);
    }
  }
  return sensors;
}

double MeanSquareOf(const VectorXd& residuals) {
  return residuals.squaredNorm() / static_cast<double>(residuals.size());
}

// Of the newest `count` sessions.
MapJudgement JudgeNewest(const HeldOutErrors& held_out,
                         const std::vector<WatchedSession>& sessions,
                         std::size_t count) {
  const auto n = static_cast<double>(held_out.units.size());
  const auto k = static_cast<double>(count);
  double offsets = 0.0;  // sum of squares
  VectorXd logs(static_cast<Index>(held_out.units.size()));
  Index filled = 0;
  for (const HeldOutErrors::Unit& unit : held_out.units) {
    const double offset = unit.residuals.mean();
    offsets += offset * offset;
    logs[filled++] = std::log(MeanSquareOf(unit.residuals));
  }
  double offset = 0.0;
  double square = 0.0;
  for (std::size_t i = sessions.size() - count; i < sessions.size(); ++i) {
    offset += sessions[i].offset / k;
    square += sessions[i].mean_square / k;
  }
  MapJudgement found;
  found.promised = held_out.rmse;
  found.found = std::sqrt(square);
  if (!logs.allFinite() || !(offsets > 0.0)) return found;
  const double t = offset / std::sqrt(offsets / n / k);
  found.p_offset = stats::StudentTwoSided(t, n);
  // Mean squares differ by factors from day to day. How widely is known from n
  // days only: F with degrees of freedom estimated from them takes it as given,
  // and accused healthy days that were odd by a factor of 6 at p = 1e-6.
  constexpr double kMostFreedom = 1000.0;
  const double mean = logs.mean();
  const double sd =
      std::max(std::sqrt((logs.array() - mean).square().sum() / (n - 1.0)),
               std::sqrt(2.0 / kMostFreedom));
  const double t_rms =
      (std::log(square) - mean) / (sd * std::sqrt(1.0 / k + 1.0 / n));
  const double both = stats::StudentTwoSided(t_rms, n - 1.0);
  found.p_rms = t_rms > 0.0 ? 0.5 * both : 1.0 - 0.5 * both;
  found.p = std::min(1.0, 2.0 * std::min(found.p_offset, found.p_rms));
  return found;
}

RecordJson ToArray(const VectorXd& values) {
  return ToJson(std::vector<double>(values.begin(), values.end()));
}

VectorXd ToVector(const RecordJson& json, Index size) {
  std::vector<double> values;
  FromJson(json, &values);
  if (static_cast<Index>(values.size()) != size) {
    throw data::InputError("has lists of other lengths than its columns");
  }
  return Eigen::Map<const VectorXd>(values.data(), size);
}

constexpr const char* kSchema = "errmap-relations-1";

}  // namespace

std::string SensorRelations::ToJsonText() const {
  RecordJson names = RecordJson::array();
  RecordJson rows = RecordJson::array();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    names.push_back(
        {{"name", columns[i].name}, {"unit", columns[i].unit.symbol}});
    rows.push_back(ToArray(weights.row(Index(i)).transpose()));
  }
  const RecordJson json = {{"schema", kSchema},
                           {"columns", std::move(names)},
                           {"mean", ToArray(mean)},
                           {"weights", std::move(rows)},
                           {"variance", ToArray(variance)},
                           {"distance", ToArray(distance)},
                           {"spread", ToArray(spread)},
                           {"sessions", sessions}};
  return json.dump(-1, ' ', false, RecordJson::error_handler_t::replace) + "\n";
}

SensorRelations SensorRelations::FromJsonText(std::string_view text) {
  data::RequireShallowJson(text);
  const RecordJson json = RecordJson::parse(text, nullptr, false);
  if (!json.is_object() || json.value("schema", RecordJson()) != kSchema) {
    throw data::InputError("is not what compare wrote (errmap-relations-1)");
  }
  SensorRelations found;
  for (const RecordJson& column : json.value("columns", RecordJson::array())) {
    std::string name;
    std::string unit;
    FromJson(column.value("name", RecordJson()), &name);
    FromJson(column.value("unit", RecordJson()), &unit);
    found.columns.push_back({.name = name, .unit = data::UnitOfSymbol(unit)});
  }
  const auto size = static_cast<Index>(found.columns.size());
  found.mean = ToVector(json.value("mean", RecordJson()), size);
  found.variance = ToVector(json.value("variance", RecordJson()), size);
  found.distance = ToVector(json.value("distance", RecordJson()), size);
  found.spread = ToVector(json.value("spread", RecordJson()), size);
  found.weights.resize(size, size);
  const RecordJson rows = json.value("weights", RecordJson::array());
  if (!rows.is_array() || static_cast<Index>(rows.size()) != size) {
    throw data::InputError("has lists of other lengths than its columns");
  }
  for (Index i = 0; i < size; ++i) {
    found.weights.row(i) = ToVector(rows[std::size_t(i)], size).transpose();
  }
  FromJson(json.value("sessions", RecordJson()), &found.sessions);
  return found;
}

std::optional<SensorRelations> LearnRelations(const data::Dataset& training) {
  const std::vector<Index> sensors = SensorsOf(training);
  const std::vector<Index> codes = training.session_codes();
  const Index sessions =
      codes.empty() ? 0 : *std::ranges::max_element(codes) + 1;
  if (sensors.size() < 2 || sessions < kFewestSessions) return std::nullopt;
  const MatrixXd values = training.input_values()(Eigen::all, sensors);
  MatrixXd shifts(sessions, values.cols());
  MatrixXd distances(sessions, values.cols());
  Index used = 0;
  for (Index session = 0; session < sessions; ++session) {
    std::vector<Index> of_it;
    std::vector<Index> others;
    for (std::size_t row = 0; row < codes.size(); ++row) {
      (codes[row] == session ? of_it : others).push_back(Index(row));
    }
    if (of_it.empty() || others.empty()) continue;
    const SensorShifts left_out = ShiftsOf(
        RegressOnOthers(values(others, Eigen::all)), values(of_it, Eigen::all));
    shifts.row(used) = left_out.shift.transpose();
    distances.row(used) = left_out.distance.transpose();
    ++used;
  }
  if (used < kFewestSessions) return std::nullopt;
  shifts.conservativeResize(used, Eigen::NoChange);
  distances.conservativeResize(used, Eigen::NoChange);
  SensorRelations found = RegressOnOthers(values);
  for (const Index sensor : sensors) {
    found.columns.push_back(training.inputs()[std::size_t(sensor)]);
  }
  found.sessions = used;
  found.distance = distances.colwise().mean();
  found.spread = (shifts.array().square() / Widening(distances, found.distance))
                     .colwise()
                     .mean()
                     .sqrt()
                     .transpose();
  return found;
}

SensorShifts ShiftsOf(const SensorRelations& relations,
                      const MatrixXd& values) {
  const VectorXd mean = values.colwise().mean();
  const VectorXd centred = mean - relations.mean;
  SensorShifts found;
  found.shift = relations.weights.transpose() * centred;
  // x' P x of all sensors is that of the others and the shift's own.
  const Eigen::ArrayXd scaled = found.shift.cwiseQuotient(relations.variance);
  const double all = centred.dot(scaled.matrix());
  found.distance = (all - found.shift.array() * scaled).max(0.0);
  return found;
}

void JudgeSensors(const SensorRelations& relations,
                  const SensorShifts& shifts,
                  WatchedSession* session) {
  const VectorXd squares = relations.spread.cwiseAbs2();
  constexpr double kLeast = 1e-12;
  const double common = std::exp(squares.cwiseMax(kLeast).array().log().mean());
  const auto n = static_cast<double>(relations.sessions);
  const Eigen::ArrayXd widening =
      Widening(shifts.distance.transpose(), relations.distance).transpose();
  Index worst = 0;
  double largest = 0.0;
  for (Index i = 0; i < squares.size(); ++i) {
    const double variance = widening[i] *
                            (n * squares[i] + kPriorSessions * common) /
                            (n + kPriorSessions);
    const double t =
        std::abs(shifts.shift[i]) / (kSensorWidening * std::sqrt(variance));
    if (t <= largest) continue;
    largest = t;
    worst = i;
  }
  session->sensor = relations.columns[std::size_t(worst)].name;
  session->sensor_shift = shifts.shift[worst];
  session->p_sensor =
      std::min(1.0,
               static_cast<double>(squares.size()) *
                   stats::StudentTwoSided(largest, n + kPriorSessions - 1.0));
}

std::optional<MapJudgement> JudgeSessions(
    const HeldOutErrors& held_out,
    const std::vector<WatchedSession>& sessions) {
  if (static_cast<Index>(held_out.units.size()) < kFewestSessions ||
      sessions.empty()) {
    return std::nullopt;
  }
  MapJudgement best = JudgeNewest(held_out, sessions, 1);
  if (sessions.size() == 1) return best;
  const MapJudgement two = JudgeNewest(held_out, sessions, 2);
  if (two.p < best.p) best = two;
  best.p = std::min(1.0, 2.0 * best.p);
  return best;
}

std::vector<double> FalseDiscoveryRates(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> rates(p.size());
  double least = 1.0;
  for (std::size_t rank = order.size(); rank-- > 0;) {
    least = std::min(least,
                     p[order[rank]] * static_cast<double>(p.size()) /
                         static_cast<double>(rank + 1));
    rates[order[rank]] = least;
  }
  return rates;
}

std::string_view ToString(WatchStatus status) {
  switch (status) {
    case WatchStatus::kAsPromised:
      return "as promised";
    case WatchStatus::kWorse:
      return "worse";
    case WatchStatus::kSensorChanged:
      return "sensor changed";
    case WatchStatus::kOutside:
      return "outside";
    case WatchStatus::kNotJudged:
      return "not judged";
  }
  return "";
}

}  // namespace errmap::models
