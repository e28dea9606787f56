#pragma once

#include <Eigen/Core>

#include "models/error_model.h"
#include "models/map_experience.h"

namespace errmap::models {

/// How likely the first readings of a session are. Near rest, sensors differ
/// little and always in the same way, so they tell more there than later.
///
/// There are two hypotheses: a start like those of training or, if a log begins
/// later or a day begins otherwise, any row of training. Under each the scaled
/// readings x' (Applicability) have a Student t distribution with as many
/// degrees of freedom as sessions. Columns of one unit share a variance, since
/// halls differ.
class FirstReadings {
 public:
  /// `fitted` has applicability->sessions->starts.
  explicit FirstReadings(const FittedModel& fitted);

  /// Returns by how much a column exceeds its prediction from the others at a
  /// start, in its own unit. `readings` (s) are in theirs.
  double Shift(const Eigen::VectorXd& readings, Eigen::Index column) const;

  /// Returns the log of the density, up to a constant. The column `shifted`, if
  /// any, may have any value.
  double LogDensity(const Eigen::VectorXd& readings,
                    Eigen::Index shifted = -1) const;

 private:
  struct StudentT {
    StudentT(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance);
    double LogDensity(const Eigen::VectorXd& scaled,
                      Eigen::Index shifted,
                      double freedom) const;

    Eigen::VectorXd mean;
    Eigen::MatrixXd precision;
    double log_determinant = 0.0;  // of the covariance
  };

  FirstReadings(const Applicability& trained,
                const Eigen::MatrixXd& any_row,
                const Eigen::MatrixXd& shared);
  Eigen::VectorXd Scaled(const Eigen::VectorXd& readings) const;

  const Applicability& trained_;
  StudentT at_start_;
  StudentT any_row_;
};

}  // namespace errmap::models
