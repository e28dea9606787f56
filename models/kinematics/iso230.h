#pragma once

#include <string>
#include <vector>

#include "stats/eigen.h"

namespace errmap::models {

// Figures of ISO 230, in the unit of the deviations. A deviation is actual -
// nominal.

/// Deviations of one axis along itself, one per approach to a target position.
struct PositioningTest {
  VectorXd positions;         // (n) target positions
  VectorXd deviations;        // (n)
  std::vector<bool> upwards;  // (n) approached in the positive direction
};

/// Deviations of the approaches to one position in one direction.
struct Approaches {
  Index runs = 0;
  double mean = 0.0;
  double sd = 0.0;  // divisor n - 1; NaN for fewer than two runs
};

/// A target position.
struct PositioningPoint {
  double position = 0.0;
  Approaches up;
  Approaches down;

  double reversal() const { return up.mean - down.mean; }
};

/// Returns the points in ascending order. Throws std::invalid_argument if the
/// sizes do not agree or there is no deviation.
std::vector<PositioningPoint> PositioningPointsOf(const PositioningTest& test);

/// ISO 230-2:2014, clause 3, with the means and standard deviations (n - 1) of
/// the runs at each target position and direction. A figure is NaN if it needs
/// runs in both directions, or two in one direction, and the data lack them.
struct PositioningFigures {
  /// Bidirectional systematic positioning error E: range of all means.
  double systematic = 0.0;
  /// Mean bidirectional positioning error M: range of the means of both.
  double mean_bidirectional = 0.0;
  /// Reversal error B: largest |mean upwards - mean downwards|.
  double reversal = 0.0;
  /// Bidirectional repeatability R: largest of 2 s up + 2 s down + |B_i|, 4 s
  /// up and 4 s down.
  double repeatability = 0.0;
  /// Bidirectional accuracy A: range of the means +- 2 s.
  double accuracy = 0.0;
  double mean_reversal = 0.0;  // mean of up minus down

  /// The same for the runs in one direction, with R = largest 4 s.
  struct OneWay {
    double systematic = 0.0;
    double repeatability = 0.0;
    double accuracy = 0.0;
  };
  OneWay up;
  OneWay down;
};

/// Throws as PositioningPointsOf does.
PositioningFigures PositioningFiguresOf(const PositioningTest& test);
PositioningFigures PositioningFiguresOf(
    const std::vector<PositioningPoint>& points);

/// Returns, for each row, true if it approached its position upwards, from the
/// order of `positions` (n). The step before the row decides. If that is 0 or
/// more than half the travel, the row begins a sweep, and the step after it
/// decides.
std::vector<bool> ApproachedUpwards(const VectorXd& positions);

/// The test of positions along a diagonal, from runs in both directions. The
/// name has the signs of X, Y and Z along it: "ppp", or "p0n" if Y does not
/// move. `points` (n x 3) are nominal, `errors` (n x 3) were measured there,
/// and `upwards` is true for rows that ran in the direction of the signs. The
/// figures are those of ISO 230-6:2002, clause 5. Throws std::invalid_argument
/// if the name is not a diagonal, the sizes do not agree or the points have no
/// length along it.
PositioningTest AlongDiagonal(const std::string& name,
                              const Eigen::MatrixX3d& points,
                              const Eigen::MatrixX3d& errors,
                              std::vector<bool> upwards);

}  // namespace errmap::models
