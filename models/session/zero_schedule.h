#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "models/error_model.h"
#include "models/map_experience.h"
#include "stats/eigen.h"

namespace errmap::models {

/// A probe is due, and resets a map's offset, if age / time + |change| /
/// temperature reaches 1. `age` is the time since the last probe, `change` that
/// of a temperature since then.
struct ZeroTrigger {
  double time = std::numeric_limits<double>::infinity();         // s
  double temperature = std::numeric_limits<double>::infinity();  // its unit

  bool is_clock() const;
  double Spent(double age, double change) const;
};

/// Errors in held-out sessions with a given trigger. A row at which a probe is
/// due is scored with the old offset, then gives the new one. A session's first
/// row is a probe. Unlike `compare --rezero`, it also scores rows after a gap
/// longer than the interval, since in use they come before a probe.
struct ZeroedErrors {
  ZeroTrigger trigger;
  double probes = 0.0;     // a session
  double rmse = 0.0;       // target's unit
  double within_90 = 0.0;  // 90 % of the errors are at most that
};

/// When to probe again so that 90 % of a map's errors stay within a goal.
struct ZeroSchedule {
  std::size_t sessions = 0;
  ZeroedErrors none;                 // the map as it is, no probe taken
  std::vector<ZeroedErrors> clocks;  // by rising interval, the last infinite
  /// The longest interval that meets the goal; empty if no probe is needed.
  std::optional<ZeroedErrors> clock;
  bool no_probe_serves = false;  // 90 % of the errors are within the goal as is

  /// A trigger by time and temperature, compared with that clock. Each session
  /// is scored with the trigger that the others chose, which takes no more
  /// probes on them than the clock.
  struct Rule {
    ZeroTrigger trigger;      // by all sessions
    double rmse = 0.0;        // of sessions that had no part in it
    double clock_rmse = 0.0;  // the best clock with no more probes than it took
    std::size_t better = 0;   // sessions where it errs less than the clock
    bool established = false;  // by enough of them, and by enough
  };
  std::optional<Rule> rule;  // nothing without a temperature or a clock

  /// True if some schedule keeps 90 % of the errors within the goal.
  bool serves() const { return no_probe_serves || clock.has_value(); }
  /// Returns the trigger to use: the rule if it is established, else the clock.
  /// Never due if no probe is needed.
  ZeroTrigger advised() const;
};

/// True if the map's held-out errors come from whole sessions with times in s.
bool KnowsAges(const FittedModel& fitted);

/// Makes the schedule from such errors. `goal`: target's unit, above 0; NaN:
/// the clocks alone. Throws std::invalid_argument if fewer than two sessions
/// have two rows.
ZeroSchedule ScheduleZeros(const HeldOutErrors& errors, double goal);

/// Returns the temperature (n x columns) whose changes correlate best with
/// those of the residuals (n) of the same session; -1: none. `sessions`: the
/// rows of each in order of time.
Index TellingTemperature(const MatrixXd& temperatures,
                         const VectorXd& residuals,
                         const std::vector<std::vector<Index>>& sessions);

}  // namespace errmap::models
