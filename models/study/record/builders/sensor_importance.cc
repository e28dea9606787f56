#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "fitting/least_squares/decompositions.h"
#include "models/history/history.h"
#include "models/scaling.h"
#include "models/study/fold_pool.h"
#include "models/study/judgement/recommendation.h"
#include "models/study/record/component_study.h"

namespace errmap::models {
namespace {

// Sensors whose readings correlate at least so are taken to be alike.
constexpr double kAlike = 0.9;

using data::Dataset;
std::vector<Index> ColumnsOf(const Dataset& dataset,
                             const std::vector<std::string>& names) {
  std::vector<Index> columns;
  for (const std::string& name : names) {
    columns.push_back(dataset.FindInput(name));
  }
  return columns;
}

// What some columns say of others, learnt from training rows.
class StandIn {
 public:
  explicit StandIn(const MatrixXd& training)  // (m x k)
      : scaling_(StandardScaling(training)) {
    const MatrixXd scaled = scaling_.Apply(training);
    gram_ = scaled.transpose() * scaled / static_cast<double>(scaled.rows());
  }

  // The values (n x k) with these columns made up from all others.
  MatrixXd MakeUp(const MatrixXd& values,
                  const std::vector<Index>& columns) const {
    // Readings are no better than that: a thirtieth of their scatter.
    constexpr double kRidge = 1e-3;
    std::vector<Index> others;
    for (Index i = 0; i < values.cols(); ++i) {
      if (std::ranges::find(columns, i) == columns.end()) others.push_back(i);
    }
    MatrixXd made = values;
    MatrixXd scaled = MatrixXd::Zero(values.rows(), std::ssize(columns));
    if (!others.empty()) {
      MatrixXd of_others = gram_(others, others);
      of_others.diagonal().array() += kRidge;
      const MatrixXd weights = of_others.ldlt().solve(gram_(others, columns));
      scaled = scaling_.Apply(values)(Eigen::all, others) * weights;
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Index column = columns[i];
      made.col(column) =
          scaled.col(static_cast<Index>(i)) / scaling_.scale[column];
      made.col(column).array() += scaling_.offset[column];
    }
    return made;
  }

 private:
  ColumnScaling scaling_;
  MatrixXd gram_;  // (k x k) of the scaled training rows
};

// Clusters of sensors any two of which are alike (complete linkage), those of
// two or more.
std::vector<std::vector<Index>> AlikeOf(const MatrixXd& readings) {
  const MatrixXd scaled = StandardScaling(readings).Apply(readings);
  const MatrixXd correlation =
      (scaled.transpose() * scaled).cwiseAbs() /
      static_cast<double>(std::max<Index>(1, scaled.rows() - 1));
  std::vector<std::vector<Index>> clusters;
  for (Index i = 0; i < readings.cols(); ++i) clusters.push_back({i});
  for (;;) {
    double most = kAlike;
    std::size_t into = 0;
    std::size_t from = 0;
    for (std::size_t a = 0; a < clusters.size(); ++a) {
      for (std::size_t b = a + 1; b < clusters.size(); ++b) {
        const double least = correlation(clusters[a], clusters[b]).minCoeff();
        if (least < most || (least == most && from > 0)) continue;
        most = least;
        into = a;
        from = b;
      }
    }
    if (from == 0) break;
    clusters[into].insert(
        clusters[into].end(), clusters[from].begin(), clusters[from].end());
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(from));
  }
  std::erase_if(clusters,
                [](const auto& cluster) { return cluster.size() < 2; });
  for (auto& cluster : clusters) std::ranges::sort(cluster);
  return clusters;
}

// What is left out in turn: each sensor, each cluster of similar ones, all.
std::vector<SensorImportance::Without> Plan(
    const Dataset& dataset, const std::vector<std::string>& sensors) {
  constexpr std::size_t kMostToCluster = 200;
  std::vector<SensorImportance::Without> plan;
  for (const std::string& sensor : sensors) plan.push_back({{sensor}, 0.0});
  if (sensors.size() < 2) return plan;
  if (sensors.size() <= kMostToCluster) {
    const MatrixXd readings =
        dataset.input_values()(Eigen::all, ColumnsOf(dataset, sensors));
    for (const std::vector<Index>& cluster : AlikeOf(readings)) {
      if (cluster.size() == sensors.size()) continue;  // all, below
      SensorImportance::Without& without = plan.emplace_back();
      for (const Index i : cluster) {
        without.sensors.push_back(sensors[static_cast<std::size_t>(i)]);
      }
    }
  }
  plan.push_back({sensors, 0.0});
  return plan;
}

// A fold's map and what its sensors are made up from.
class FoldJudge {
 public:
  FoldJudge(const FittedModel& map, const Dataset& training) : map_(map) {
    for (const TrainedInput& input : map.inputs) {
      names_.push_back(input.column.name);
    }
    if (names_.empty()) return;
    stand_in_.emplace(
        training.input_values()(Eigen::all, ColumnsOf(training, names_)));
  }

  // NaN where readings are too large for their squares.
  double Squares(const Dataset& test,
                 const std::vector<std::string>& without) const {
    std::vector<Index> away;  // among names_
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (std::ranges::find(without, names_[i]) != without.end()) {
        away.push_back(static_cast<Index>(i));
      }
    }
    const std::optional<Dataset> made =
        away.empty() ? std::nullopt : MadeUp(test, away);
    if (!away.empty() && !made) return std::numeric_limits<double>::quiet_NaN();
    const VectorXd predicted = map_.Predict(made ? *made : test);
    return (test.target_values() - predicted).squaredNorm();
  }

