#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "models/history/history.h"
#include "models/map_experience.h"
#include "models/sensors/sensor_check.h"
#include "models/session/session_forecast.h"

namespace errmap::models {

/// Whether a map holds in a session, by a few measurements of it.
enum class SessionStatus {
  kHolds,
  kOff,
  kUnknown,
  kHoldsSoFar,  // up to the last probe; of the rest nothing is known yet
  kSensor,      // a sensor is at fault: its readings explain nothing
};
/// "holds", "off", "unknown", "holds so far", "sensor".
std::string_view ToString(SessionStatus status);

/// The remedy if it does not hold.
enum class Remedy {
  kNone,
  kRezero,   // an offset explains the error
  kRefit,    // the shape is wrong
  kUnknown,  // these probes cannot tell
  kGain,     // the errors are so many times those predicted
  kSign,     // they are those predicted, with the other sign
};
/// "none", "re-zero", "refit", "unknown", "gain", "sign".
std::string_view ToString(Remedy remedy);

/// A session is off if its RMSE is above this many times the promised one.
inline constexpr double kOffRatio = 1.5;

/// Whether an offset explains errors of this mean and RMS. It must be at least
/// three quarters of the excess of their mean square over the promised one.
/// Re-zeroing then halves the error, or leaves no more than was promised.
bool OffsetExplains(double mean, double rms, double promised);

/// The RMSE of a part of the session, as probes tell it.
struct RmseForecast {
  double low = 0.0;  // 80 % lie between; target's unit
  double high = 0.0;
  double off_probability = 0.0;  // that it is above kOffRatio times the promise
};

struct SessionCheck {
  /// What the map's memory lacks before a probe. The map then predicts
  /// otherwise than in use, so nothing is known.
  Missing missing = Missing::kNothing;
  std::optional<SensorFaultFound> sensor;
  SessionStatus status = SessionStatus::kUnknown;
  Remedy remedy = Remedy::kNone;
  Eigen::Index probes = 0;
  double promised = 0.0;       // RMSE on unseen units, target's unit
  double probe_rms = 0.0;      // likewise
  double probe_mean = 0.0;     // likewise
  double probe_scatter = 0.0;  // sd about their mean; NaN for one probe
  double gain = 1.0;           // errors over predictions, of kGain and kSign
  RmseForecast so_far;         // up to the last probe
  std::optional<RmseForecast> later;  // after it; empty where it ended
  RmseForecast session;
  /// Of the rest of the session, once the remedy was applied: its median RMSE.
  double left = 0.0;
  /// Time since the session began, s, after which it is not known whether the
  /// map holds. Empty without times.
  std::optional<double> next_probe;
};

/// Judges the probes of a session by the errors that they forecast
/// (ForecastSession). The limit is kOffRatio times the promise. The map holds
/// if the errors so far, and those of the rest, are surely enough within it. It
/// is off if those of the session surely enough are not. A remedy must surely
/// enough not add to the error. Re-zeroing, a gain or a sign must also bring
/// the session within the limit. A gain or a sign replaces kRefit if it alone
/// brings the probes within the limit. `missing`, `sensor`: see SessionCheck;
/// nothing else is judged then. Throws std::invalid_argument on no probes,
/// other sizes, or what is not finite.
SessionCheck CheckSession(const HeldOutErrors& errors,
                          const SessionProbes& probes,
                          Missing missing = Missing::kNothing,
                          std::optional<SensorFaultFound> sensor = {});

/// How well one probe at some time and place tells a unit's RMSE.
struct ProbeSite {
  double from = 0.0;  // elapsed, s; all of them without times in seconds
  double until = 0.0;
  double position_from = 0.0;  // NaN where no position is known
  double position_until = 0.0;
  /// In half of the cases the probe's size is within this factor of the unit's
  /// RMSE.
  double factor = 0.0;
};

/// Sites of held-out probes, the most telling first: quarters of the units'
/// length by thirds of the positions. Sites where half of the errors are 0 tell
/// nothing and are left out.
std::vector<ProbeSite> RankProbeSites(const HeldOutErrors& errors);

}  // namespace errmap::models
