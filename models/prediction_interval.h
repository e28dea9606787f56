#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace errmap::models {

/// What a map promises for a session, group or block that it never saw: a
/// share of its errors lies within a half-width of the predictions. From rows
/// held out with their whole unit (promise/unit_interval.h).
struct PredictionInterval {
  struct Level {
    double coverage = 0.0;  // 0.9, 0.95
    /// Target's unit; NaN where nothing is known.
    double half_width = std::numeric_limits<double>::quiet_NaN();
    /// The same of rows inside of what was trained, and of the others
    /// (promise/applicability.h): half_width where held-out rows tell no
    /// difference.
    double inside = std::numeric_limits<double>::quiet_NaN();
    double outside = std::numeric_limits<double>::quiet_NaN();
    /// Too few units (9 for 0.9, 19 for 0.95) to promise this share without
    /// assuming how units differ.
    bool at_least = false;
  };
  static constexpr std::array<double, 2> kCoverages = {0.9, 0.95};

  std::string holdout;        // "sessions:5"
  std::string unit;           // "day", "cycle", "block of rows"
  Eigen::Index units = 0;     // at least 2
  std::vector<Level> levels;  // as kCoverages
  /// Whether whole sessions were held out, by whatever name: groups that cut
  /// the rows as sessions do are sessions.
  bool of_sessions = false;
  /// Sessions to come for which it is good, where it is not excluded that the
  /// mean errors of neighbouring sessions go together (their correlation; NaN
  /// where it was not looked for); 0: it is.
  Eigen::Index good_for = 0;
  double lag1 = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace errmap::models
