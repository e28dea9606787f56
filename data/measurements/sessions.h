#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/clock/clock.h"
#include "data/measurements/column_faults.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/nights.h"
#include "data/measurements/reading/reading.h"

namespace errmap::data {

/// Default names of the column of sessions; the first one found is used.
inline constexpr auto kSessionColumns =
    std::to_array<const char*>({"session", "day", "run", "tag"});
inline constexpr const char* kSessionColumnsText = "session, day, run or tag";

/// Returns the row at which each session is zeroed: the first whose inputs (n x
/// p) are all numbers, measured or not, else its first row.
std::vector<Eigen::Index> FirstRows(const Grouping& sessions,
                                    const Eigen::MatrixXd& input_values);

/// The sessions and times of the requested rows (n).
struct FoundSessions {
  Grouping sessions;  // (n) column "" where cut by time, or one run
  Eigen::VectorXd time;
  std::string time_unit;            // "s" or "rows"
  std::ptrdiff_t time_column = -1;  // index into the table; -1: row numbers
  std::ptrdiff_t date_column = -1;  // of dates beside times of day
  bool dated = false;               // true: dates, in seconds since 1970
  std::vector<bool> known;          // (n) false: the time or session is missing
  bool ordered = true;              // false: rows are not in order of time
  std::string by = "one";           // Reading::Sessions
  std::string counter = {};         // column that restarts with each session
  double gap = 0.0;                 // s, of a night; 0: not looked for
  Evidence evidence = Evidence::kNone;
  std::string alternative = {};  // where temperatures alone tell; else ""
  /// Description of the sessions and times, one line each; empty for one run
  /// without times.
  std::vector<std::string> remarks;
};

/// Finds sessions, uninterrupted runs with rows in order of time, by the
/// columns `time`, `session` and the policy `missing` of the selection.
///
/// Time is the column named, else the first usable of ColumnsOfTime. It holds
/// numbers (s, ms, min, h by its unit), or what ParseDateTime reads. Without
/// one, rows are counted. Sessions are the column named, else each of several
/// files (kFileColumn), unless one clock continues through all. Otherwise they
/// are the first usable column with a name in kSessionColumns or another word
/// for sessions and runs. Without one, the only column of dates numbers them if
/// time has none. Without columns, a session ends where time goes back or at a
/// night (Nights). If that gives one session, they end where a count of cycles
/// restarts. Without times and such a count, a column of blocks or a fall of
/// temperatures (FindColdStarts) divides the rows. A word that recurs after
/// another ("day", "night", "day") begins a new session. A default column that
/// is unusable is skipped with a remark. "none" means no column, unless one has
/// that name. The target and the weight are never used.
///
/// Throws InputError, with row and remedy, if a named column is missing, is the
/// target or the weight, holds no times, or is not in order. Also if a cell is
/// missing (with kDropRows such rows count as unknown), or if time goes back
/// within a session named by a column.
FoundSessions FindSessions(const CsvTable& table,
                           const DatasetSelection& selection,
                           const std::vector<Eigen::Index>& rows);

/// Other ways to separate sessions than columns with such names.
struct SessionClues {
  Clock clock;
  Nights nights = {};
  std::vector<Eigen::Index> passes = {};    // (n) along the axis; may be empty
  std::vector<std::ptrdiff_t> cycles = {};  // columns that count them; -1: none
  std::ptrdiff_t cycles_in_sessions = -1;   // column that is not a session
  std::ptrdiff_t blocks = -1;  // column that counts blocks of several cycles
  bool ordered = true;
  bool rows_repeat = false;  // some rows occur twice
};
FoundSessions FindSessions(const CsvTable& table,
                           const DatasetSelection& selection,
                           const std::vector<Eigen::Index>& rows,
                           SessionClues clues);

/// Gives `parts` a log of `log_rows` (n, ascending rows of the table), which
/// include those of `parts`, with the sessions (n) `found`. If they are the
/// same rows, the input values of `parts` become those of the log. Otherwise
/// cells of `blanked` are NaN in the log.
void TakeLog(const CsvTable& table,
             const std::vector<Eigen::Index>& log_rows,
             std::span<const ColumnFault> blanked,
             FoundSessions found,
             Dataset::Parts* parts);

/// Subtracts from the target the first value kept of each session (kFirst);
/// `parts` has a log. Returns the remark on it.
std::string AlignTarget(Dataset::Parts* parts);

}  // namespace errmap::data
