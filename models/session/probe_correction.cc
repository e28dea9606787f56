#include "models/session/probe_correction.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "data/input_error.h"
#include "data/text.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

// Rows before all others go on into the probes by themselves.
bool RunsBetweenProbes(const FittedModel& fitted, const MapDataArguments& log) {
  return fitted.history != nullptr && fitted.history->needs_sessions() &&
         log.after.empty();
}

// The measured rows, and a memory that runs through all that is known of their
// sessions.
data::Dataset WithRowsBetween(const FittedModel& fitted,
                              const MapRows& measured,
                              const RowsForMap& today,
                              const MapDataArguments& log) {
  const MatrixXd inputs = ReadingsOf(fitted, measured.table);
  const PointLog merged =
      MakePointLog(*fitted.history, {measured.table, inputs}, &today, log);
  std::vector<Index> log_rows;
  for (const Index row : measured.dataset.rows()) {
    log_rows.push_back(merged.rows[static_cast<std::size_t>(row)]);
  }
  return measured.dataset.WithLog(merged.log, std::move(log_rows));
}

}  // namespace

MapRowsOptions ProbeRowsOptions(const FittedModel& fitted,
                                const MapDataArguments& log) {
  return {.missing = data::MissingPolicy::kDropRows,
          .log = log,
          .with_memory = !RunsBetweenProbes(fitted, log)};
}

ProbeCorrection CorrectByProbes(const FittedModel& fitted,
                                const MapRows& probes,
                                const RowsForMap& today,
                                const MapDataArguments& log) {
  const VectorXd predicted =
      fitted.Predict(RunsBetweenProbes(fitted, log)
                         ? WithRowsBetween(fitted, probes, today, log)
                         : probes.dataset);
  std::vector<Index> rows =
      stats::AllIndices(static_cast<Index>(today.table.num_rows));
  const MomentsOfRows of_today = MomentsOf(fitted, today.table, rows, log);
  // Few probes do not show which of their columns names sessions.
  MapDataArguments of_probes = log;
  if (log.session.empty() && probes.table.Find(of_today.session_column) >= 0) {
    of_probes.session = of_today.session_column;
  }
  const MomentsOfRows of_probe_rows =
      MomentsOf(fitted, probes.table, probes.dataset.rows(), of_probes);
  if (of_today.dated.has_value() && of_probe_rows.dated.has_value() &&
      of_today.dated != of_probe_rows.dated) {
    throw data::InputError(fmt::format(
        "{}: its clock and that of {} have no common zero, since one of them "
        "has dates; give both files the same column of times",
        data::PrintablePath(probes.table.file),
        data::PrintablePath(today.table.file)));
  }
  ProbeCorrection correction{.num_probes = predicted.size(),
                             .model = FitOffset(*fitted.held_out),
                             .track = {}};
  correction.track = TrackOffset(correction.model,
                                 of_probe_rows.at,
                                 probes.dataset.target_values() - predicted,
                                 of_today.at);
  return correction;
}

}  // namespace errmap::models
