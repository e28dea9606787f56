#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "models/history/history.h"
#include "models/map_experience.h"
#include "models/sensors/sensor_check.h"
#include "models/session/session_forecast.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Answer of a check with a few probes of a session.
enum class SessionStatus {
  kHolds,
  kOff,
  kUnknown,
  kHoldsSoFar,  // up to the last probe; the rest is unknown
  kSensor,      // a sensor is at fault: nothing else is judged
};
/// "holds", "off", "unknown", "holds so far", "sensor".
std::string_view ToString(SessionStatus status);

/// The remedy if the map does not hold.
enum class Remedy {
  kNone,
  kRezero,   // an offset explains the error
  kRefit,    // the shape is wrong
  kUnknown,  // these probes cannot tell
  kGain,     // errors are a multiple of those predicted
  kSign,     // errors have the opposite sign of those predicted
};
/// "none", "re-zero", "refit", "unknown", "gain", "sign".
std::string_view ToString(Remedy remedy);

/// A session is off if its RMSE exceeds the promised one by this factor.
inline constexpr double kOffRatio = 1.5;

/// True if an offset explains errors of this mean and RMS. The squared mean
/// must be at least three quarters of the excess of their mean square over the
/// promised one. Re-zeroing then halves the error, or reduces it to the
/// promised one.
bool OffsetExplains(double mean, double rms, double promised);

/// The RMSE of a part of the session, estimated from probes.
struct RmseForecast {
  double low = 0.0;  // bounds of the 80 % interval; target's unit
  double high = 0.0;
  double off_probability = 0.0;  // of an RMSE above the limit
};

struct SessionCheck {
  /// Set if earlier rows are missing at a probe. In use, the map would then
  /// predict something else, so nothing is judged.
  Missing missing = Missing::kNothing;
  std::optional<SensorFaultFound> sensor;
  SessionStatus status = SessionStatus::kUnknown;
  Remedy remedy = Remedy::kNone;
  Index probes = 0;
  double promised = 0.0;       // RMSE on unseen units, target's unit
  double probe_rms = 0.0;      // likewise
  double probe_mean = 0.0;     // likewise
  double probe_scatter = 0.0;  // sd about their mean; NaN for one probe
  double gain = 1.0;           // for kGain, kSign: errors over predictions
  RmseForecast so_far;         // up to the last probe
  std::optional<RmseForecast> later;  // after it; empty if it ended the session
  RmseForecast session;
  /// Median RMSE of the rest of the session after the remedy.
  double left = 0.0;
  /// Time of the next probe, in s since the session began, after which it is
  /// unknown whether the map holds. Empty without times.
  std::optional<double> next_probe;
};

/// Judges a session by the errors forecast from its probes (ForecastSession).
/// The limit is kOffRatio times the promise. The map holds if the errors so far
/// and later are within it with sufficient probability, and there are four
/// probes or more. It is off if the whole session's errors exceed it with that
/// probability. A remedy must be equally unlikely to increase the error.
/// Re-zeroing, a gain or a sign must also bring the session within the limit. A
/// gain or a sign replaces kRefit if it alone brings the probes within the
/// limit. If `missing` or `sensor` is set, nothing else is judged. Throws
/// std::invalid_argument if there are no probes, sizes differ or a value is not
/// finite.
SessionCheck CheckSession(const HeldOutErrors& errors,
                          const SessionProbes& probes,
                          Missing missing = Missing::kNothing,
                          std::optional<SensorFaultFound> sensor = {});

/// How well a single probe at a time and place shows the RMSE of a unit.
struct ProbeSite {
  double from = 0.0;  // elapsed, s; all times if unknown
  double until = 0.0;
  double position_from = 0.0;  // NaN if positions are unknown
  double position_until = 0.0;
  /// The absolute error of half of such probes is within this factor of their
  /// unit's RMSE.
  double factor = 0.0;
};

/// Returns sites of held-out probes, the most informative first: quarters of
/// the units' length times thirds of the positions. Sites where half of the
/// errors are 0 are left out.
std::vector<ProbeSite> RankProbeSites(const HeldOutErrors& errors);

}  // namespace errmap::models
