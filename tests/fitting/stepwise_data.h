#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "tests/places.h"

namespace errmap::testing {

/// Simulated turning centre of tests/golden/README.md: 595 rows of position
/// and 40 thermocouples, of which the last four are dead, and the error.
struct TurningCentre {
  Eigen::MatrixXd inputs;  // (595 x 41)
  Eigen::VectorXd error;   // mm
};

inline TurningCentre ReadTurningCentre() {
  const std::string golden = tests::TestDir() + "/golden/";
  constexpr Eigen::Index kInputs = 41;
  TurningCentre data;
  Eigen::Index done = 0;
  for (const char* file : {"netcg/train.csv", "stepwise/held_out.csv"}) {
    const data::CsvTable table = data::ReadCsv(golden + file);
    const auto rows = static_cast<Eigen::Index>(table.num_rows);
    data.inputs.conservativeResize(done + rows, kInputs);
    data.error.conservativeResize(done + rows);
    data.inputs.bottomRows(rows).setZero();
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
      const std::vector<double> column = table.columns[j].values;
      const Eigen::Map<const Eigen::VectorXd> values(column.data(), rows);
      if (j + 1 == table.columns.size()) {
        data.error.tail(rows) = values;
      } else {
        data.inputs.col(static_cast<Eigen::Index>(j)).tail(rows) = values;
      }
    }
    done += rows;
  }
  return data;
}

/// Each column's range mapped to -1 .. 1, constants to 0.
inline Eigen::MatrixXd Centred(const Eigen::MatrixXd& inputs) {
  Eigen::MatrixXd scaled = inputs;
  for (Eigen::Index j = 0; j < inputs.cols(); ++j) {
    const double least = inputs.col(j).minCoeff();
    const double half = 0.5 * (inputs.col(j).maxCoeff() - least);
    scaled.col(j) =
        (inputs.col(j).array() - (least + half)) / (half > 0.0 ? half : 1.0);
  }
  return scaled;
}

/// All terms of degree 1 and 2: x1 .. xp, x1^2, x1 x2, .. xp^2.
inline Eigen::MatrixXd QuadraticTerms(const Eigen::MatrixXd& inputs) {
  const Eigen::Index p = inputs.cols();
  Eigen::MatrixXd terms(inputs.rows(), p + p * (p + 1) / 2);
  terms.leftCols(p) = inputs;
  Eigen::Index column = p;
  for (Eigen::Index i = 0; i < p; ++i) {
    for (Eigen::Index j = i; j < p; ++j) {
      terms.col(column++) = inputs.col(i).cwiseProduct(inputs.col(j));
    }
  }
  return terms;
}

}  // namespace errmap::testing
