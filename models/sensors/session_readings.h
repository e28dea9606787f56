#pragma once

#include <optional>

#include "models/error_model.h"
#include "models/map_experience.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Likelihood of a session's readings: as they are, with a sensor off, or with
/// two swapped.
///
/// There are two hypotheses. Either the session began like the training
/// sessions. Its first readings are then like theirs, where sensors differ
/// little and always in the same way. So are its changes since then, which no
/// offset affects. Or the log begins later, or the day begins unusually: then
/// its rows are like any training rows. First readings, changes and rows, all
/// scaled (Applicability), each have a Student t distribution with as many
/// degrees of freedom as sessions. Rows of a session are not independent: they
/// count as one draw, whose square is the mean of theirs. Columns of one unit
/// share a variance, since halls differ.
class SessionLikelihood {
 public:
  /// `fitted` has applicability->sessions. `states` (n x s) has at least one
  /// row, all finite.
  SessionLikelihood(const FittedModel& fitted, const MatrixXd& states);

  /// Returns the log of the density, up to a constant.
  double LogDensity() const;
  /// Returns the same if this column may have any offset. A column with larger
  /// scatter needs `scatter` times the offset for the same evidence.
  double LogDensityShifted(Index column, double scatter = 1.0) const;
  /// Returns the same after two columns are exchanged.
  double LogDensitySwapped(Index i, Index j) const;

  /// Returns by how much a column exceeds its estimate from the others, in its
  /// unit.
  double Shift(Index column) const;

 private:
  /// Likelihood of rows under one distribution.
  class Draw {
   public:
    Draw(const MatrixXd& rows,
         const VectorXd& mean,
         const MatrixXd& covariance,
         Index sessions);
    double LogDensity() const { return LogDensityOf(square_); }
    double LogDensityShifted(Index column, double scatter) const;
    double LogDensitySwapped(Index i, Index j) const;
    /// The likelihood of rows whose mean square equals its expectation.
    double LogDensityExpected() const;
    double Shift(Index column) const;

   private:
    double LogDensityOf(double square) const;

    MatrixXd rows_;
    MatrixXd precision_;
    MatrixXd pulled_;  // rows less the mean, times the precision
    double square_ = 0.0;
    double log_determinant_ = 0.0;  // of the covariance
    double freedom_ = 1.0;
    double power_ = 1.0;  // of the density: degrees of freedom and columns
  };
  /// A session that began like the training sessions.
  struct Begun {
    Draw first;
    Draw changes;
  };

  SessionLikelihood(const Applicability& trained,
                    const MatrixXd& scaled,
                    const MatrixXd& any_row,
                    const MatrixXd& shared);
  /// Combines both hypotheses from their densities.
  template <typename OfReadings, typename OfChanges>
  double Together(const OfReadings& of_readings,
                  const OfChanges& of_changes) const;

  VectorXd scale_;
  Draw any_rows_;
  std::optional<Begun> begun_;
};

}  // namespace errmap::models
