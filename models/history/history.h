#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "data/measurements/dataset.h"
#include "stats/eigen.h"
#include "stats/not_a_number.h"

namespace errmap::models {

/// Kind of a derived input.
enum class Filter {
  kEma,   // a first-order lag, dy/dt = (x - y) / tau, begun in its steady
          // state y = x (models/history/lag.h)
  kZero,  // minus its value at the session's zero
  kSine,  // sine of an angle
  kCosine,
};

/// "ema", "zero", "sine", "cosine".
std::string_view ToString(Filter filter);
/// Returns true if it runs in time, by a time constant.
bool RunsInTime(Filter filter);
/// Returns true if it depends on earlier rows of its session.
bool Remembers(Filter filter);

/// Assumed course of an input between two readings.
enum class Between {
  kLinear,  // straight: lags do not depend on the sampling rate
  kHeld,    // jumps to the later one; default of files without it
};

/// "linear", "held".
std::string_view ToString(Between between);

/// An input computed from another: a causal function of input and time within a
/// session, independent of which rows are held out.
struct DerivedInput {
  data::ColumnInfo column;  // ema(t12_degC,1800s), zeroed(t12_degC)
  std::string of;           // a column of the data, or an earlier derived input
  Filter filter = Filter::kEma;
  /// Time constant of a filter in time; above 0, in the unit of time.
  double tau = 0.0;
  Between between = Between::kLinear;  // likewise
};

/// Change of a filtered column from row to row in training.
struct RowChange {
  std::string column;
  double largest = 0.0;  // its unit; above 0
  double mean = 0.0;     // likewise
};

/// A remembered column minus the mean of all remembered ones, in the first rows
/// of the training sessions.
struct StartReading {
  std::string column;
  double mean = 0.0;    // its unit
  double sd = 0.0;      // likewise, over the sessions
  double weight = 0.0;  // per unit; models/history/session_start.h
};

/// The derived inputs of a map, and the inputs of its form.
struct History {
  std::string time_unit;  // "s" or "rows"
  std::string session;    // column; "" if sessions are cut by time
  std::string time = {};  // column; "" if time is rows, or unknown
  double gap = 0.0;       // s: a longer pause separates sessions; 0: unknown
  /// Latest start of the training sessions plus 5 median steps, if all began
  /// within kLeapSteps median steps of each other; else NaN.
  double latest_start = stats::kNaN;
  /// Start of the training sessions (models/history/session_start.h). If the
  /// weighted readings of a session's first row exceed the limit, the session
  /// began unlike all training sessions. NaN: first rows of training sessions
  /// resemble other rows too much.
  std::vector<StartReading> start_readings = {};
  double start_limit = stats::kNaN;
  /// Mean time of day at which sessions begin (s), and the allowed delay (s).
  /// NaN if it varies too much.
  double start_clock = stats::kNaN;
  double start_clock_late = stats::kNaN;
  /// Used if time is counted in rows, which cannot show gaps.
  std::vector<RowChange> row_changes = {};
  /// Longest step between readings within the training sessions; NaN if
  /// unknown.
  double longest_step = stats::kNaN;
  std::vector<DerivedInput> derived;
  std::vector<std::string> form_inputs;  // columns or derived inputs, in order

  /// Returns the column of that name, or the one from which `name` is derived.
  std::string RootOf(std::string name) const;
  /// Returns the longest step between readings that the filters can bridge
  /// (models/history/README.md). It is twice the longest step of training, or
  /// three times the shortest time constant if that is more. Infinity if
  /// unknown or nothing is filtered.
  double longest_bridged() const;
  /// Returns the time after which filters that started in mid-session have
  /// forgotten their assumed steady state. It is kSettledTaus times the longest
  /// time constant; those of filters of filters add up. Infinity if an input is
  /// zeroed, since the true zero is then unknown; 0 without filters.
  double settles_after() const;
  /// Returns the shortest pause that separates sessions, s.
  double night() const;
  /// Returns true if any filter runs in time.
  bool needs_time() const;
  /// Returns true if a derived input depends on where sessions begin.
  bool needs_sessions() const;
  /// Returns the columns of the data that it reads, in order of first use by
  /// `form_inputs`, then by `derived`.
  std::vector<std::string> columns() const;
  /// Returns the indices in columns() of those filtered or zeroed. A log of
  /// earlier rows needs only these.
  std::vector<Index> remembered() const;
};
inline constexpr double kSettledTaus = 4.0;

/// Return derived inputs with their names and units.
DerivedInput Ema(const data::ColumnInfo& of,
                 double tau,
                 const std::string& time_unit);
DerivedInput Zeroed(const data::ColumnInfo& of);
DerivedInput SineOf(const data::ColumnInfo& angle);
DerivedInput CosineOf(const data::ColumnInfo& angle);

/// Returns radians per unit of an angle's column. Throws std::invalid_argument
/// if its unit is not rad, mrad, urad, deg, arcmin or arcsec.
double RadiansPer(const data::ColumnInfo& angle);

/// Returns latest_start for the sessions of these rows.
double LatestStart(const data::Dataset& training);

/// Returns longest_step for the sessions of these rows.
double LongestStep(const data::Dataset& training);

/// Returns row_changes for the columns of `history` in the sessions of these
/// rows; none if its time does not count rows.
std::vector<RowChange> RowChanges(const data::Dataset& training,
                                  const History& history);

/// Reason why the filter state at a row may be wrong.
enum class Missing {
  kNothing,
  kStart,     // the session begins like none of training (BeginsInside), and
              // its filters have not settled yet
  kReadings,  // the row is after a step above longest_bridged, until as much
              // time has passed again; if time is rows, after a leap above
              // twice the largest of row_changes, for leap / mean rows
};

/// Returns that reason for each row of a log whose inputs are columns() of the
/// history. `from_rest`: sessions are known to begin with the log's first rows.
std::vector<Missing> FindMissing(const data::SessionLog& log,
                                 const History& history,
                                 bool from_rest = false);

/// Returns the inputs of the form per row of `dataset` (m x form_inputs).
/// Filters run through all rows of its log, so the values do not depend on the
/// selection of rows. Throws std::invalid_argument if a column or a log that
/// the history needs is missing, or if its time has another unit.
MatrixXd DeriveInputs(const data::Dataset& dataset, const History& history);

/// Returns the rows of `dataset` with form_inputs as inputs, log included, so
/// that any recipe can fit them. Throws like DeriveInputs.
data::Dataset DeriveDataset(const data::Dataset& dataset,
                            const History& history);

}  // namespace errmap::models
