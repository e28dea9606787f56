#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/format_option.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/desk/provenance.h"
#include "cli/json_blocks.h"
#include "cli/report/number_text.h"
#include "cli/report/words/check_text.h"
#include "cli/report/words/when_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/shell/terminal.h"
#include "data/input_error.h"
#include "data/measurements/measured_files.h"
#include "data/text.h"
#include "models/model_file.h"
#include "models/promise/map_rows.h"
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

Json CheckJson(const models::SessionCheck& check) {
  return {
      {"begins_inside", check.missing == models::Missing::kStart},
      {"readings_missing", check.missing == models::Missing::kReadings},
      {"status", ToString(check.status)},
      {"off_probability", check.off_probability},
      {"remedy", ToString(check.remedy)},
      {"more_probes", check.more_probes ? Json(*check.more_probes) : Json()},
      {"promised", check.promised},
      {"probes",
       {{"n", check.probes},
        {"rms", check.probe_rms},
        {"mean", check.probe_mean},
        {"scatter", check.probe_scatter},
        {"off_above", check.off_above},
        {"holds_to", check.holds_to}}},
      {"session_rmse_80", {check.session_low, check.session_high}}};
}

int RunCheck(const CheckArguments& arguments, const std::string& command_line) {
  const models::FittedModel fitted = models::LoadModel(arguments.model);
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
  const Eigen::VectorXd elapsed =
      models::ElapsedSinceStart(fitted, rows, arguments.rows.log);
  const models::SessionCheck check = models::CheckSession(
      errors, elapsed, rows.dataset.target_values() - predicted, rows.missing);
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
        report::CheckText(check, errors, sites, elapsed, fitted.target.unit),
        schedule
            ? report::ZeroAdvice(*schedule, errors, fitted.target.unit, goal)
            : ""));
  }
  switch (check.status) {
    case models::SessionStatus::kHolds:
      return kDone;
    case models::SessionStatus::kOff:
      return kEveryFitFailed;
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
  AddFlag(command, "--quiet", arguments->quiet, "No remarks on stderr");
  SetFooter(
      command,
      "A session is off where its RMSE is above 1.5 times the promised one. "
      "What so many\nprobes at these times tell of a session is taken from "
      "the map's held-out days.\nExit status: 0 the map holds, 4 it does not "
      "hold, 5 it is not known.\nRows without a target are readings "
      "between the probes, through which a map's memory\nruns; readings before "
      "the first row come by --after, "
      "which needs\nno positions.");
  OnRun(command, [arguments, run] {
    run->status = RunCheck(*arguments, run->command_line);
  });
}

}  // namespace errmap::cli
