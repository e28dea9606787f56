#include "cli/commands/maps/probe_correction.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/commands/maps/map_rows.h"
#include "cli/shell/number_text.h"
#include "data/input_error.h"
#include "models/promise/session_offset.h"

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
  const ErrorText error(fitted.target.unit, std::sqrt(model.noise));
  return fmt::format(
      "{} move {} of {}; the offset in the last is {}, known to {}",
      Count(probes, "probe"),
      corrected,
      Count(track.offset.size(), "row"),
      error.WithUnit(track.offset[last]),
      error.WithUnit(known));
}

}  // namespace

ProbeCorrection CorrectByProbes(const models::FittedModel& fitted,
                                const std::string& probes,
                                const data::CsvTable& table,
                                const std::vector<Index>& rows,
                                const MapLogArguments& log,
                                bool quiet) {
  if (fitted.held_out == nullptr) {
    throw data::InputError(
        "the map holds no errors of unseen days to weigh probes by; fit it "
        "with compare, or with fit and without --no-interval");
  }
  const MapRows measured = ReadMapRows(
      fitted, {.file = probes, .missing = kProbesOnly, .log = log}, quiet);
  const Eigen::VectorXd predicted = fitted.Predict(measured.dataset);
  const models::OffsetModel model = models::FitOffset(*fitted.held_out);
  const models::OffsetTrack track = models::TrackOffset(
      model,
      MomentsOf(fitted, measured.table, measured.dataset.rows(), log),
      measured.dataset.target_values() - predicted,
      MomentsOf(fitted, table, rows, log));
  ProbeCorrection correction{
      .offset = track.offset,
      .narrowing = track.variance,
      .line = LineOf(fitted, model, track, predicted.size())};
  for (double& value : correction.narrowing) value = model.Narrowing(value);
  return correction;
}

}  // namespace errmap::cli
