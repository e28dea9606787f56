#include <algorithm>

#include <fmt/format.h>

#include "models/fleet/watch.h"
#include "models/sensors/applicability.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

std::vector<MeasuredSession> SessionsOf(const FittedModel& fitted,
                                        const MapRows& rows) {
  const std::vector<Moment> moments =
      MomentsOf(fitted, rows.table, rows.dataset.rows(), {}).at;
  std::vector<MeasuredSession> sessions;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (sessions.empty() ||
        sessions.back().session.label != moments[i].session) {
      sessions.emplace_back().session.label = moments[i].session;
    }
    sessions.back().rows.push_back(static_cast<Index>(i));
  }
  return sessions;
}

// Time since the session began in the unit of the held-out errors; (0) where
// the rows have none.
VectorXd ElapsedIn(const HeldOutErrors& errors, const VectorXd& seconds) {
  const Index n = seconds.size();
  if (errors.time_unit == "rows") {
    return VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1));
  }
  const bool timed = n == 1 || seconds.maxCoeff() > seconds.minCoeff();
  return errors.time_unit == "s" && timed ? seconds : VectorXd();
}

// Columns of the relations; none where the table lacks one.
std::vector<const data::CsvColumn*> SensorsIn(
    const data::CsvTable& table, const SensorRelations* relations) {
  std::vector<const data::CsvColumn*> sensors;
  if (relations == nullptr) return sensors;
  for (const data::ColumnInfo& column : relations->columns) {
    const std::ptrdiff_t found = table.Find(column.name);
    if (found < 0) return {};
    sensors.push_back(&table.At(found));
  }
  return sensors;
}

void JudgeSensorsOf(const data::Dataset& dataset,
                    const std::vector<const data::CsvColumn*>& sensors,
                    const SensorRelations& relations,
                    MeasuredSession* measured) {
  MatrixXd values(measured->rows.size(), sensors.size());
  Index kept = 0;
  for (const Index row : measured->rows) {
    const auto in_file =
        static_cast<std::size_t>(dataset.rows()[static_cast<std::size_t>(row)]);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      values(kept, static_cast<Index>(i)) = sensors[i]->values[in_file];
    }
    kept += values.row(kept).allFinite() ? 1 : 0;
  }
  if (kept == 0) return;
  JudgeSensors(
      relations, ShiftsOf(relations, values.topRows(kept)), &measured->session);
}

}  // namespace

std::string WhyNotWatched(const FittedModel& fitted) {
  if (fitted.held_out == nullptr || !fitted.interval ||
      !fitted.interval->of_sessions) {
    return "its map was not judged on whole sessions: it states no error for "
           "another one";
  }
  if (const auto units = std::ssize(fitted.held_out->units);
      units < kFewestSessions) {
    return fmt::format(
        "its map was judged on {} sessions: how much they differ is not known "
        "from fewer than {}",
        units,
        kFewestSessions);
  }
  return "";
}

std::vector<MeasuredSession> MeasureSessions(const FittedModel& fitted,
                                             const MapRows& rows,
                                             const SensorRelations* relations) {
  const data::Dataset& dataset = rows.dataset;
  const MatrixXd form_inputs = fitted.FormInputs(dataset);
  const std::vector<RowFlag> flags =
      FlagRows(fitted, dataset.input_values(), form_inputs);
  const VectorXd residuals =
      dataset.target_values() - fitted.PredictForm(form_inputs).errors;
  const VectorXd elapsed = ElapsedSinceStart(fitted, rows, {});
  const Index position = fitted.held_out == nullptr
                             ? -1
                             : dataset.FindInput(fitted.held_out->position);
  const auto sensors = SensorsIn(rows.table, relations);
  const bool is_watched = WhyNotWatched(fitted).empty();
  std::vector<MeasuredSession> sessions = SessionsOf(fitted, rows);
  for (MeasuredSession& measured : sessions) {
    WatchedSession& session = measured.session;
    const VectorXd of_it = residuals(measured.rows);
    const auto outside = std::ranges::count_if(measured.rows, [&](Index row) {
      return flags[static_cast<std::size_t>(row)].outside();
    });
    const auto n = static_cast<double>(of_it.size());
    session.rows = of_it.size();
    session.begins_inside = std::ranges::any_of(measured.rows, [&](Index row) {
      return rows.missing_before[static_cast<std::size_t>(row)] ==
             Missing::kStart;
    });
    session.offset = of_it.mean();
    session.mean_square = of_it.squaredNorm() / n;
    session.outside_share = static_cast<double>(outside) / n;
    session.sensor_shift = session.p_sensor = stats::kNaN;
    if (is_watched) {
      const HeldOutErrors& errors = *fitted.held_out;
      const VectorXd positions =
          position < 0 ? VectorXd()
                       : dataset.input_values().col(position)(measured.rows);
      session.too_few = AreTooFew(errors, session.rows, positions);
      if (!session.too_few && !session.begins_inside) {
        session.expected = ExpectedOf(
            errors, ElapsedIn(errors, elapsed(measured.rows)), positions);
      }
    }
    if (!sensors.empty() && session.rows >= kFewestRows) {
      JudgeSensorsOf(dataset, sensors, *relations, &measured);
    }
  }
  return sessions;
}

}  // namespace errmap::models
