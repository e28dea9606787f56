#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/map_experience.h"
#include "stats/eigen.h"
#include "stats/not_a_number.h"

// Whether a map still does what it promised, and its sensors still go together
// as they did: statistics of sessions, each held against what the sessions that
// were held out when the map was made show of rows at such times and places,
// and tried on healthy simulated machines (tests/benchmarks/watch_study.cc).

namespace errmap::models {

/// How the sensors of a component go together: what the others tell of each, by
/// linear regression on them.
struct SensorRelations {
  std::vector<data::ColumnInfo> columns;  // (s) of the data, as in training
  VectorXd mean;                          // (s)
  /// (s x s) value less what the others tell = (values - mean)' * weights.
  MatrixXd weights;
  VectorXd variance;  // (s) of that, row by row
  /// (s) Mean over the sessions, each left out in turn, of how far the others
  /// were from their own mean (SensorShifts::distance).
  VectorXd distance;
  /// (s) RMS of those sessions' shifts, each over sqrt(1 + its distance /
  /// `distance`): what is extrapolated far errs more.
  VectorXd spread;
  /// (s) Variance of the shifts of rows about their session's, on average: what
  /// a part of a session may be off by more than a whole one.
  VectorXd within;
  Index sessions = 0;
  Index rows = 0;  // of a session, the median; 0: not known

  /// (k x s) Of distances of the others (k x s) what widens the variance of a
  /// shift.
  Eigen::ArrayXXd Widening(const MatrixXd& distances) const;

  std::string ToJsonText() const;
  /// Throws data::InputError where it is not what ToJsonText wrote.
  static SensorRelations FromJsonText(std::string_view text);
};

/// Of the inputs that are no positions; nothing for fewer than two of them or
/// than three sessions.
std::optional<SensorRelations> LearnRelations(const data::Dataset& training);

/// The sensors of a session, by the mean of its rows.
struct SensorShifts {
  VectorXd shift;     // (s) value less what the others tell, its unit
  VectorXd distance;  // (s) of the others, squared, after Mahalanobis
};

/// Over `values` (m x s).
SensorShifts ShiftsOf(const SensorRelations& relations, const MatrixXd& values);

/// What the held-out units show of rows at some times and places.
struct ExpectedErrors {
  double offset = stats::kNaN;      // RMS of the units' means, target's unit
  double square = stats::kNaN;      // mean of the units' mean squares
  double log_square = stats::kNaN;  // mean of their logarithms
  double log_spread = stats::kNaN;  // sd of these, shrunk to what is usual

  bool known() const { return log_square == log_square; }
};

/// Of the rows of each unit that are nearest to these: `elapsed` (m) since the
/// session began in errors.time_unit, or (0) where that is not known,
/// `position` (m) or (0). Nothing is known from units without errors, or of
/// fewer than kFewestSessions of them.
ExpectedErrors ExpectedOf(const HeldOutErrors& errors,
                          const VectorXd& elapsed,
                          const VectorXd& position);

/// By two days nobody knows how days differ.
inline constexpr Index kFewestSessions = 3;
/// Of fewer rows, or of less than half of the travel, errmap check tells
/// more: the mean of half a sweep is that of the map's own shape.
inline constexpr Index kFewestRows = 5;
/// Whether these rows (`position` (m), or (0) where there are none) are so few.
bool AreTooFew(const HeldOutErrors& errors,
               Index rows,
               const VectorXd& position);

/// A session as it was found: what is kept of it for later.
struct WatchedSession {
  std::string label = {};
  Index rows = 0;
  double offset = 0.0;       // mean of target less prediction, its unit
  double mean_square = 0.0;  // of the same
  /// Of so many rows at these times; not known where they are too few, or the
  /// map was not judged on whole sessions.
  ExpectedErrors expected = {};
  bool too_few = false;
  bool begins_inside = false;  // its first rows are missing to the map's memory
  double outside_share = 0.0;  // of the rows, unlike the trained states
  /// The sensor that goes with the others least, its shift (its unit) and p,
  /// corrected for their number; NaN where nothing is known of sensors.
  std::string sensor = {};
  double sensor_shift = 0.0;
  double p_sensor = 1.0;
};

/// Fills in the sensor of a session of so many rows: t statistics with the
/// spread of the sessions, shrunk to their common one, wider the farther its
/// state is from those trained on, and the fewer the rows.
void JudgeSensors(const SensorRelations& relations,
                  const SensorShifts& shifts,
                  WatchedSession* session);

/// A map's sessions against its promise.
struct MapJudgement {
  double p_offset = 1.0;  // t of the mean offset
  double p_rms = 1.0;     // t of the mean squares' logarithms
  double p = 1.0;         // of both, and of one and two sessions
  double found = 0.0;     // RMSE of the sessions behind p
  double offset = 0.0;    // mean error of the same
  /// What held-out sessions show of such rows, or the promise if that is more.
  double promised = 0.0;
};

/// Judges the newest of `sessions` (oldest first, at least one), and it and the
/// one before together. Nothing where nothing is expected of the newest.
std::optional<MapJudgement> JudgeSessions(
    const HeldOutErrors& held_out, const std::vector<WatchedSession>& sessions);

/// A map is worse, or a sensor changed, where p is below: of each component by
/// itself, whoever else is watched.
inline constexpr double kSurelyChanged = 0.0025;
/// What is found has to be above the promise by the difference that never
/// matters; and it, or what its offset adds to the promise, by this share.
inline constexpr double kLeastWorse = 0.2;
/// `indifference` in the unit of the judgement.
bool IsWorse(const MapJudgement& judgement, double indifference);
/// Of errors above the promise by as much one more session is to tell, where p
/// is below, or where they are three times the promise: few sessions do not
/// show how seldom that is.
inline constexpr double kDoubtful = 0.02;
bool IsDoubtful(const MapJudgement& judgement, double indifference);

/// A session of which a larger share is outside of the trained states is so.
inline constexpr double kMostlyOutside = 0.5;

enum class WatchStatus {
  kAsPromised,
  kWorse,
  kSensorChanged,  // its relation to the others
  kOutside,        // of the trained states: nothing is promised there
  kTooFewRows,
  kNotJudged,  // no sessions were held out, or there is no promise
  kDoubtful,   // one more session is to tell
};
/// "as promised", "worse", "sensor changed", "outside", "too few rows", "not
/// judged", "doubtful".
std::string_view ToString(WatchStatus status);
/// Its inverse; "not judged" of another text.
WatchStatus WatchStatusNamed(std::string_view name);

}  // namespace errmap::models
