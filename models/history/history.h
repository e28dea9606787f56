#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

namespace errmap::models {

/// What is made of an input within a session.
enum class Filter {
  kEma,   // a first-order lag, dy/dt = (x - y) / tau, begun in its steady
          // state y = x (models/history/lag.h)
  kZero,  // less its value where the session's zero is taken
  kSine,  // of an angle
  kCosine,
};

/// "ema", "zero", "sine", "cosine".
std::string_view ToString(Filter filter);
/// Whether it goes on in time, by a time constant.
bool RunsInTime(Filter filter);
/// Whether it remembers anything of its session.
bool Remembers(Filter filter);

/// How an input is taken to go from one reading to the next.
enum class Between {
  kLinear,  // straight: lags do not depend on how often readings are taken
  kHeld,    // at once to the later one, as in files that do not say it
};

/// "linear", "held".
std::string_view ToString(Between between);

/// An input that is computed from another: a causal function of input and time
/// within a session, the same whichever rows are held out.
struct DerivedInput {
  data::ColumnInfo column;  // ema(t12_degC,1800s), zeroed(t12_degC)
  std::string of;           // a column of the data, or an earlier derived input
  Filter filter = Filter::kEma;
  /// Of what runs in time; above 0, in the unit of time.
  double tau = 0.0;
  Between between = Between::kLinear;  // likewise
};

/// How a column that is filtered changed from row to row of training.
struct RowChange {
  std::string column;
  double largest = 0.0;  // its unit; above 0
  double mean = 0.0;     // likewise
};

/// How a column that the map remembers, less the mean of all those, stood in
/// the first rows of the sessions of training.
struct StartReading {
  std::string column;
  double mean = 0.0;    // its unit
  double sd = 0.0;      // likewise, over the sessions
  double weight = 0.0;  // per unit; models/history/session_start.h
};

/// The derived inputs of a map, and what its form reads.
struct History {
  std::string time_unit;  // "s" or "rows"
  std::string session;    // column; "" where sessions are cut by time
  std::string time = {};  // column; "" where time is rows, or not known
  double gap = 0.0;       // s: a longer pause parts sessions; 0: not known
  /// Time by which the sessions of training had begun, and kLateSteps median
  /// steps more, where all began within kLeapSteps of another; NaN where clocks
  /// tell nothing.
  double latest_start = std::numeric_limits<double>::quiet_NaN();
  /// How the sessions of training began (models/history/session_start.h): a
  /// first row whose weighted readings are above the limit is like none of
  /// theirs; NaN: too many of theirs are as any row.
  std::vector<StartReading> start_readings = {};
  double start_limit = std::numeric_limits<double>::quiet_NaN();
  /// Time of the day by which sessions begin: its mean (s) and by how much
  /// later one may still begin; NaN where it tells nothing.
  double start_clock = std::numeric_limits<double>::quiet_NaN();
  double start_clock_late = std::numeric_limits<double>::quiet_NaN();
  /// Where time is rows, which cannot tell that some are missing.
  std::vector<RowChange> row_changes = {};
  /// Longest step from reading to reading within the sessions of training; NaN
  /// where nothing is known.
  double longest_step = std::numeric_limits<double>::quiet_NaN();
  std::vector<DerivedInput> derived;
  std::vector<std::string> form_inputs;  // columns or derived inputs, in order

  /// Longest step from reading to reading over which the filters know enough:
  /// twice the longest of training, or three of the shortest time constant
  /// where that is more (models/history/README.md); infinity where nothing is
  /// known or nothing is filtered.
  double longest_bridged() const;
  /// Time after which filters that began inside a session, in the
  /// steady state of its readings there, have forgotten that: kSettledTaus of
  /// the longest time constant, those of filters of filters one after the
  /// other. Infinity where an input is zeroed, since the zero was taken
  /// elsewhere; 0 where nothing is remembered.
  double settles_after() const;
  /// Whether any filter runs in time.
  bool needs_time() const;
  /// Whether any derived input depends on where sessions begin.
  bool needs_sessions() const;
  /// Columns of the data that it reads, in order of their first use by
  /// `form_inputs`, then by `derived`.
  std::vector<std::string> columns() const;
  /// Which of columns() filters run through or are zeroed: a log of what was
  /// before needs no others.
  std::vector<Eigen::Index> remembered() const;
};
inline constexpr double kSettledTaus = 4.0;

/// Derived inputs with their names and units.
DerivedInput Ema(const data::ColumnInfo& of,
                 double tau,
                 const std::string& time_unit);
DerivedInput Zeroed(const data::ColumnInfo& of);
DerivedInput SineOf(const data::ColumnInfo& angle);
DerivedInput CosineOf(const data::ColumnInfo& angle);

/// Radians in one unit of an angle's column. Throws std::invalid_argument
/// where it is no angle in rad, mrad, urad, deg, arcmin or arcsec.
double RadiansPer(const data::ColumnInfo& angle);

/// latest_start of the sessions of these rows.
double LatestStart(const data::Dataset& training);

/// longest_step of the sessions of these rows.
double LongestStep(const data::Dataset& training);

/// row_changes of the columns of `history` in the sessions of these rows; none
/// where its time is not rows.
std::vector<RowChange> RowChanges(const data::Dataset& training,
                                  const History& history);

/// What is missing before a row, so that what a map remembers there is not what
/// it would in use.
enum class Missing {
  kNothing,
  kStart,     // the first rows of its session: it begins like none of
              // training (BeginsInside)
  kReadings,  // those of a step above longest_bridged, or where time is rows
              // of a leap above twice the largest of row_changes, which counts
              // as so many mean ones; until as much time has passed again
};

/// For each row of a log whose inputs are columns() of the history.
/// `from_rest`: its sessions are known to begin where it begins.
std::vector<Missing> FindMissing(const data::SessionLog& log,
                                 const History& history,
                                 bool from_rest = false);

/// What the form reads, per row of `dataset` (m x form_inputs). Filters run
/// through all rows of its log, so a selection of rows gets what all rows get.
/// Throws std::invalid_argument where a column is missing, the log that the
/// history needs is, or its time has another unit.
Eigen::MatrixXd DeriveInputs(const data::Dataset& dataset,
                             const History& history);

/// The rows of `dataset` with form_inputs for inputs, log included, so that any
/// recipe can fit them. Throws as DeriveInputs.
data::Dataset DeriveDataset(const data::Dataset& dataset,
                            const History& history);

}  // namespace errmap::models
