#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "data/column_header.h"
#include "data/csv.h"
#include "data/measurements/column_faults.h"
#include "data/measurements/reading/reading.h"
#include "data/units.h"

namespace errmap::data {

/// The role of a column in a map, as decided by the Reading of its data.
enum class Role {
  kUnknown,
  kPosition,  // commanded: neither filtered nor zeroed
  kSensor,
  kSwitch,   // has two values
  kCounter,  // counts cycles, runs or the like
};
/// "", "position", "sensor", "switch", "counter".
std::string_view ToString(Role role);

/// Name, unit and role of a column.
struct ColumnInfo {
  std::string name;
  Unit unit;
  Role role = Role::kUnknown;

  bool operator==(const ColumnInfo& other) const {
    return name == other.name && unit == other.unit;
  }
};

/// True if a column holds commanded positions.
bool IsPosition(const ColumnInfo& column);

/// True if a column is a sensor's or a switch's.
bool IsReadBySensor(const ColumnInfo& column);

/// Returns the role that a column's name implies: for maps written before roles
/// were stored, and for data made in memory.
Role RoleByName(const ColumnInfo& column);

/// The group of each row (warm-up cycle, day, segment).
struct Grouping {
  std::string column;
  /// Distinct groups: sorted numerically if all are numbers, else in order of
  /// appearance.
  std::vector<std::string> labels = {};
  std::vector<Eigen::Index> codes = {};  // (rows) index into labels
};

/// Returns the word for one group: "day" if all labels are dates, "session" if
/// the column is "", "group" if its name has no plural, else its name.
std::string WordFor(const Grouping& grouping);

/// Every row of the table as read, in file order. It includes rows dropped or
/// held out, since filters run through all of them.
struct SessionLog {
  /// Sessions of all rows. A session is an uninterrupted run. The column is ""
  /// if time separates sessions, or if there is only one.
  Grouping sessions;
  std::vector<Eigen::Index> first_rows;  // (sessions) sessions.h: FirstRows
  Eigen::VectorXd time;          // (rows) finite, never decreases in a session
  std::string time_unit;         // "s", or "rows": the number of the row
  std::string time_column;       // "" where time is the number of the row
  bool dated = false;            // true: dates, in seconds since 1970
  bool ordered = true;           // false: rows are not in order of time
  double gap = 0.0;              // s: longer pauses part sessions; 0: a column
  Eigen::MatrixXd input_values;  // (rows x p) NaN: no number; (0 x 0): made
};

/// Value subtracted from the target: none, or that in the session's first row,
/// as in a shop that re-zeroes at the start.
enum class Alignment { kNone, kFirst };
/// "none", "first".
std::string_view ToString(Alignment align);

/// Measurements ready for a fit: m finite rows of p inputs, one target.
///
/// Immutable; made by MakeDataset, or from parts for data in memory.
class Dataset {
 public:
  struct Parts {
    std::string source;              // file or name, for messages
    std::vector<ColumnInfo> inputs;  // (p)
    /// (m x p); empty: the log's values are used, with all its rows.
    Eigen::MatrixXd input_values;
    ColumnInfo target;
    Eigen::VectorXd target_values;  // (m)
    Grouping groups;                // column "" if there are none
    Eigen::VectorXd weights = {};   // (m) positive, or (0): all equal
    std::vector<Eigen::Index> rows =
        {};  // (m) data row in the file; empty: 0..m-1
    /// Value subtracted from the target.
    Alignment align = Alignment::kNone;
    /// Null if sessions and times are unknown.
    std::shared_ptr<const SessionLog> log = {};
    std::vector<Eigen::Index> log_rows = {};  // (m) rows of the log
  };

  /// Throws std::invalid_argument on shapes that do not agree, values that are
  /// not finite, weights that are not positive, or codes out of range.
  explicit Dataset(Parts parts);

