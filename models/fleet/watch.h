#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/map_experience.h"
#include "models/session/map_rows.h"
#include "stats/eigen.h"
#include "stats/not_a_number.h"

// Whether a map still does what it promised, and its sensors still go together
// as they did: statistics of sessions, each held against what the sessions that
// were held out when the map was made show of rows at such times and places,
// and tried on healthy simulated machines (tests/benchmarks/watch_study.cc).

namespace errmap::models {

/// Relations between the sensors of a component: each is predicted from the
/// others by linear regression.
struct SensorRelations {
  std::vector<data::ColumnInfo> columns;  // (s) of the data, as in training
  VectorXd mean;                          // (s)
  /// (s x s) value minus its prediction from the others = (values - mean)' *
  /// weights.
  MatrixXd weights;
  VectorXd variance;  // (s) of that, row by row
  /// (s) Mean distance of the others from their own mean
  /// (SensorShifts::distance), over the sessions, each left out in turn.
  VectorXd distance;
  /// (s) RMS of those sessions' shifts, each over sqrt(1 + its distance /
  /// `distance`), since extrapolation increases the error.
  VectorXd spread;
  /// (s) Average variance of the shifts of rows about that of their session.
  /// The shift of a part of a session has this variance in addition.
  VectorXd within;
  Index sessions = 0;
  Index rows = 0;  // of a session, the median; 0: not known

  /// (k x s) Factor by which distances of the others (k x s) increase the
  /// variance of a shift.
  Eigen::ArrayXXd Widening(const MatrixXd& distances) const;

  std::string ToJsonText() const;
  /// Throws data::InputError if the text is not what ToJsonText wrote.
  static SensorRelations FromJsonText(std::string_view text);
};

/// Learns the relations of the inputs that are not positions; returns nothing
/// for fewer than two of them or fewer than three sessions.
std::optional<SensorRelations> LearnRelations(const data::Dataset& training);

/// Shifts of the sensors in a session, by the mean of its rows.
struct SensorShifts {
  VectorXd shift;     // (s) value less what the others tell, its unit
  VectorXd distance;  // (s) of the others, squared, after Mahalanobis
};

/// Computes the shifts of `values` (m x s).
SensorShifts ShiftsOf(const SensorRelations& relations, const MatrixXd& values);

/// Errors of the held-out units in rows at given times and places.
struct ExpectedErrors {
  double offset = stats::kNaN;      // RMS of the units' means, target's unit
  double square = stats::kNaN;      // mean of the units' mean squares
  double log_square = stats::kNaN;  // mean of their logarithms
  double log_spread = stats::kNaN;  // sd of these, shrunk to what is usual

  bool known() const { return log_square == log_square; }
};

/// Uses the rows of each unit that are nearest to the given ones: `elapsed` (m)
/// since the session began, in errors.time_unit, or (0) if unknown; `position`
/// (m) or (0). The result is unknown if the units have no errors or are fewer
/// than kFewestSessions.
ExpectedErrors ExpectedOf(const HeldOutErrors& errors,
                          const VectorXd& elapsed,
                          const VectorXd& position);

/// Fewer days do not show how much days differ.
inline constexpr Index kFewestSessions = 3;
/// Fewer rows, or less than half of the travel, are left to errmap check: the
/// mean over half a sweep depends on the shape of the map.
inline constexpr Index kFewestRows = 5;
/// True if these rows (`position` (m), or (0) if there are none) are too few.
bool AreTooFew(const HeldOutErrors& errors,
               Index rows,
               const VectorXd& position);

/// Results of a session, kept for later checks.
struct WatchedSession {
  std::string label = {};
  Index rows = 0;
  double offset = 0.0;       // mean of target less prediction, its unit
  double mean_square = 0.0;  // of the same
  /// Expected errors for this number of rows at these times. Unknown if there
  /// are too few rows, or the map was not judged on whole sessions.
  ExpectedErrors expected = {};
  bool too_few = false;
  bool begins_inside = false;  // its first rows are missing to the map's memory
  double outside_share = 0.0;  // of the rows, unlike the trained states
  /// The sensor that agrees least with the others, its shift (its unit) and p,
  /// corrected for the number of sensors; NaN if nothing is known of sensors.
  std::string sensor = {};
  double sensor_shift = 0.0;
  double p_sensor = 1.0;
};

/// Fills in the most deviating sensor of a session with this many rows, by t
/// statistics. They use the spread of the sessions, shrunk to their common
/// spread. It is larger the further the state is from the trained ones, and the
/// fewer the rows.
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
  /// Expected error from similar rows of held-out sessions, or the promise if
  /// that is larger.
  double promised = 0.0;
};

/// Judges the newest of `sessions` (oldest first, at least one), alone and
/// together with the one before. Returns nothing if no error is expected for
/// the newest.
std::optional<MapJudgement> JudgeSessions(
    const HeldOutErrors& held_out, const std::vector<WatchedSession>& sessions);

/// A map is worse, or a sensor changed, if p is below this. It applies to each
/// component separately, however many are watched.
inline constexpr double kSurelyChanged = 0.0025;
/// To be worse, the error must exceed the promise by the difference that never
/// matters. The larger of the error and hypot(promise, offset of the error)
/// must also exceed the promise by this share.
inline constexpr double kLeastWorse = 0.2;
/// `indifference` in the unit of the judgement.
bool IsWorse(const MapJudgement& judgement, double indifference);
/// If p is below this and the error exceeds the promise as above, the map is
/// doubtful until one more session decides. It is also doubtful if the error is
/// twice the promise, since few sessions do not show how rare that is.
inline constexpr double kDoubtful = 0.02;
bool IsDoubtful(const MapJudgement& judgement, double indifference);

/// A session counts as outside the trained states if more than this share of
/// its rows is outside.
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
/// Returns the status of this name; "not judged" for any other text.
WatchStatus WatchStatusNamed(std::string_view name);

/// A session and the rows of the data set that belong to it, in their order.
struct MeasuredSession {
  WatchedSession session;
  std::vector<Index> rows;
};

/// Returns why new sessions cannot be compared with the map's promise; "" if
/// they can. That needs the map's errors in at least three held-out sessions.
std::string WhyNotWatched(const FittedModel& fitted);

/// Returns the map's results in each session of `rows`. `relations` (null:
/// unknown) describe the sensors; they are used if the table has all of them.
std::vector<MeasuredSession> MeasureSessions(const FittedModel& fitted,
                                             const MapRows& rows,
                                             const SensorRelations* relations);

}  // namespace errmap::models
