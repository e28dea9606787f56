#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/format_option.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/desk/provenance.h"
#include "cli/json_blocks.h"
#include "cli/report/number_text.h"
#include "cli/report/words/commands/check_text.h"
#include "cli/report/words/commands/when_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/shell/terminal.h"
#include "data/input_error.h"
#include "data/measurements/measured_files.h"
#include "data/text.h"
#include "models/history/map_log.h"
#include "models/model_file.h"
#include "models/promise/map_rows.h"
#include "models/promise/sensor_check.h"
#include "models/promise/session_check.h"
#include "models/promise/zero_schedule.h"

namespace errmap::cli {
namespace {

struct CheckArguments {
  std::string model;
  std::vector<std::string> files;
  std::optional<std::string> goal;
  // Rows without a target are readings between the probes.
  models::MapRowsOptions rows{.missing = data::MissingPolicy::kDropRows};
  std::string format = "table";
  bool quiet = false;
};

Json SitesJson(const std::vector<models::ProbeSite>& sites) {
  Json json = Json::array();
  for (const models::ProbeSite& site : sites) {
    json.push_back({{"from", site.from},
                    {"until", site.until},
                    {"position_from", site.position_from},
                    {"position_until", site.position_until},
                    {"factor", site.factor}});
  }
  return json;
}

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

Json NumberOrNull(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
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
          {"next_probe_s", NumberOrNull(check.next_probe)},
          {"promised", check.promised},
          {"probes",
           {{"n", check.probes},
            {"rms", check.probe_rms},
            {"mean", check.probe_mean},
            {"scatter", check.probe_scatter}}},
          {"session_rmse_80", {check.session.low, check.session.high}}};
}

// Probes since the map's memory is full, where the log began inside a session;
// all where there are none.
std::vector<Eigen::Index> ProbesWithMemory(const models::MapRows& rows) {
  std::vector<Eigen::Index> kept;
  std::vector<Eigen::Index> all;
  for (const models::Missing missing : rows.missing_before) {
    const auto row = std::ssize(all);
    all.push_back(row);
    if (missing != models::Missing::kStart) kept.push_back(row);
  }
  return kept.empty() ? all : kept;
}

// What is missing before the probes that are judged.
models::Missing MissingBefore(const models::MapRows& rows) {
  if (std::ranges::all_of(rows.missing_before, [](models::Missing missing) {
        return missing == models::Missing::kStart;
      })) {
    return models::Missing::kStart;
  }
  return std::ranges::count(rows.missing_before, models::Missing::kReadings) > 0
             ? models::Missing::kReadings
             : models::Missing::kNothing;
}

models::SessionProbes ProbesOf(const models::FittedModel& fitted,
                               const models::MapRows& rows,
                               const CheckArguments& arguments,
                               const Eigen::VectorXd& predicted) {
  const std::vector<Eigen::Index> kept = ProbesWithMemory(rows);
  models::SessionProbes probes{
      .elapsed =
          models::ElapsedSinceStart(fitted, rows, arguments.rows.log)(kept),
      .position = {},
      .predicted = predicted(kept),
      .residuals = (rows.dataset.target_values() - predicted)(kept)};
  const Eigen::Index position =
      rows.dataset.FindInput(fitted.held_out->position);
  if (position >= 0) {
    probes.position = rows.dataset.input_values().col(position)(kept);
  }
  if (std::ssize(kept) < rows.dataset.num_rows()) {
    SayUnless(arguments.quiet,
              {fmt::format("{} of {} probes are judged: before the others the "
                           "map's memory is not full",
                           kept.size(),
                           rows.dataset.num_rows())});
  }
  return probes;
}

int RunCheck(const CheckArguments& arguments, const std::string& command_line) {
  const models::FittedModel fitted = LoadMap(arguments.model, arguments.quiet);
  if (fitted.held_out == nullptr) {
    throw data::InputError(fmt::format(
        "{}: holds no errors of unseen days to judge probes by; fit the map "
        "with compare, or with fit and without --no-interval",
        data::PrintablePath(arguments.model)));
  }
  const models::HeldOutErrors& errors = *fitted.held_out;
  double goal = std::numeric_limits<double>::quiet_NaN();
  std::optional<models::ZeroSchedule> schedule;
  if (arguments.goal) {
    goal = GoalOrNone(arguments.goal, fitted.target.unit);
    RequireAges(fitted, arguments.model);
    schedule = models::ScheduleZeros(errors, goal);
  }
  const models::MapRows rows =
      ReadMapRows(fitted, arguments.files, arguments.rows, arguments.quiet);
  const RowsJudged judged = JudgeMapRows(fitted, rows, arguments.quiet);
  const Eigen::VectorXd predicted =
      fitted.PredictForm(judged.form_inputs).errors;
  if (SayNotFinite(predicted,
                   rows.dataset.rows(),
                   data::NamesOfFiles(arguments.files))) {
    return kEveryFitFailed;
  }
  const models::SessionProbes probes =
      ProbesOf(fitted, rows, arguments, predicted);
  const models::Missing missing = MissingBefore(rows);
  const Eigen::MatrixXd readings = models::ReadingsOf(fitted, rows.table);
  auto sensor = models::FindSensorFault(
      fitted, readings, arguments.rows.log.after.empty());
  if (!sensor && missing == models::Missing::kNothing) {
    sensor = models::SwapThatExplains(fitted, rows.dataset, readings);
  }
  models::SessionCheck check =
      models::CheckSession(errors, probes, missing, std::move(sensor));
  // Of a session whose first rows are not known nothing is said as a whole.
  if (check.status == models::SessionStatus::kHolds &&
      probes.residuals.size() < rows.dataset.num_rows()) {
    check.status = models::SessionStatus::kHoldsSoFar;
  }
  const RowsLearnt learnt =
      FindRowsLearnt(fitted, arguments.model, arguments.files, rows);
  const std::vector<models::ProbeSite> sites = models::RankProbeSites(errors);
  if (arguments.format == "json") {
    Json document = {{"schema", "errmap-check-1"},
                     {"model", fitted.name},
                     {"file", desk::ShownNames(arguments.files)},
                     {"target", fitted.target.name},
                     {"unit", fitted.target.unit.symbol}};
    document["learnt_from"] = LearntJson(learnt);
    document.update(CheckJson(check));
    document["sites"] = SitesJson(sites);
    if (schedule) document["next_probe"] = NextProbeJson(*schedule, goal);
    document["provenance"] =
        ProvenanceJson(command_line,
                       {{"missing", ToString(arguments.rows.missing)},
                        {"faults", ToString(arguments.rows.faults)}},
                       desk::HashInputs(arguments.files, {arguments.model}));
    PrintResult(DumpJson(document));
  } else {
    PrintFitted(fmt::format(
        "{}{} ({}) on {} of {}{}{}",
        LearntText(learnt),
        arguments.model,
        fitted.name,
        report::Count(check.probes, "probe"),
        data::NamesOfFiles(arguments.files),
        report::CheckText(
            check, errors, sites, probes.elapsed, fitted.target.unit),
        schedule
            ? report::ZeroAdvice(*schedule, errors, fitted.target.unit, goal)
            : ""));
  }
  switch (check.status) {
    case models::SessionStatus::kHolds:
      return kDone;
    case models::SessionStatus::kOff:
      return kEveryFitFailed;
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
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command =
      AddCommand(app,
                 "check",
                 "Tell from a few probes whether a map holds in this session");
  AddOption(command, "MODEL FILE.json", arguments->model, "Model file")
      .Required();
  AddOption(command,
            "PROBES PROBES.csv",
            arguments->files,
            "CSV file of a few measurements of one session, inputs and "
            "target; or several")
      .Required();
  AddOption(command,
            "--goal X",
            arguments->goal,
            "Also say how often to probe to keep 90 % of the errors "
            "within this: 2um\n(errmap when has more)");
  AddRowOptions(command, &arguments->rows.missing, &arguments->rows.faults);
  AddFormatOption(command, &arguments->format);
  AddMapLogArguments(command, &arguments->rows.log);
  AddFromRest(command, &arguments->rows.log);
  AddFlag(command, "--quiet", arguments->quiet, "No remarks on stderr");
  SetFooter(
      command,
      "First the readings: a sensor that is dead, frozen, swapped, off "
      "or in another unit is\nnamed. Then the start of the session, which a "
      "map with a memory must know. Then the\nprobes: the map holds where "
      "its RMSE is at most 1.5 times the promised one, so far and\nfor the "
      "rest of the session, as far as the map's held-out days tell "
      "that.\nExit status: 0 the map holds, 4 it does not hold or a sensor "
      "is at fault, 5 it is not\nknown, or not of the rest of the "
      "session.\nRows without a target are readings between the probes, "
      "through which a map's memory\nruns; readings before the first row "
      "come by --after, which needs\nno positions.");
  OnRun(command, [arguments, run] {
    run->status = RunCheck(*arguments, run->command_line);
  });
}

}  // namespace errmap::cli
