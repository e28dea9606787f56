#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "models/history/history.h"
#include "models/map_experience.h"

namespace errmap::models {

/// Whether a map holds in a session, by a few measurements of it.
enum class SessionStatus { kHolds, kOff, kUnknown };
/// "holds", "off", "unknown".
std::string_view ToString(SessionStatus status);

/// What would help where it does not.
enum class Remedy {
  kNone,
  kRezero,   // an offset explains the error
  kRefit,    // the shape is wrong
  kUnknown,  // one probe cannot tell
};
/// "none", "re-zero", "refit", "unknown".
std::string_view ToString(Remedy remedy);

/// A session is off where its RMSE is above so many times the one promised.
inline constexpr double kOffRatio = 1.5;

/// Whether an offset explains errors of this mean and RMS: it is three quarters
/// or more of what their mean square has beyond the promised one. Re-zeroing
/// then halves the error, or leaves no more than was promised.
bool OffsetExplains(double mean, double rms, double promised);

struct SessionCheck {
  /// What the map's memory lacks before a probe: what it says here is not what
  /// it says in use, so nothing is known.
  Missing missing = Missing::kNothing;
  SessionStatus status = SessionStatus::kUnknown;
  Remedy remedy = Remedy::kNone;
  Eigen::Index probes = 0;
  double promised = 0.0;         // RMSE on unseen units, target's unit
  double probe_rms = 0.0;        // likewise
  double probe_mean = 0.0;       // likewise
  double probe_scatter = 0.0;    // sd about their mean; NaN for one probe
  double off_probability = 0.0;  // that the session is off
  /// RMS of probes at these times above which a session is off, and up to
  /// which it holds: target's unit.
  double off_above = 0.0;
  double holds_to = 0.0;
  double session_low = 0.0;  // 80 % of what the session's RMSE may be
  double session_high = 0.0;
  /// Further probes like these that would settle it; nothing where it is
  /// settled, or where no dozen of them would.
  std::optional<Eigen::Index> more_probes;
};

/// Judges `residuals` (n, target's unit) of probes taken `elapsed` (n, s) after
/// the session began; times do not count where errors.time_unit is another.
///
/// What n probes at these times tell is taken from the held-out units: as many
/// of each one's errors near those times, drawn again and again, give the
/// distribution of q = RMS of probes / RMSE of the unit. Each q then says what
/// the session's RMSE may be, RMS of the probes / q; the share of them above
/// kOffRatio * promised is the probability that it is off. `missing`: see
/// SessionCheck. Throws std::invalid_argument on no probes, other sizes, or
/// what is not finite.
SessionCheck CheckSession(const HeldOutErrors& errors,
                          const Eigen::VectorXd& elapsed,
                          const Eigen::VectorXd& residuals,
                          Missing missing = Missing::kNothing);

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
/// length by thirds of the positions.
std::vector<ProbeSite> RankProbeSites(const HeldOutErrors& errors);

}  // namespace errmap::models
