#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "data/column_header.h"
#include "data/measurements/dataset.h"

namespace errmap::testing {

/// Rows of inputs, times and session codes, all of them kept; the target is
/// the number of the row.
inline data::Dataset WithLog(std::vector<data::ColumnInfo> inputs,
                             const Eigen::MatrixXd& values,
                             const Eigen::VectorXd& time,
                             const std::vector<Eigen::Index>& codes) {
  auto log = std::make_shared<data::SessionLog>();
  log->sessions.column = "day";
  log->sessions.codes = codes;
  for (std::size_t row = 0; row < codes.size(); ++row) {
    const auto session = static_cast<std::size_t>(codes[row]);
    if (session < log->first_rows.size()) continue;
    log->first_rows.push_back(static_cast<Eigen::Index>(row));
    log->sessions.labels.push_back(std::to_string(session + 1));
  }
  log->time = time;
  log->time_unit = "s";
  log->input_values = values;
  data::Dataset::Parts parts;
  parts.source = "memory";
  parts.inputs = std::move(inputs);
  parts.input_values = values;
  parts.target = {"error_um", data::UnitOfColumn("error_um")};
  parts.target_values = Eigen::VectorXd::LinSpaced(
      time.size(), 0.0, static_cast<double>(time.size() - 1));
  parts.log = std::move(log);
  for (Eigen::Index row = 0; row < time.size(); ++row) {
    parts.log_rows.push_back(row);
  }
  return data::Dataset(std::move(parts));
}

/// The same rows with other errors and weights; (0): all 1.
inline data::Dataset WithTargets(const data::Dataset& dataset,
                                 const Eigen::VectorXd& targets,
                                 const Eigen::VectorXd& weights = {}) {
  data::Dataset::Parts parts;
  parts.source = dataset.source();
  parts.inputs = dataset.inputs();
  parts.input_values = dataset.input_values();
  parts.target = dataset.target();
  parts.target_values = targets;
  parts.weights = weights;
  parts.log = dataset.log();
  parts.log_rows = dataset.log_rows();
  return data::Dataset(std::move(parts));
}

inline data::ColumnInfo ColumnNamed(const std::string& name) {
  return {name, data::UnitOfColumn(name)};
}

/// Three sessions of 40 rows at irregular times, two columns that wander.
inline data::Dataset WanderingDays() {
  constexpr Eigen::Index kRows = 40;
  constexpr Eigen::Index kDays = 3;
  Eigen::MatrixXd values(kRows * kDays, 2);
  Eigen::VectorXd time(kRows * kDays);
  std::vector<Eigen::Index> codes;
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    const double k = static_cast<double>(row);
    time[row] = 100.0 * k + 40.0 * std::sin(3.1 * k);
    values.row(row) << 20.0 + std::sin(0.21 * k) + 0.01 * k,
        23.0 + std::cos(0.13 * k);
    codes.push_back(row / kRows);
  }
  return WithLog(
      {ColumnNamed("t1_degC"), ColumnNamed("t2_degC")}, values, time, codes);
}

}  // namespace errmap::testing
