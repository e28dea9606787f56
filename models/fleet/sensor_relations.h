#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

namespace errmap::models {

/// How the sensors of a component go together: what the others tell of each, by
/// linear regression on them.
struct SensorRelations {
  std::vector<data::ColumnInfo> columns;  // (s) of the data, as in training
  Eigen::VectorXd mean;                   // (s)
  /// (s x s) value less what the others tell = (values - mean)' * weights.
  Eigen::MatrixXd weights;
  Eigen::VectorXd variance;  // (s) of that, row by row
  /// (s) Mean over the sessions, each left out in turn, of how far the others
  /// were from their own mean (SensorShifts::distance).
  Eigen::VectorXd distance;
  /// (s) RMS of those sessions' shifts, each over sqrt(1 + its distance /
  /// `distance`): what is extrapolated far errs more.
  Eigen::VectorXd spread;
  /// (s) Variance of the shifts of rows about their session's, on average: what
  /// a part of a session may be off by more than a whole one.
  Eigen::VectorXd within;
  Eigen::Index sessions = 0;
  Eigen::Index rows = 0;  // of a session, the median; 0: not known

  /// (k x s) Of distances of the others (k x s) what widens the variance of a
  /// shift.
  Eigen::ArrayXXd Widening(const Eigen::MatrixXd& distances) const;

  std::string ToJsonText() const;
  /// Throws data::InputError where it is not what ToJsonText wrote.
  static SensorRelations FromJsonText(std::string_view text);
};

/// Of the inputs that are no positions; nothing for fewer than two of them or
/// than three sessions.
std::optional<SensorRelations> LearnRelations(const data::Dataset& training);

/// The sensors of a session, by the mean of its rows.
struct SensorShifts {
  Eigen::VectorXd shift;     // (s) value less what the others tell, its unit
  Eigen::VectorXd distance;  // (s) of the others, squared, after Mahalanobis
};

/// Over `values` (m x s).
SensorShifts ShiftsOf(const SensorRelations& relations,
                      const Eigen::MatrixXd& values);

}  // namespace errmap::models
