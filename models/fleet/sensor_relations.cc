#include <algorithm>

#include "data/input_error.h"
#include "fitting/least_squares/decompositions.h"
#include "models/fleet/watch.h"
#include "models/record_json.h"
#include "stats/order_statistic.h"

namespace errmap::models {

struct RelationsRecord {
  std::string schema;
  Inline<SensorRelations> relations;
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

constexpr const char* kSchema = "errmap-relations-1";

void Require(bool fits) {
  if (!fits) {
    throw data::InputError("has lists of other lengths than its columns");
  }
}

}  // namespace

std::string SensorRelations::ToJsonText() const {
  return JsonText(RelationsRecord{kSchema, {*this}}, -1) + "\n";
}

SensorRelations SensorRelations::FromJsonText(std::string_view text) {
  auto [schema, inlined] = RecordFromText<RelationsRecord>(
      text, kSchema, "errmap compare and errmap deploy rewrite it");
  SensorRelations& found = inlined.value;
  const Index size = std::ssize(found.columns);
  // Files of before 0.1.0 have none.
  if (found.within.size() == 0) found.within = VectorXd::Zero(size);
  for (const VectorXd* list : {&found.mean,
                               &found.variance,
                               &found.distance,
                               &found.spread,
                               &found.within}) {
    Require(list->size() == size);
  }
  Require(found.weights.rows() == size && found.weights.cols() == size);
  return std::move(found);
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
    const data::ColumnInfo& column = training.inputs()[std::size_t(sensor)];
    found.columns.push_back({.name = column.name, .unit = column.unit});
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
