#pragma once

#include <string>
#include <vector>

#include "models/map_experience.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Errors of a map within a session: an offset that wanders, and independent
/// noise. The autocovariance is variance * exp(-lag / memory), plus the noise
/// at lag 0.
struct OffsetModel {
  double variance = 0.0;  // of the offset, target's unit squared
  double memory = 0.0;    // in the errors' time unit; infinite: it never fades
  double noise = 0.0;     // variance of the rest, above 0
};

/// Fits the autocovariance of the held-out errors within their units by least
/// squares; each unit has the same weight. The memory is chosen among fractions
/// and multiples of the longest unit, the variance follows in closed form. The
/// offset variance is at least 1/(n + 1) of the mean square, since n units
/// cannot exclude an offset.
OffsetModel FitOffset(const HeldOutErrors& errors);

/// The offset of one session, estimated from the probes so far by a scalar
/// Kalman filter (Kalman 1960). Before any probe it is 0 with the model's
/// variance.
class OffsetFilter {
 public:
  explicit OffsetFilter(const OffsetModel& model);

  /// Moves on to `time`, which must not be before the last one. What the probes
  /// showed fades.
  void Advance(double time);
  /// Takes in the error (target less prediction) of a probe at that time. An
  /// error three standard deviations from the predicted one starts an offset of
  /// its size. That offset does not fade; only what wanders about it does.
  void Update(double residual);

  double offset() const { return offset_; }  // target's unit
  /// Variance of the offset; never below that of the mean of probes that
  /// scatter like these. The model's variances are scaled by the ratio of
  /// squared to predicted probe errors (West & Harrison 1997, section 4.5). The
  /// held-out sessions count as four probes in it. The probe that starts an
  /// offset counts as three standard deviations, since the machine moved.
  double variance() const;
  /// True if the probes differ from their predictions by more than 95 in 100
  /// sets of probes of an offset would. Then an offset does not explain them.
  /// The probe that starts an offset does not count.
  bool contradicted() const;
  /// The factor for an interval, with Student's t for so few probes. It is the
  /// standard deviation of an error less the offset, over that of the model's
  /// errors. At least 1 for a single probe, whose scatter is unknown. If the
  /// probes contradict the offset, at least their own scatter about it.
  double Widening() const;

 private:
  double Believed() const;      // probes behind Scale, as degrees of freedom
  double Scale() const;         // of today's variances, over the model's
  double MeanVariance() const;  // of the mean of the probes, by their scatter

  OffsetModel model_;
  bool started_ = false;
  bool moved_ = false;  // an offset of no held-out session's size
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

/// When something was measured: session and time within a file's own clock.
struct Moment {
  std::string session;
  double time = 0.0;
};

/// The offset at each of `moments` (m) and its variance, from the probes of the
/// same session up to then.
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
