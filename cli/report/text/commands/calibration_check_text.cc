#include "cli/report/text/commands/calibration_check_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "data/argument_name.h"
#include "data/text.h"
#include "models/study/judgement/goal.h"

namespace errmap::report {
namespace {

// `enough`: rows to fit a constant to, which a few rows meet by chance.
std::string BaselineText(const models::CalibrationCheck& kept,
                         const ErrorText& error,
                         bool enough) {
  if (!kept.better_than_nothing()) {
    const bool mends = enough && kept.shape == models::ErrorShape::kOffset;
    return fmt::format("as it is, no better than no compensation, {}{}",
                       error.WithUnit(kept.uncompensated),
                       mends ? "" : ": do not use it here");
  }
  if (!enough) {
    return fmt::format("better than no compensation ({})",
                       error.WithUnit(kept.uncompensated));
  }
  if (!kept.better_than_constant()) {
    return fmt::format(
        "no compensation leaves {}; a constant would be better: {}",
        error.WithUnit(kept.uncompensated),
        error.WithUnit(kept.constant));
  }
  return fmt::format(
      "better than no compensation ({}) and than any constant "
      "({})",
      error.WithUnit(kept.uncompensated),
      error.WithUnit(kept.constant));
}

}  // namespace

std::string FoundText(const models::CalibrationCheck& kept,
                      const data::Unit& unit) {
  if (!std::isfinite(kept.promised)) return "";
  const ErrorText error(unit, kept.found);
  const std::string within =
      std::isfinite(kept.within_90)
          ? fmt::format("; {:.0f} % of the errors within the 90 % interval",
                        kPercent * kept.within_90)
          : "";
  return fmt::format("found {} RMSE, expected {}{}\n",
                     error.WithUnit(kept.found),
                     error.WithUnit(kept.promised),
                     within);
}

std::string KeptPromiseText(const models::CalibrationCheck& kept,
                            Eigen::Index rows,
                            const data::Unit& unit) {
  const ErrorText error(unit, kept.found);
  const bool enough = rows >= models::kFewestRowsForGoal;
  std::string text = FoundText(kept, unit);
  text += BaselineText(kept, error, enough) + "\n";
  if (!enough) {
    return text + fmt::format(
                      "{} cannot show whether an offset explains it: {} rows "
                      "are needed\n",
                      Count(rows, "row"),
                      models::kFewestRowsForGoal);
  }
  if (kept.shape == models::ErrorShape::kOffset) {
    text += fmt::format(
        "an offset of {} is {:.0f} % of its mean square: re-zero, which leaves "
        "{}\n",
        error.WithUnit(kept.mean),
        kPercent * kept.offset_share,
        error.WithUnit(kept.scatter()));
  } else if (kept.shape == models::ErrorShape::kShape) {
    text += "no offset explains this error: measure here and fit again\n";
  }
  return text;
}

std::string TrialText(const models::UpdateTrial& trial,
                      const data::Unit& unit,
                      bool all_unseen) {
  const ErrorText error(unit, std::min(trial.old_rmse, trial.new_rmse));
  std::string text = fmt::format(
      "RMSE ({}) on new sessions{}\n",
      error.symbol(),
      all_unseen ? ", each unseen" : ", which the old map has seen in part");
  text += fmt::format("  {:<12}  {:>9}  {:>9}\n", "session", "old", "new");
  for (const auto& session : trial.sessions) {
    text += fmt::format("  {:<12}  {:>9}  {:>9}\n",
                        data::Printable(session.session),
                        error(session.old_rmse),
                        error(session.new_rmse));
  }
  text += fmt::format("  {:<12}  {:>9}  {:>9}\n",
                      "all",
                      error(trial.old_rmse),
                      error(trial.new_rmse));
  if (trial.is_negated()) {
    text += fmt::format(
        "the new errors seem to have the opposite sign: with it, the old map's "
        "error is {}; if they are corrections: {}\n",
        error.WithUnit(trial.negated_rmse),
        data::ArgumentName("target", "-COL"));
  } else if (trial.is_shifted()) {
    text += fmt::format(
        "the new errors are shifted by {}: without that, the old map's error "
        "is {}; re-zero it, or fit only the new sessions: {}\n",
        error.WithUnit(trial.shift),
        error.WithUnit(trial.shifted_rmse),
        data::ArgumentName("known", "NEW.csv"));
  }
  return text;
}

std::string OffsetLine(const models::ProbeCorrection& correction,
                       const data::Unit& unit) {
  const models::OffsetTrack& track = correction.track;
  const auto corrected = std::ranges::count_if(
      track.used, [](Eigen::Index used) { return used > 0; });
  if (corrected == 0) {
    return fmt::format(
        "warning: {} move{} none of {}: none follows a probe in its session",
        Count(correction.num_probes, "probe"),
        correction.num_probes == 1 ? "s" : "",
        Count(track.offset.size(), "row"));
  }
  // Rows of another session behind them are not moved.
  std::size_t at = track.used.size() - 1;
  while (track.used[at] == 0) --at;
  const auto last = static_cast<Eigen::Index>(at);
  const double known = std::sqrt(track.variance[last]);
  const ErrorText error(unit, std::sqrt(correction.model.noise));
  std::string line =
      fmt::format("{} {} {} of {}; the last of them by {}, known to {}",
                  Count(correction.num_probes, "probe"),
                  correction.num_probes == 1 ? "moves" : "move",
                  corrected,
                  Count(track.offset.size(), "row"),
                  error.WithUnit(track.offset[last]),
                  error.WithUnit(known));
  if (track.contradicted[at]) {
    line += fmt::format(
        "; warning: these probes show more than an offset, so the interval is "
        "{:.2g} times as wide",
        track.widening[last]);
  } else if (track.used[at] == 1) {
    line +=
        "; one probe cannot tell an offset from a wrong shape, so the interval "
        "does not narrow";
  }
  return line;
}

std::string SensitivityLine(const models::Sensitivity& sensitivity,
                            const ErrorText& error) {
  if (sensitivity.jump_of.empty()) return "";
  std::string text = fmt::format(
      "{:g} degC of noise in each thermometer moves the map by {} RMS. One "
      "that fails and reads 0 moves it by up to {} ({})",
      models::Sensitivity::kNoise,
      error.WithUnit(sensitivity.per_noise),
      error.WithUnit(sensitivity.largest_jump),
      data::Printable(sensitivity.jump_of));
  if (sensitivity.rezero_jump > 0.0) {
    text += fmt::format(", a new zero by up to {}",
                        error.WithUnit(sensitivity.rezero_jump));
  }
  return text;
}

}  // namespace errmap::report
