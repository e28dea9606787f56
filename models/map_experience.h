#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/measurements/dataset.h"
#include "stats/eigen.h"

// Plain data that model files hold besides the map itself. models/uncertainty/
// documents how it is made and used.

namespace errmap::models {

/// Limits that distinguish a stuck or jumping sensor from a healthy one, per
/// column (s); empty if unknown. sensors/standing_still.h describes how they
/// are learnt.
struct StandingStill {
  /// Allowed mean movement of the other columns (in shares of their ranges)
  /// while a column holds its value. 0: the column is not checked.
  VectorXd others_move = {};
  VectorXd resolution = {};  // in shares of its range
  /// Longest time without noise (s); 0: the column shows no noise.
  VectorXd quiet = {};
  /// Largest sudden change (in shares of the column's range; 0: unknown), and
  /// the further change allowed per second.
  VectorXd jump = {};
  VectorXd pace = {};
  /// Longest time (s) that all columns may hold their values at once; 0:
  /// unknown.
  double silence = 0.0;
};

/// First readings of the training sessions, as x': means of their first 20 s,
/// which have less noise than one row.
struct SessionStarts {
  VectorXd mean;        // (s)
  MatrixXd covariance;  // (s x s)
  MatrixXd changes;     // (s x s) mean product of the changes since then
  Index sessions = 0;
};

/// Reference for the readings of a whole session. Missing in older files, and
/// for more than a hundred columns.
struct SessionReadings {
  /// (s x s) Inverse covariance of x', without a factor model. It is scaled so
  /// that, on average over columns, residuals of a column given the others have
  /// this variance in held-out sessions.
  MatrixXd precision;
  /// (s) A column's residual variance over the mean of all, at least 1. It is
  /// large for a sensor that depends little on the others, such as in a tank.
  VectorXd scatter;
  Index units = 0;  // sessions, or the other units held out
  /// Missing in older files, and for fewer than four sessions.
  std::optional<SessionStarts> starts = {};
};

/// What a map knows of its training data besides the range of each column: the
/// ranges of derived inputs, and the joint distribution of thermal states. A
/// thermal state is all inputs that are not positions.
///
/// A factor model describes the states (Tipping & Bishop 1999, but with one
/// variance for each column). x' = (x - mean) / scale has covariance W W' +
/// diag(rest), with W the leading principal directions. Scores z = (W'W)^-1 W'
/// x' have unit variance; distances are taken in this whitened space.
struct Applicability {
  struct Derived {
    data::ColumnInfo column;
    double min = 0.0;
    double max = 0.0;
  };
  /// The form's derived inputs, in its order.
  std::vector<Derived> derived;

  std::vector<Index> columns;  // (s) index into the map's inputs
  Index rows = 0;              // of training
  VectorXd mean;               // (s) input's unit
  VectorXd scale;              // (s) input's unit, above 0; one per unit
  MatrixXd directions;         // (s x q) W
  VectorXd rest;               // (s) variances of x', above 0
  MatrixXd states;             // (k x q) trained states, spread evenly

  // Limits: 1.5 times the largest values in rows of held-out units.
  double distance_limit = 0.0;  // to the nearest of `states`
  double leverage_limit = 0.0;  // 1 / rows + |z|^2 / (rows - 1)
  VectorXd relation_limit;      // (s) StateMeasures::relation

  /// (s) Chance that a reading within a session repeats the previous one to the
  /// last digit, by their share or the longest run; (0): unknown.
  VectorXd repeats = {};

  StandingStill standing = {};  // empty in older files

  std::optional<SessionReadings> sessions = {};
};

/// An input may leave its trained range by this share of the range, so that
/// noise flags no row.
inline constexpr double kRangeTolerance = 0.02;

/// Errors of a map on held-out units, with the time and place of each. Probes
/// of a new unit are compared with them. Long units, and many units, are
/// thinned evenly; `rmse` and the units' own RMSE use all rows.
struct HeldOutErrors {
  struct Unit {
    std::string label;
    double rmse = 0.0;          // target's unit
    VectorXd elapsed;           // (n) since the session's start, in time_unit
    VectorXd position;          // (n) of the first position input, or (0)
    VectorXd residuals;         // (n) target minus prediction, target's unit
    VectorXd temperature = {};  // (n) of that input, or (0)
    VectorXd predicted = {};    // (n) target's unit, or (0)
  };
  /// "s", "rows", or "" if times are unknown (then elapsed is 0).
  std::string time_unit;
  std::string position;  // column; "" if there is none
  /// Column whose changes explain most of the errors' changes; "" if none.
  std::string temperature = {};
  double rmse = 0.0;  // over all units: the predicted error
  std::vector<Unit> units;

  /// Returns the longest time since a session's start.
  double longest() const {
    double most = 0.0;
    for (const Unit& unit : units) {
      most = std::max(most, unit.elapsed.maxCoeff());
    }
    return most;
  }
  /// Returns the lowest and the highest position; needs a position.
  std::pair<double, double> travel() const {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Unit& unit : units) {
      low = std::min(low, unit.position.minCoeff());
      high = std::max(high, unit.position.maxCoeff());
    }
    return {low, high};
  }
};

/// The training rows, to recognise them without the training file. They are
/// stored as Bloom filters (1970) of 16 bits per row, which recognise one
/// unknown row in 2000 by mistake (models/uncertainty/learnt_rows.h).
struct LearntRows {
  struct Filter {
    double alike = 0.0;  // share of rows also found in another session
    std::string bits;    // four in each hexadecimal digit
  };
  Index every = 1;                 // one row in `every` is kept, by its hash
  std::optional<Filter> measured;  // readings with their error
  std::optional<Filter> readings;  // readings alone, also those of one sensor
};

}  // namespace errmap::models
