#pragma once

#include <optional>

#include <Eigen/Core>

#include "models/error_model.h"
#include "models/map_experience.h"

namespace errmap::models {

/// How likely the readings of a session are, as they are and with a sensor off
/// or two swapped.
///
/// There are two hypotheses. The session began as those of training did: its
/// first readings are like theirs, where sensors differ little and always in
/// the same way, and so are its changes since then, which no offset reaches.
/// Or a log begins later, or a day begins otherwise: then its rows are like
/// any rows of training. First readings, changes and rows, all scaled
/// (Applicability), each have a Student t distribution with as many degrees of
/// freedom as sessions. Rows of a session are not independent: they count as
/// one draw, whose square is the mean of theirs. Columns of one unit share a
/// variance, since halls differ.
class SessionLikelihood {
 public:
  /// `fitted` has applicability->sessions. `states` (n x s) has at least one
  /// row, all finite.
  SessionLikelihood(const FittedModel& fitted, const Eigen::MatrixXd& states);

  /// Returns the log of the density, up to a constant.
  double LogDensity() const;
  /// Likewise, where this column may have any offset; of a column that
  /// scattered more than others, `scatter` times that proves as much.
  double LogDensityShifted(Eigen::Index column, double scatter = 1.0) const;
  /// Likewise, after two columns are exchanged.
  double LogDensitySwapped(Eigen::Index i, Eigen::Index j) const;

  /// Returns by how much a column is higher than the others tell, in its unit.
  double Shift(Eigen::Index column) const;

 private:
  /// Rows against one distribution.
  class Draw {
   public:
    Draw(const Eigen::MatrixXd& rows,
         const Eigen::VectorXd& mean,
         const Eigen::MatrixXd& covariance,
         Eigen::Index sessions);
    double LogDensity() const { return LogDensityOf(square_); }
    double LogDensityShifted(Eigen::Index column, double scatter) const;
    double LogDensitySwapped(Eigen::Index i, Eigen::Index j) const;
    /// That of rows whose square is what it is expected to be.
    double LogDensityExpected() const;
    double Shift(Eigen::Index column) const;

   private:
    double LogDensityOf(double square) const;

    Eigen::MatrixXd rows_;
    Eigen::MatrixXd precision_;
    Eigen::MatrixXd pulled_;  // rows less the mean, times the precision
    double square_ = 0.0;
    double log_determinant_ = 0.0;  // of the covariance
    double freedom_ = 1.0;
    double power_ = 1.0;  // of the density: degrees of freedom and columns
  };
  /// A session that began as those of training.
  struct Begun {
    Draw first;
    Draw changes;
  };

  SessionLikelihood(const Applicability& trained,
                    const Eigen::MatrixXd& scaled,
                    const Eigen::MatrixXd& any_row,
                    const Eigen::MatrixXd& shared);
  /// Of both hypotheses, by what each draw gives.
  template <typename OfReadings, typename OfChanges>
  double Together(const OfReadings& of_readings,
                  const OfChanges& of_changes) const;

  Eigen::VectorXd scale_;
  Draw any_rows_;
  std::optional<Begun> begun_;
};

}  // namespace errmap::models
