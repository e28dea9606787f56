#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

// What stands in model files beside the map itself, as plain data; how it is
// made and used is told in models/promise/.

namespace errmap::models {

/// What tells a sensor that hangs or jumps from a healthy one; of columns (s),
/// or empty where nothing is known. How it is learnt: promise/standing_still.h.
struct StandingStill {
  /// By how much of their ranges the others may move, on average, while a
  /// column stands still. 0: it is not watched.
  Eigen::VectorXd others_move = {};
  Eigen::VectorXd resolution = {};  // of its range
  /// How long its noise may leave it alone (s); 0: it has none to be seen.
  Eigen::VectorXd quiet = {};
  /// By how much of its range it may change at once, 0: not known, and by how
  /// much more in each second.
  Eigen::VectorXd jump = {};
  Eigen::VectorXd pace = {};
  /// How long all of them may hold their values together (s); 0: not known.
  double silence = 0.0;
};

/// Where a map was trained, besides the range of each of its columns: the
/// ranges of what it derives from them, and its thermal states (the inputs that
/// are no positions), taken together.
///
/// States are described by a factor model: of x' = (x - mean) / scale the
/// covariance is W W' + diag(rest), W the leading principal directions
/// (Tipping & Bishop 1999, with a variance of its own for each column). Scores
/// z = (W'W)^-1 W' x' have unit variance: the whitened space of distances.
struct Applicability {
  struct Derived {
    data::ColumnInfo column;
    double min = 0.0;
    double max = 0.0;
  };
  /// Inputs of the form that are derived, in its order.
  std::vector<Derived> derived;

  std::vector<Eigen::Index> columns;  // (s) index into the map's inputs
  Eigen::Index rows = 0;              // of training
  Eigen::VectorXd mean;               // (s) input's unit
  Eigen::VectorXd scale;              // (s) input's unit, above 0; one per unit
  Eigen::MatrixXd directions;         // (s x q) W
  Eigen::VectorXd rest;               // (s) variances of x', above 0
  Eigen::MatrixXd states;             // (k x q) trained ones, spread evenly

  // What rows held out with their whole unit reached, and half as much again.
  double distance_limit = 0.0;     // to the nearest of `states`
  double leverage_limit = 0.0;     // 1 / rows + |z|^2 / (rows - 1)
  Eigen::VectorXd relation_limit;  // (s) StateMeasures::relation

  /// (s) Of readings within sessions, those that repeat the one before to the
  /// last digit; (0): not known.
  Eigen::VectorXd repeats = {};

  StandingStill standing = {};  // of nothing in older files
};

/// Of its trained range an input may leave it by so much and is still inside:
/// the noise of a reading must not flag a row at the end of a range.
inline constexpr double kRangeTolerance = 0.02;

/// Errors of a map on units that had no part in it, with the time and place of
/// each: what probes of a further unit are judged and weighed by. Long units
/// and many of them are thinned evenly; `rmse` and the units' own are of all
/// rows.
struct HeldOutErrors {
  struct Unit {
    std::string label;
    double rmse = 0.0;          // target's unit
    Eigen::VectorXd elapsed;    // (n) since the session began, in time_unit
    Eigen::VectorXd position;   // (n) of the first position input, or (0)
    Eigen::VectorXd residuals;  // (n) target less prediction, target's unit
    Eigen::VectorXd temperature = {};  // (n) of that input, or (0)
    Eigen::VectorXd predicted = {};    // (n) target's unit, or (0)
  };
  /// "s", "rows", or "" where nothing is known of times: elapsed is then 0.
  std::string time_unit;
  std::string position;  // column; "" where there is none
  /// The input whose changes tell most of the errors': column; "" for none.
  std::string temperature = {};
  double rmse = 0.0;  // of all units together: the error promised
  std::vector<Unit> units;
};

/// The rows that a map learnt from, to know them again where its training file
/// is not at hand: Bloom filters (1970) of 16 bits a row, by which one other
/// row in 2000 seems known, too (models/promise/learnt_rows.h).
struct LearntRows {
  struct Filter {
    double alike = 0.0;  // share of rows that stand in another session, too
    std::string bits;    // four in each hexadecimal digit
  };
  Eigen::Index every = 1;          // one row of so many is kept, by its hash
  std::optional<Filter> measured;  // of readings with their error
  std::optional<Filter> readings;  // of readings alone, a sensor's among them
};

}  // namespace errmap::models