  const std::string& source() const { return parts_.source; }
  Eigen::Index num_rows() const { return parts_.target_values.size(); }
  Eigen::Index num_inputs() const {
    return static_cast<Eigen::Index>(parts_.inputs.size());
  }
  const std::vector<ColumnInfo>& inputs() const { return parts_.inputs; }
  std::vector<std::string> InputNames() const;
  const Eigen::MatrixXd& input_values() const {
    // NOLINTNEXTLINE(clang-analyzer-core.uninitialized.UndefReturn): has a log
    return reads_log() ? parts_.log->input_values : parts_.input_values;
  }
  const ColumnInfo& target() const { return parts_.target; }
  const Eigen::VectorXd& target_values() const { return parts_.target_values; }
  bool has_groups() const { return !parts_.groups.column.empty(); }
  const Grouping& groups() const { return parts_.groups; }
  const Eigen::VectorXd& weights() const { return parts_.weights; }
  const std::vector<Eigen::Index>& rows() const { return parts_.rows; }
  Alignment align() const { return parts_.align; }
  /// Shared with every selection of rows; may be null.
  const std::shared_ptr<const SessionLog>& log() const { return parts_.log; }
  const std::vector<Eigen::Index>& log_rows() const { return parts_.log_rows; }
  /// Session of each row (m), an index into log()->sessions.labels; empty
  /// without a log.
  std::vector<Eigen::Index> session_codes() const;
  /// Number of sessions among these rows; 0 without a log.
  Eigen::Index num_sessions() const;
  bool has_sessions() const { return num_sessions() >= 2; }

  /// Returns the index of the input of that name, or -1.
  Eigen::Index FindInput(std::string_view name) const;
  /// Input or target.
  const ColumnInfo& ColumnOf(const ColumnFault& fault) const {
    return fault.input < 0
               ? parts_.target
               : parts_.inputs[static_cast<std::size_t>(fault.input)];
  }

  /// Returns these rows, in this order; keeps group labels and log.
  Dataset SelectRows(const std::vector<Eigen::Index>& indices) const;

  /// Returns the same rows with another log.
  Dataset WithLog(std::shared_ptr<const SessionLog> log,
                  std::vector<Eigen::Index> log_rows) const;

  /// Returns the same rows with other inputs (m x p), without a log.
  Dataset WithInputs(std::vector<ColumnInfo> inputs,
                     Eigen::MatrixXd input_values) const;

 private:
  struct OfChecked {};  // parts of a data set need no second check
  Dataset(OfChecked, Parts parts) : parts_(std::move(parts)) {}

  bool reads_log() const {
    return parts_.log && parts_.input_values.cols() == 0 && num_inputs() > 0;
  }

  Parts parts_;
};

/// Returns the data set without these data rows of the file (ascending).
Dataset WithoutRows(const Dataset& dataset,
                    const std::vector<Eigen::Index>& rows);

enum class MissingPolicy { kError, kDropRows };
/// "error", "drop-rows".
std::string_view ToString(MissingPolicy policy);

/// What to do with rows that have faulty readings (RowsOfCellFaults).
enum class FaultPolicy { kKeep, kDropRows };
/// "keep", "drop-rows".
std::string_view ToString(FaultPolicy policy);

/// Selects rows whose cell in `column` is this number, or this text (a number's
/// text is its shortest form).
struct ColumnFilter {
  std::string column;
  std::variant<std::string, double> value;

