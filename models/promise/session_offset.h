#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "models/map_experience.h"

namespace errmap::models {

/// Errors of a map within a session as an offset that wanders and a rest that
/// does not hang together: autocovariance variance * exp(-lag / memory), and
/// noise more at lag 0.
struct OffsetModel {
  double variance = 0.0;  // of the offset, target's unit squared
  double memory = 0.0;    // in the errors' time unit; infinite: it never fades
  double noise = 0.0;     // variance of the rest, above 0

  /// Of the standard deviation of an error, what is left where the offset is
  /// known up to `offset_variance`: what an interval narrows by.
  double Narrowing(double offset_variance) const;
};

/// Fits the autocovariance of the held-out errors within their units, each
/// unit weighing alike, by least squares: memory among fractions and multiples
/// of the longest unit, the variance in closed form.
OffsetModel FitOffset(const HeldOutErrors& errors);

/// The offset of one session, as a scalar Kalman filter (Kalman 1960) knows it
/// from the probes so far. Before any probe it is 0 with the model's variance.
class OffsetFilter {
 public:
  explicit OffsetFilter(const OffsetModel& model);

  /// Goes on to `time`, not before the last one; what was known fades.
  void Advance(double time);
  /// Takes the error (target less prediction) of a probe in at that time. One
  /// that is three standard deviations from what was known begins an offset of
  /// its size, which does not fade.
  void Update(double residual);

  double offset() const { return offset_; }      // target's unit
  double variance() const { return variance_; }  // of it

 private:
  OffsetModel model_;
  bool started_ = false;
  double time_ = 0.0;
  double offset_ = 0.0;
  double variance_ = 0.0;
};

/// When something was measured: session and time within a file's own clock.
struct Moment {
  std::string session;
  double time = 0.0;
};

/// The offset at each of `moments` (m) from the probes of the same session up
/// to then, and its variance.
struct OffsetTrack {
  Eigen::VectorXd offset;          // (m) target's unit
  Eigen::VectorXd variance;        // (m)
  std::vector<Eigen::Index> used;  // (m) number of probes behind it
};
OffsetTrack TrackOffset(const OffsetModel& model,
                        const std::vector<Moment>& probe_moments,
                        const Eigen::VectorXd& probe_residuals,
                        const std::vector<Moment>& moments);

}  // namespace errmap::models
