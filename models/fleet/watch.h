#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "models/map_experience.h"

// Whether a map still does what it promised, and its sensors still go together
// as they did: statistics of whole sessions, each held against the sessions
// that were held out when the map was made, and tried on healthy simulated
// machines (tests/benchmarks/fleet_watch.py).

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
  Eigen::Index sessions = 0;

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

/// A session as it was found: what is kept of it for later.
struct WatchedSession {
  std::string label = {};
  Eigen::Index rows = 0;
  double offset = 0.0;         // mean of target less prediction, its unit
  double mean_square = 0.0;    // of the same
  double outside_share = 0.0;  // of the rows, unlike the trained states
  /// The sensor that goes with the others least, its shift (its unit) and p,
  /// corrected for their number; NaN where nothing is known of sensors.
  std::string sensor = {};
  double sensor_shift = 0.0;
  double p_sensor = 1.0;
};

/// Fills in the sensor of a session: t statistics with the spread of the
/// sessions, shrunk to their common one, wider the farther its state is from
/// those trained on.
void JudgeSensors(const SensorRelations& relations,
                  const SensorShifts& shifts,
                  WatchedSession* session);

/// A map's sessions against its promise.
struct MapJudgement {
  double p_offset = 1.0;  // t of the mean offset
  double p_rms = 1.0;     // t of the mean squares' logarithms
  double p = 1.0;         // of both, and of one and two sessions
  double found = 0.0;     // RMSE of the sessions behind p
  double promised = 0.0;
};

/// Judges the newest of `sessions` (oldest first, at least one) and the newest
/// two together. Nothing where the map has fewer than three sessions held out.
std::optional<MapJudgement> JudgeSessions(
    const HeldOutErrors& held_out, const std::vector<WatchedSession>& sessions);

/// Benjamini and Hochberg (1995): the smallest share of false discoveries at
/// which each would be one; as many as `p`.
std::vector<double> FalseDiscoveryRates(const std::vector<double>& p);

/// A discovery is one below this share of false ones among them.
inline constexpr double kFalseDiscoveries = 0.05;

/// A session of which a larger share is outside of the trained states is so.
inline constexpr double kMostlyOutside = 0.5;

enum class WatchStatus {
  kAsPromised,
  kWorse,
  kSensorChanged,  // its relation to the others
  kOutside,        // of the trained states: nothing is promised there
  kNotJudged,      // no sessions were held out, or there is no promise
};
/// "as promised", "worse", "sensor changed", "outside", "not judged".
std::string_view ToString(WatchStatus status);

}  // namespace errmap::models
