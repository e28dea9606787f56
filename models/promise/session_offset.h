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
};

/// Fits the autocovariance of the held-out errors within their units, each
/// unit weighing alike, by least squares: memory among fractions and multiples
/// of the longest unit, the variance in closed form. So few units never show
/// that there is no offset: of n, at least 1/(n + 1) of the mean square is one.
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
  /// its size, which does not fade: only what wanders about it does.
  void Update(double residual);

  double offset() const { return offset_; }  // target's unit
  /// Of it; never below that of the mean of probes that scatter as these do.
  /// Variances are as many times those of the model as the probes missed what
  /// was foretold of them, where the held-out sessions count as four probes (a
  /// variance known up to a factor: West & Harrison 1997, section 4.5). What
  /// begins an offset counts as three standard deviations: it is the machine
  /// that moved.
  double variance() const;
  /// Whether the probes miss what the filter foretold of them by more than 95
  /// in 100 sets of probes of an offset would: it explains no such errors. The
  /// probe that begins an offset does not count.
  bool contradicted() const;
  /// Standard deviation of an error less the offset, over that of the model's
  /// errors, with Student's t for so few probes: what an interval is to be
  /// multiplied by. Not below 1 for one probe, whose scatter is not known;
  /// where probes contradict the offset not below their own scatter about it.
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
  // Squared misses, in foretold variances, but of the probe that begins an
  // offset.
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

/// The offset at each of `moments` (m) from the probes of the same session up
/// to then, and its variance.
struct OffsetTrack {
  Eigen::VectorXd offset;          // (m) target's unit
  Eigen::VectorXd variance;        // (m)
  Eigen::VectorXd widening;        // (m) OffsetFilter::Widening
  std::vector<bool> contradicted;  // (m)
  std::vector<Eigen::Index> used;  // (m) number of probes behind it
};
OffsetTrack TrackOffset(const OffsetModel& model,
                        const std::vector<Moment>& probe_moments,
                        const Eigen::VectorXd& probe_residuals,
                        const std::vector<Moment>& moments);

}  // namespace errmap::models