  bool operator==(const ColumnFilter&) const = default;
};

/// The value as text: "down", "2".
std::string ValueText(const ColumnFilter& filter);

/// Selects the part of a table that becomes the data set; empty fields have the
/// command line's defaults. (With `= {}`, designated initialisers may leave
/// fields out.)
struct DatasetSelection {
  /// Default: the only column of errors, by its name (ErrorSign, in several
  /// languages) or its unit. Also derived: "-correction_um",
  /// "actual_mm-nominal_mm", "Error [um]" (reading/derived_columns.h).
  std::string target = {};
  std::vector<std::string> inputs = {};   // default: every other numeric column
  std::vector<std::string> exclude = {};  // never inputs
  std::string group = {};                 // default: "cycle" if there is one
  std::string time = {};       // default: by name and values; clock_columns.h
  std::string session = {};    // default: the first of kSessionColumns
  std::string weight = {};     // default: none
  std::string position = {};   // default: by values and name; reading/axis.h
  std::string direction = {};  // "up", "down": rows of one way; or a column
  std::string gap = {};        // "2h": longer pauses part sessions
  std::string time_unit = {};  // of a column of numbers; default: reading.h
  std::string with = {};       // a log of more columns, joined by time
  std::string clock_offset = {};  // how far that log's clock is ahead: "3s"
  Alignment align = Alignment::kNone;
  MissingPolicy missing = MissingPolicy::kError;
  FaultPolicy faults = FaultPolicy::kKeep;
  bool keep_dead = false;
  /// Only rows that pass all of these are used and checked.
  std::vector<ColumnFilter> where = {};
  /// True for rows that only test a fitted map: they have exactly the named
  /// inputs, if any, and their target may be constant.
  bool only_to_judge = false;
  /// False: the data set gets no log.
  bool with_log = true;
};

struct DroppedColumn {
  std::string column;
  std::string why;
};

/// A data set and the decisions made in building it.
struct PreparedDataset {
  Dataset dataset;
  std::vector<DroppedColumn> dropped;  // would-be inputs left out, and why
  std::vector<std::string> remarks;    // one line each, for people
  /// Remarks that every answer must show, as whole sentences.
  std::vector<std::string> doubts = {};
  std::string time_column = {};          // "": rows are counted
  std::vector<ColumnFilter> where = {};  // its rows meet these
  /// Faults found in the columns in use, including rows left out because of
  /// them.
  std::vector<ColumnFault> faults;
  Reading reading = {};
};

/// Picks target, inputs, group and weight from a table and checks the columns
/// in use. Other columns may hold anything.
///
/// Default inputs are the numeric columns other than target, group, weight,
/// time and session. Columns for record keeping (KeepsRecord), or with the name
/// of a machine or tool, are not inputs. Other measured errors are left out
/// with a remark unless named in `inputs`. These are columns of the target's
/// stem (StemOfColumn), columns of its unit whose name differs only in the
/// letter of an axis, and columns named as errors. So are columns in nm, um,
/// uin, arcsec or urad, except positions and axes of one letter. Dead inputs
/// are dropped with a remark unless `keep_dead`: one value in all rows, or an
/// unnamed thermometer stuck from a row on. So are inputs that together
/// determine the target (FindLeaks). An input that repeats another, or has one
/// value in nearly all rows, is kept with a remark. Columns of `where`, and
/// those without a name in the header, are not inputs either. The log holds the
/// rows that `where` selects. kFirst subtracts from the target the first value
/// kept of each session, with a remark. Faulty readings are returned in
/// `faults`.
///
/// Throws InputError naming file, row, column and remedy. Causes:
/// - an unknown column, or no or several candidates for the target
/// - a cell in use that is empty, NA, NaN, infinite or not a number; kDropRows
/// drops rows with empty, NA or NaN cells only
/// - an unknown unit, numbers kept as text, decimal commas and points mixed
/// - a constant target, a weight not above 0, unusable times (sessions.h)
/// - no rows, or no inputs left although the table has other numeric columns
PreparedDataset MakeDataset(const CsvTable& table,
                            const DatasetSelection& selection);

/// Groups the given data rows by a column of text or numbers. Throws InputError
/// for an empty cell.
Grouping GroupByColumn(const CsvTable& table,
                       const std::string& column,
                       const std::vector<Eigen::Index>& rows);

/// Returns the values of a numeric column for all rows, checked as in
/// MakeDataset. `rows` (may be null) receives the rows kept.
Eigen::VectorXd NumericColumn(const CsvTable& table,
                              const std::string& column,
                              MissingPolicy missing = MissingPolicy::kError,
                              std::vector<Eigen::Index>* rows = nullptr);

}  // namespace errmap::data
