#pragma once

#include <string>
#include <vector>

#include "models/map_experience.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Errors of a map within a session: a drifting offset and independent noise.
/// The autocovariance is variance * exp(-lag / memory), plus the noise at lag
/// 0.
struct OffsetModel {
  double variance = 0.0;  // of the offset, target's unit squared
  double memory = 0.0;    // in the errors' time unit; infinite: no decay
  double noise = 0.0;     // variance of the rest, above 0
};

/// Fits the autocovariance of the held-out errors within their units by least
/// squares; each unit has the same weight. The memory is chosen among fractions
/// and multiples of the longest unit. The variance follows in closed form. The
/// offset variance is at least 1/(n + 1) of the mean square, since n units
/// cannot exclude an offset.
OffsetModel FitOffset(const HeldOutErrors& errors);

/// The offset of one session, estimated from the probes so far by a scalar
/// Kalman filter (Kalman 1960). Before any probe it is 0 with the model's
/// variance.
class OffsetFilter {
 public:
  explicit OffsetFilter(const OffsetModel& model);

  /// Advances to `time`, at or after the last one. The effect of earlier probes
  /// decays.
  void Advance(double time);
  /// Adds the error (target minus prediction) of a probe at that time. An error
  /// three standard deviations from the predicted one starts a lasting offset
  /// of its size. Only the drift about it decays.
  void Update(double residual);

  double offset() const { return offset_; }  // target's unit
  /// Variance of the offset, at least that of the mean of probes with this
  /// scatter. The model's variances are scaled by the ratio of squared to
  /// predicted probe errors (West & Harrison 1997, section 4.5). In this ratio
  /// the held-out sessions count as four probes. The error of a probe that
  /// starts a lasting offset counts as three standard deviations.
  double variance() const;
  /// True if no offset explains the probes: under an offset, at most 5 % of
  /// such sets would differ more from their predictions. Probes that start a
  /// lasting offset do not count.
  bool contradicted() const;
  /// The factor for an interval: the standard deviation of errors after the
  /// offset is removed, over that of the model's errors, with Student's t for
  /// few probes. At least 1 for a single probe, whose scatter is unknown. If
  /// the probes contradict the offset, the interval covers at least their own
  /// scatter.
  double Widening() const;

 private:
  double Believed() const;      // degrees of freedom of Scale
  double Scale() const;         // today's variances over the model's
  double MeanVariance() const;  // of the mean of the probes, by their scatter

  OffsetModel model_;
  bool started_ = false;
  bool moved_ = false;  // a lasting offset was started
  double time_ = 0.0;
  double offset_ = 0.0;
  double variance_ = 0.0;
  // Sum of squared misses over predicted variances, without the probe that
  // starts an offset.
  double misses_ = 0.0;
  int count_ = 0;  // of probes; their mean, and squares about it (Welford)
  double mean_ = 0.0;
  double squares_ = 0.0;
};

/// The time of a measurement: its session, and the time on its file's clock.
struct Moment {
  std::string session;
  double time = 0.0;
};

/// The offset at each of `moments` (m) and its variance, from earlier probes of
/// the same session.
struct OffsetTrack {
  VectorXd offset;                 // (m) target's unit
  VectorXd variance;               // (m)
  VectorXd widening;               // (m) OffsetFilter::Widening
  std::vector<bool> contradicted;  // (m)
  std::vector<Index> used;         // (m) number of probes behind it
};
OffsetTrack TrackOffset(const OffsetModel& model,
                        const std::vector<Moment>& probe_moments,
                        const VectorXd& probe_residuals,
                        const std::vector<Moment>& moments);

}  // namespace errmap::models