 private:
  std::optional<Dataset> MadeUp(const Dataset& test,
                                const std::vector<Index>& away) const {
    const std::vector<Index> columns = ColumnsOf(test, names_);
    const auto replace = [&](MatrixXd* values) {
      const MatrixXd made =
          stand_in_->MakeUp((*values)(Eigen::all, columns), away);
      for (const Index i : away) {
        values->col(columns[static_cast<std::size_t>(i)]) = made.col(i);
      }
    };
    MatrixXd values = test.input_values();
    replace(&values);
    if (!values.allFinite()) return std::nullopt;
    Dataset changed = test.WithInputs(test.inputs(), std::move(values));
    if (test.log() == nullptr) return changed;
    if (map_.history == nullptr) return changed;  // reads no log
    auto log = std::make_shared<data::SessionLog>(*test.log());
    if (log->input_values.size() > 0) replace(&log->input_values);
    return changed.WithLog(std::move(log), test.log_rows());
  }

  const FittedModel& map_;
  std::vector<std::string> names_;  // that the map reads
  std::optional<StandIn> stand_in_;
};

// Uses every n-th row, so that all the work takes some seconds.
std::size_t StepOfHoldout(const Holdout& holdout,
                          const FittedModel& fitted,
                          std::size_t drops) {
  constexpr double kMostWork = 1e9;  // multiplications
  constexpr double kPerExponential = 20.0;
  double rows = 0.0;
  for (const stats::Fold& fold : holdout.folds) {
    rows += static_cast<double>(fold.test.size());
  }
  const PredictionCost cost = CostOf(fitted.model->Describe());
  const double each =
      1.0 + static_cast<double>(cost.multiplications) +
      kPerExponential * static_cast<double>(cost.exponentials) +
      static_cast<double>(fitted.inputs.size() * fitted.inputs.size());
  const double work = rows * each * static_cast<double>(drops + 1);
  return static_cast<std::size_t>(std::max(1.0, std::ceil(work / kMostWork)));
}

// A memory runs through every row of the log, however few are judged.
bool IsTooLong(const Dataset& dataset,
               const Holdout& holdout,
               const FittedModel& fitted,
               std::size_t drops) {
  constexpr double kMostWork = 1e10;  // multiplications, some seconds
  if (fitted.history == nullptr || dataset.log() == nullptr) return false;
  const auto inputs = static_cast<double>(fitted.inputs.size());
  const double each =
      inputs * inputs + static_cast<double>(fitted.history->derived.size());
  return static_cast<double>(dataset.log()->time.size()) * each *
             static_cast<double>(drops * holdout.folds.size()) >
         kMostWork;
}

Dataset EverySo(const Dataset& rows, std::size_t step) {
  std::vector<Index> kept;
  for (Index i = 0; i < rows.num_rows(); i += static_cast<Index>(step)) {
    kept.push_back(i);
  }
  return rows.SelectRows(kept);
}

}  // namespace

std::optional<SensorImportance> ImportanceOfSensors(
    const Dataset& dataset,
    const Holdout& holdout,
    const HoldoutResult& result,
    const FittedModel& fitted,
    const std::atomic<bool>* stop) {
  const std::vector<std::string> sensors = SensorsOf(fitted);
  const bool has_maps =
      result.ok() && std::ranges::all_of(result.folds, [](const auto& fold) {
        return fold.map != nullptr;
      });
  if (sensors.empty() || !has_maps) return std::nullopt;
  std::vector<SensorImportance::Without> plan = Plan(dataset, sensors);
  if (IsTooLong(dataset, holdout, fitted, plan.size())) return std::nullopt;
  const std::size_t step = StepOfHoldout(holdout, fitted, plan.size());
  SensorImportance found;
  found.alike = kAlike;
  for (std::size_t f = 0; f < holdout.folds.size(); ++f) {
    const PreparedFold fold = PrepareFold(dataset, holdout, f);
    const FoldJudge judge(*result.folds[f].map, fold.training);
    const Dataset test = step > 1 ? EverySo(*fold.test, step) : *fold.test;
    found.rows += test.num_rows();
    found.rmse += judge.Squares(test, {});
    for (SensorImportance::Without& without : plan) {
      if (stop != nullptr && stop->load()) return std::nullopt;
      without.rmse += judge.Squares(test, without.sensors);
    }
  }
  const auto root = [&](double squares) {
    return std::sqrt(squares / static_cast<double>(found.rows));
  };
  found.rmse = root(found.rmse);
  for (SensorImportance::Without& without : plan) {
    without.rmse = root(without.rmse);
    // One that is not a number tells nothing.
    if (!std::isfinite(without.rmse)) return std::nullopt;
  }
  const auto several = plan.begin() + std::ssize(sensors);
  std::stable_sort(plan.begin(), several, [](const auto& a, const auto& b) {
    return a.rmse > b.rmse;
  });
  found.one_by_one.assign(plan.begin(), several);
  found.together.assign(several, plan.end());
  return found;
}

}  // namespace errmap::models
