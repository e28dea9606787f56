#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/json_blocks.h"
#include "cli/report/number_text.h"
#include "cli/report/text/commands/check_text.h"
#include "cli/report/text/commands/when_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_setup/provenance.h"
#include "data/columns.h"
#include "data/input_error.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_faults.h"
#include "data/measurements/measured_files.h"
#include "data/text.h"
#include "models/history/map_log.h"
#include "models/record_json.h"
#include "models/sensors/sensor_check.h"
#include "models/session/map_rows.h"
#include "models/session/session_check.h"
#include "models/session/zero_schedule.h"

namespace errmap::cli {
namespace {

struct ProbeArguments {
  std::string model;
  std::vector<std::string> files;
  std::optional<std::string> goal;
  // Rows without a target are readings between the probes.
  models::MapRowsOptions rows{.missing = data::MissingPolicy::kDropRows};
  std::string format = "table";
  bool quiet = false;
};

// When to probe next: an interval of the clock, or null.
Json NextProbeJson(const models::ZeroSchedule& schedule, double goal) {
  const auto& clock = schedule.clock;
  return {
      {"goal", goal},
      {"interval_s",
       clock && std::isfinite(clock->trigger.time) ? Json(clock->trigger.time)
                                                   : Json()},
      {"kept", clock.has_value()}};
}

Json ForecastJson(const models::RmseForecast& forecast) {
  return {{"rmse_80", {forecast.low, forecast.high}},
          {"off_probability", forecast.off_probability}};
}

Json SensorsJson(const models::SessionCheck& check) {
  Json names = Json::array();
  if (!check.sensor) return names;
  for (const data::ColumnInfo& column : check.sensor->columns) {
    names.push_back(column.name);
  }
  return names;
}

Json CheckJson(const models::SessionCheck& check) {
  return {{"begins_inside", check.missing == models::Missing::kStart},
          {"readings_missing", check.missing == models::Missing::kReadings},
          {"status", ToString(check.status)},
          {"sensors", SensorsJson(check)},
          {"sensor_fault",
           check.sensor ? Json(ToString(check.sensor->fault)) : Json()},
          {"off_probability", check.session.off_probability},
          {"so_far", ForecastJson(check.so_far)},
          {"later", check.later ? ForecastJson(*check.later) : Json()},
          {"remedy", ToString(check.remedy)},
          {"gain", check.gain},
          {"left", check.left},
          {"next_probe_s", models::ToJson(check.next_probe)},
          {"promised", check.promised},
          {"probes",
           {{"n", check.probes},
            {"rms", check.probe_rms},
            {"mean", check.probe_mean},
            {"scatter", check.probe_scatter}}},
          {"session_rmse_80", {check.session.low, check.session.high}}};
}

// The session that is judged: that of the last probe. Probes of days that are
// over tell nothing of how this one goes on.
struct LastSession {
  std::string column;  // that names it; "" where none does
  std::string label;
  std::size_t others = 0;                // sessions with probes
  std::vector<Index> probes = {};        // rows of the data set
  std::vector<Index> rows_of_file = {};  // all of it, 0-based
};

LastSession LastSessionOf(const models::FittedModel& fitted,
                          const models::MapRows& rows,
                          const models::MapDataArguments& log) {
  const std::vector<Index> all = data::AllRows(rows.table.num_rows);
  const models::MomentsOfRows moments =
      models::MomentsOf(fitted, rows.table, all, log);
  const auto session_of = [&](Index row) -> const std::string& {
    return moments.at[static_cast<std::size_t>(row)].session;
  };
  LastSession last{.column = moments.session_column,
                   .label = session_of(rows.dataset.rows().back())};
  std::set<std::string> others;
  for (std::size_t i = 0; i < rows.dataset.rows().size(); ++i) {
    const std::string& session = session_of(rows.dataset.rows()[i]);
    if (session == last.label) {
      last.probes.push_back(static_cast<Index>(i));
    } else {
      others.insert(session);
    }
  }
  last.others = others.size();
  std::ranges::copy_if(
      all, std::back_inserter(last.rows_of_file), [&](Index row) {
        return session_of(row) == last.label;
      });
  return last;
}

// Of the session's rows that are not left out; a spike by its row in the file.
std::optional<models::SensorFaultFound> SensorFaultOfSession(
    const models::FittedModel& fitted,
    const models::MapRows& rows,
    const LastSession& last,
    data::FaultPolicy policy) {
  std::vector<Index> judged = last.rows_of_file;
  if (policy == data::FaultPolicy::kDropRows) {
    const auto left_out = data::RowsOfCellFaults(rows.prepared.faults);
    std::erase_if(judged, [&](Index row) {
      return std::ranges::binary_search(left_out, row);
    });
  }
  const MatrixXd readings = models::ReadingsOf(fitted, rows.table);
  auto found = models::FindSensorFault(fitted, readings(judged, Eigen::all));
  if (found && found->row >= 0) {
    found->row = judged[static_cast<std::size_t>(found->row)];
  }
  return found;
}

std::string LastSessionText(const LastSession& last) {
  if (last.others == 0) return "";
  return fmt::format(
      "This judges the last of {} sessions, {} {}. errmap evaluate judges the "
      "others.\n",
      last.others + 1,
      last.column.empty() ? "session" : data::NameInRemark(last.column),
      data::QuotedName(last.label));
}

models::Missing MissingBeforeProbe(const models::MapRows& rows, Index probe) {
  return rows.missing_before[static_cast<std::size_t>(probe)];
}

// Probes since the map's memory is full, where the log began inside the
// session; all if there are none.
std::vector<Index> ProbesWithMemory(const models::MapRows& rows,
                                    const std::vector<Index>& probes) {
  std::vector<Index> kept;
  for (const Index probe : probes) {
    if (MissingBeforeProbe(rows, probe) != models::Missing::kStart) {
      kept.push_back(probe);
    }
  }
  return kept.empty() ? probes : kept;
}

// Those at positions that the map was fitted to; all if there are none.
std::vector<Index> ProbesWithinTravel(const std::vector<models::RowFlag>& flags,
                                      const std::vector<Index>& probes,
                                      bool quiet) {
  std::vector<Index> within;
  std::ranges::copy_if(probes, std::back_inserter(within), [&](Index probe) {
    const models::RowFlag& flag = flags[static_cast<std::size_t>(probe)];
    return flag.why != models::Outside::kRange ||
           !data::IsPosition(flag.column);
  });
  if (within.empty() || within.size() == probes.size()) return probes;
  SayUnless(quiet,
            {fmt::format("{} of {} probes are judged: the others are beyond "
                         "the positions that the map was fitted to",
                         within.size(),
                         probes.size())});
  return within;
}

// What is missing before the probes that are judged.
models::Missing MissingBefore(const models::FittedModel& fitted,
                              const models::MapRows& rows,
                              const std::vector<Index>& probes) {
  const auto lacks = [&](models::Missing missing) {
    return [&rows, missing](Index probe) {
      return MissingBeforeProbe(rows, probe) == missing;
    };
  };
  // Errors since a first row that is not there have no zero.
  const bool lacks_zero =
      fitted.align == data::Alignment::kFirst &&
      std::ranges::any_of(probes, lacks(models::Missing::kStart));
  if (lacks_zero ||
      std::ranges::all_of(probes, lacks(models::Missing::kStart))) {
    return models::Missing::kStart;
  }
  return std::ranges::any_of(probes, lacks(models::Missing::kReadings))
             ? models::Missing::kReadings
             : models::Missing::kNothing;
}

models::SessionProbes ProbesOf(const models::FittedModel& fitted,
                               const models::MapRows& rows,
                               const ProbeArguments& arguments,
                               const std::vector<Index>& probes_given,
                               const VectorXd& predicted) {
  const std::vector<Index> kept = ProbesWithMemory(rows, probes_given);
  models::SessionProbes probes{
      .elapsed =
          models::ElapsedSinceStart(fitted, rows, arguments.rows.log)(kept),
      .position = {},
      .predicted = predicted(kept),
      .residuals = (rows.dataset.target_values() - predicted)(kept)};
  const VectorXd positions = models::PositionsOf(fitted, rows);
  if (positions.size() > 0) probes.position = positions(kept);
  if (kept.size() < probes_given.size()) {
    SayUnless(arguments.quiet,
              {fmt::format("{} of {} probes are judged: at the others the "
                           "map's memory is incomplete",
                           kept.size(),
                           probes_given.size())});
  }
  return probes;
}

int RunCheck(const ProbeArguments& arguments, const std::string& command_line) {
  const models::FittedModel fitted = LoadMap(arguments.model, arguments.quiet);
  if (fitted.held_out == nullptr) {
    throw data::InputError(fmt::format(
        "{}: has no held-out errors to judge probes by; fit the map "
        "with compare, or with fit and without --no-interval",
        data::PrintablePath(arguments.model)));
  }
  const models::HeldOutErrors& errors = *fitted.held_out;
  double goal = std::numeric_limits<double>::quiet_NaN();
  std::optional<models::ZeroSchedule> schedule;
  if (arguments.goal) {
    goal =
        GoalOrNone(arguments.goal, fitted.target, errors.rmse, arguments.quiet);
    RequireAges(fitted, arguments.model);
    schedule = models::ScheduleZeros(errors, goal);
  }
  const models::MapRows rows =
      ReadMapRows(fitted, arguments.files, arguments.rows, arguments.quiet);
  const RowsJudged judged = JudgeMapRows(fitted, rows, arguments.quiet);
  const VectorXd predicted = fitted.PredictForm(judged.form_inputs).errors;
  if (SayNotFinite(predicted,
                   rows.dataset.rows(),
                   data::NamesOfFiles(arguments.files))) {
    return kEveryFitFailed;
  }
  LastSession last = LastSessionOf(fitted, rows, arguments.rows.log);
  last.probes = ProbesWithinTravel(judged.flags, last.probes, arguments.quiet);
  const models::SessionProbes probes =
      ProbesOf(fitted, rows, arguments, last.probes, predicted);
  models::SessionCheck check = models::CheckSession(
      errors,
      probes,
      MissingBefore(fitted, rows, last.probes),
      SensorFaultOfSession(fitted, rows, last, arguments.rows.faults));
  // Of a session whose first rows are not known nothing is said as a whole.
  if (check.status == models::SessionStatus::kHolds &&
      probes.residuals.size() < std::ssize(last.probes)) {
    check.status = models::SessionStatus::kHoldsSoFar;
  }
  const RowsLearnt learnt =
      FindRowsLearnt(fitted, arguments.model, arguments.files, rows);
  const std::vector<models::ProbeSite> sites = models::RankProbeSites(errors);
  if (arguments.format == "json") {
    Json document = MapAnswerJson("errmap-check-1", fitted, arguments.files);
    document["session"] = last.label;
    document["other_sessions"] = last.others;
    document["learnt_from"] = LearntJson(learnt);
    document.update(CheckJson(check));
    document["sites"] = models::ToJson(sites);
    if (schedule) document["next_probe"] = NextProbeJson(*schedule, goal);
    document["provenance"] = ProvenanceJson(
        command_line,
        {{"missing", ToString(arguments.rows.missing)},
         {"faults", ToString(arguments.rows.faults)}},
        study_setup::HashInputs(arguments.files, {arguments.model}));
    PrintResult(DumpJson(document));
  } else {
    PrintFitted(fmt::format(
        "{}{}{} ({}) on {} of {}{}{}",
        LearntText(learnt),
        LastSessionText(last),
        arguments.model,
        fitted.name,
        report::Count(check.probes, "probe"),
        data::NamesOfFiles(arguments.files),
        report::CheckText(
            check, errors, sites, probes.elapsed, fitted.target.unit),
        schedule ? report::ZeroAdvice(*schedule, fitted, goal) : ""));
  }
  switch (check.status) {
    case models::SessionStatus::kHolds:
      return kDone;
    case models::SessionStatus::kOff:
    case models::SessionStatus::kSensor:
      return kEveryFitFailed;
    case models::SessionStatus::kHoldsSoFar:
    case models::SessionStatus::kUnknown:
      return kNothingJudged;
  }
  return kOtherFailure;
}

}  // namespace

void AddCheckCommand(CLI::App* app, Run* run) {
  const Command<ProbeArguments> command(
      app,
      run,
      "check",
      "Check with a few probes whether a map holds in this session");
  AddModelArgument(command, &command->model);
  AddOption(command, "PROBES PROBES.csv", command->files)
      .About(
          "CSV file of a few readings, inputs and target; the last session is "
          "judged")
      .Required();
  AddOption(command, "--goal X", command->goal)
      .About(
          "Also say how often to probe to keep 90 % of the errors within this: "
          "2um\nerrmap when has more");
  AddRowOptions(command, &command->rows.missing, &command->rows.faults);
  AddFormatOption(command, &command->format);
  AddMapDataArguments(command, &command->rows.log);
  AddTargetOfMap(command, &command->rows.log);
  AddJoinedLogArguments(command, &command->rows.log);
  AddFromRest(command, &command->rows.log);
  AddQuietFlag(command, &command->quiet);
  SetFooter(command,
            R"(Asks three questions, and stops at the first that decides.
- The readings: is a sensor dead, frozen, swapped, off or in another unit?
- The start: are the first rows of the session there, for a map with a
memory?
- The probes: is the RMSE at most 1.5 times the expected one? The answer is
for the session so far, and for the rest of it.

Rows without a target are readings between the probes, for the memory of a
map. Name earlier readings with --after; they need no positions.
Exit status: 0 it holds; 4 it does not, or a sensor is at fault; 5 not known,
or it holds only so far.
Example: errmap check map.json data/sets/turning_centre/later_days.csv)");
  command.Runs(RunCheck);
}

}  // namespace errmap::cli
