#include "cli/commands/maps/probe_correction.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/commands/maps/map_rows.h"
#include "data/input_error.h"
#include "models/promise/session_offset.h"
#include "models/report/number_text.h"

namespace errmap::cli {
namespace {

using Eigen::Index;

std::string LineOf(const models::FittedModel& fitted,
                   const models::OffsetModel& model,
                   const models::OffsetTrack& track,
                   Index probes) {
  const auto corrected =
      std::ranges::count_if(track.used, [](Index used) { return used > 0; });
  const Index last = track.offset.size() - 1;
  const double known = std::sqrt(track.variance[last]);
  const report::ErrorText error(fitted.target.unit, std::sqrt(model.noise));
  return fmt::format(
      "{} move {} of {}; the offset in the last is {}, known to {}",
      report::Count(probes, "probe"),
      corrected,
      report::Count(track.offset.size(), "row"),
      error.WithUnit(track.offset[last]),
      error.WithUnit(known));
}

// The measured rows, and a memory that runs through all that is known of their
// sessions.
data::Dataset WithRowsBetween(const models::FittedModel& fitted,
                              const MapRows& measured,
                              const RowsForMap& today,
                              const MapLogArguments& log) {
  const Eigen::MatrixXd inputs = ReadingsOf(fitted, measured.table);
  const PointLog merged =
      MakePointLog(*fitted.history, {measured.table, inputs}, &today, log);
  std::vector<Index> log_rows;
  for (const Index row : measured.dataset.rows()) {
    log_rows.push_back(merged.rows[static_cast<std::size_t>(row)]);
  }
  return measured.dataset.WithLog(merged.log, std::move(log_rows));
}

}  // namespace

ProbeCorrection CorrectByProbes(const models::FittedModel& fitted,
                                const std::string& probes,
                                const RowsForMap& today,
                                const MapLogArguments& log,
                                bool quiet) {
  if (fitted.held_out == nullptr) {
    throw data::InputError(
        "the map holds no errors of unseen days to weigh probes by; fit it "
        "with compare, or with fit and without --no-interval");
  }
  // With --after the probes go on from there.
  const bool between = fitted.history != nullptr &&
                       fitted.history->needs_sessions() && log.after.empty();
  const MapRows measured = ReadMapRows(fitted,
                                       {.file = probes,
                                        .missing = kProbesOnly,
                                        .log = log,
                                        .with_memory = !between},
                                       quiet);
  const Eigen::VectorXd predicted =
      fitted.Predict(between ? WithRowsBetween(fitted, measured, today, log)
                             : measured.dataset);
  std::vector<Index> rows(today.table.num_rows);
  std::iota(rows.begin(), rows.end(), Index{0});
  const models::OffsetModel model = models::FitOffset(*fitted.held_out);
  const models::OffsetTrack track = models::TrackOffset(
      model,
      MomentsOf(fitted, measured.table, measured.dataset.rows(), log),
      measured.dataset.target_values() - predicted,
      MomentsOf(fitted, today.table, rows, log));
  ProbeCorrection correction{
      .offset = track.offset,
      .narrowing = track.variance,
      .line = LineOf(fitted, model, track, predicted.size())};
  for (double& value : correction.narrowing) value = model.Narrowing(value);
  return correction;
}

}  // namespace errmap::cli
