#include "models/fleet/sensor_relations.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "data/formats/nesting.h"
#include "data/input_error.h"
#include "data/measurements/column_roles.h"
#include "fitting/least_squares/decompositions.h"
#include "models/study/record/record_json.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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
  const MatrixXd precision =
      covariance.llt().solve(MatrixXd::Identity(size, size));
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
    if (data::IsSensor(column)) sensors.push_back(i);
  }
  return sensors;
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
  RecordJson list = RecordJson::array();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    names.push_back(
        {{"name", columns[i].name}, {"unit", columns[i].unit.symbol}});
    list.push_back(ToArray(weights.row(Index(i)).transpose()));
  }
  const RecordJson json = {{"schema", kSchema},
                           {"columns", std::move(names)},
                           {"mean", ToArray(mean)},
                           {"weights", std::move(list)},
                           {"variance", ToArray(variance)},
                           {"distance", ToArray(distance)},
                           {"spread", ToArray(spread)},
                           {"within", ToArray(within)},
                           {"sessions", sessions},
                           {"rows", rows}};
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
  found.within = Eigen::VectorXd::Zero(size);
  if (json.contains("within")) {  // written since 0.1.0
    found.within = ToVector(json["within"], size);
    FromJson(json.value("rows", RecordJson()), &found.rows);
  }
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
  std::ranges::nth_element(sizes, sizes.begin() + used / 2);
  found.rows = sizes[static_cast<std::size_t>(used / 2)];
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
