#pragma once

#include <array>
#include <string>
#include <vector>

#include "stats/eigen.h"
#include "stats/not_a_number.h"

namespace errmap::models {

/// The predicted error of a map for an unseen session, group or block: a given
/// share of its errors lies within a half-width. Made from rows held out with
/// their whole unit (uncertainty/unit_interval.h).
struct PredictionInterval {
  struct Level {
    double coverage = 0.0;  // 0.9, 0.95
    /// Target's unit; NaN if unknown.
    double half_width = stats::kNaN;
    /// Half-widths for rows inside the trained states, and for the others
    /// (sensors/applicability.h). Both equal half_width if held-out rows show
    /// no difference.
    double inside = stats::kNaN;
    double outside = stats::kNaN;
    /// True if there are fewer units than needed (9 for 0.9, 19 for 0.95) to
    /// guarantee this share without assumptions on how units differ.
    bool at_least = false;
  };
  static constexpr std::array<double, 2> kCoverages = {0.9, 0.95};

  std::string holdout;        // "sessions:5"
  std::string unit;           // "day", "cycle", "block of rows"
  Index units = 0;            // at least 2
  std::vector<Level> levels;  // as kCoverages
  /// True if whole sessions were held out. Groups that divide the rows as
  /// sessions do count as sessions.
  bool of_sessions = false;
  /// Number of future sessions for which it holds if mean errors of
  /// neighbouring sessions are correlated; 0: any number. lag1 is their
  /// correlation (NaN if not computed).
  Index good_for = 0;
  double lag1 = stats::kNaN;
};

}  // namespace errmap::models
