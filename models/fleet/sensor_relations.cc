#include <algorithm>
#include <cstdint>

#include "data/input_error.h"
#include "fitting/least_squares/decompositions.h"
#include "models/fleet/watch.h"
#include "models/record_json.h"
#include "stats/order_statistic.h"

namespace errmap::models {

struct RelationsColumn {
  std::string name;
  std::string unit;
};
/// The members of SensorRelations as the file has them.
struct RelationsRecord {
  std::string schema;
  std::vector<RelationsColumn> columns;
  std::vector<double> mean;
  std::vector<std::vector<double>> weights;  // rows
  std::vector<double> variance;
  std::vector<double> distance;
  std::vector<double> spread;
  LeftOut<std::vector<double>> within;  // since 0.1.0, as is `rows`
  std::int64_t sessions = 0;
  std::int64_t rows = 0;
};

namespace {

constexpr Index kFewestLeftOut = 3;

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
  const MatrixXd precision = fitting::CholeskyInverse(covariance);
  found.variance = precision.diagonal().cwiseInverse();
  found.weights = precision * found.variance.asDiagonal();
  return found;
}

// Variance of the rows' shifts about their mean.
VectorXd WithinOf(const SensorRelations& relations, const MatrixXd& values) {
  const MatrixXd centred = values.rowwise() - values.colwise().mean();
  return (centred * relations.weights).cwiseAbs2().colwise().mean().transpose();
}

std::vector<Index> SensorsOf(const data::Dataset& dataset) {
  std::vector<Index> sensors;
  for (Index i = 0; i < dataset.num_inputs(); ++i) {
    const data::ColumnInfo& column = dataset.inputs()[std::size_t(i)];
    if (data::IsReadBySensor(column)) sensors.push_back(i);
  }
  return sensors;
}

std::vector<double> ToList(const VectorXd& values) {
  return {values.begin(), values.end()};
}

VectorXd ToVector(const std::vector<double>& values, Index size) {
  if (std::ssize(values) != size) {
    throw data::InputError("has lists of other lengths than its columns");
  }
  return Eigen::Map<const VectorXd>(values.data(), size);
}

constexpr const char* kSchema = "errmap-relations-1";

}  // namespace

std::string SensorRelations::ToJsonText() const {
  RelationsRecord record{.schema = kSchema,
                         .columns = {},
                         .mean = ToList(mean),
                         .weights = {},
                         .variance = ToList(variance),
                         .distance = ToList(distance),
                         .spread = ToList(spread),
                         .within = ToList(within),
                         .sessions = sessions,
                         .rows = rows};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    record.columns.push_back({columns[i].name, columns[i].unit.symbol});
    record.weights.push_back(ToList(weights.row(Index(i)).transpose()));
  }
  return JsonText(record, -1) + "\n";
}

SensorRelations SensorRelations::FromJsonText(std::string_view text) {
  const auto record = RecordFromText<RelationsRecord>(
      text, kSchema, "errmap compare and errmap deploy rewrite it");
  SensorRelations found;
  for (const RelationsColumn& column : record.columns) {
    found.columns.push_back(
        {.name = column.name, .unit = data::UnitOfSymbol(column.unit)});
  }
  const Index size = std::ssize(found.columns);
  found.mean = ToVector(record.mean, size);
  found.variance = ToVector(record.variance, size);
  found.distance = ToVector(record.distance, size);
  found.spread = ToVector(record.spread, size);
  if (std::ssize(record.weights) != size) {
    throw data::InputError("has lists of other lengths than its columns");
  }
  found.weights.resize(size, size);
  for (Index i = 0; i < size; ++i) {
    found.weights.row(i) =
        ToVector(record.weights[std::size_t(i)], size).transpose();
  }
  found.within = record.within ? ToVector(*record.within, size)
                               : VectorXd(VectorXd::Zero(size));
  found.sessions = record.sessions;
  found.rows = record.rows;
  return found;
}

std::optional<SensorRelations> LearnRelations(const data::Dataset& training) {
  const std::vector<Index> sensors = SensorsOf(training);
  const std::vector<Index> codes = training.session_codes();
  const Index sessions =
      codes.empty() ? 0 : *std::ranges::max_element(codes) + 1;
  if (sensors.size() < 2 || sessions < kFewestLeftOut) return std::nullopt;
  const MatrixXd values = training.input_values()(Eigen::all, sensors);
  MatrixXd shifts(sessions, values.cols());
  MatrixXd distances(sessions, values.cols());
  VectorXd within = VectorXd::Zero(values.cols());
  std::vector<Index> sizes;
  Index used = 0;
  for (Index session = 0; session < sessions; ++session) {
    std::vector<Index> of_it;
    std::vector<Index> others;
    for (std::size_t row = 0; row < codes.size(); ++row) {
      (codes[row] == session ? of_it : others).push_back(Index(row));
    }
    if (of_it.empty() || others.empty()) continue;
    const SensorRelations of_others =
        RegressOnOthers(values(others, Eigen::all));
    const MatrixXd of_session = values(of_it, Eigen::all);
    const SensorShifts left_out = ShiftsOf(of_others, of_session);
    within += WithinOf(of_others, of_session);
    sizes.push_back(of_session.rows());
    shifts.row(used) = left_out.shift.transpose();
    distances.row(used) = left_out.distance.transpose();
    ++used;
  }
  if (used < kFewestLeftOut) return std::nullopt;
  shifts.conservativeResize(used, Eigen::NoChange);
  distances.conservativeResize(used, Eigen::NoChange);
  SensorRelations found = RegressOnOthers(values);
  for (const Index sensor : sensors) {
    found.columns.push_back(training.inputs()[std::size_t(sensor)]);
  }
  found.sessions = used;
  found.rows = stats::UpperMedian(std::move(sizes));
  found.within = within / static_cast<double>(used);
  found.distance = distances.colwise().mean();
  found.spread = (shifts.array().square() / found.Widening(distances))
                     .colwise()
                     .mean()
                     .sqrt()
                     .transpose();
  return found;
}

Eigen::ArrayXXd SensorRelations::Widening(const MatrixXd& distances) const {
  constexpr double kLeast = 1e-12;
  return 1.0 +
         distances.array().rowwise() / distance.array().max(kLeast).transpose();
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

}  // namespace errmap::models
