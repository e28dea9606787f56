#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

#include "data/argument_name.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/sessions.h"
#include "data/text.h"

namespace errmap::data {
namespace {

// Of all rows, those that were dropped too.
Eigen::MatrixXd LoggedInputs(const CsvTable& table,
                             const std::vector<Eigen::Index>& log_rows,
                             const Dataset::Parts& parts) {
  Eigen::MatrixXd values(static_cast<Eigen::Index>(log_rows.size()),
                         parts.input_values.cols());
  for (Eigen::Index i = 0; i < values.cols(); ++i) {
    const std::string& name = parts.inputs[i].name;
    values.col(i) = ValuesOfRows(table.At(table.Find(name)), log_rows);
  }
  return values;
}

// A reading that no machine made is none that a filter may run through.
void BlankFaults(std::span<const ColumnFault> faults,
                 const std::vector<Eigen::Index>& log_rows,
                 SessionLog* log) {
  for (const ColumnFault& fault : faults) {
    if (!fault.of_cells || fault.input < 0) continue;
    for (const Eigen::Index row : fault.rows) {
      const auto at = std::ranges::lower_bound(log_rows, row);
      log->input_values(at - log_rows.begin(), fault.input) =
          std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace

void TakeLog(const CsvTable& table,
             const std::vector<Eigen::Index>& log_rows,
             std::span<const ColumnFault> blanked,
             FoundSessions found,
             Dataset::Parts* parts) {
  auto log = std::make_shared<SessionLog>();
  log->sessions = std::move(found.sessions);
  log->time = std::move(found.time);
  log->time_unit = std::move(found.time_unit);
  if (found.time_column >= 0) {
    log->time_column = table.At(found.time_column).name;
  }
  log->dated = found.dated;
  log->ordered = found.ordered;
  log->gap = std::isfinite(found.gap) ? found.gap : 0.0;
  // Both lists ascend, and the rows kept are among those of the log.
  auto at = log_rows.begin();
  for (const Eigen::Index row : parts->rows) {
    at = std::lower_bound(at, log_rows.end(), row);
    parts->log_rows.push_back(at - log_rows.begin());
  }
  if (log_rows == parts->rows) {
    log->input_values = std::move(parts->input_values);
    parts->input_values.resize(0, 0);
  } else {
    log->input_values = LoggedInputs(table, log_rows, *parts);
    BlankFaults(blanked, log_rows, log.get());
  }
  log->first_rows = FirstRows(log->sessions, log->input_values);
  parts->log = std::move(log);
}

std::string AlignTarget(Dataset::Parts* parts) {
  parts->align = Alignment::kFirst;
  const SessionLog& log = *parts->log;
  std::vector<double> first(log.sessions.labels.size());
  // Backwards, so that the first row has the last word.
  const auto session_of = [&](std::size_t i) {
    return static_cast<std::size_t>(log.sessions.codes[parts->log_rows[i]]);
  };
  for (std::size_t i = parts->rows.size(); i-- > 0;) {
    first[session_of(i)] = parts->target_values[static_cast<Eigen::Index>(i)];
  }
  for (std::size_t i = 0; i < parts->rows.size(); ++i) {
    parts->target_values[static_cast<Eigen::Index>(i)] -= first[session_of(i)];
  }
  return "the first value of each session is subtracted from " +
         QuotedName(parts->target.name) + " (" +
         ArgumentName("align", "first") +
         "): the map predicts the change since";
}

}  // namespace errmap::data
