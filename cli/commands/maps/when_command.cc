#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/json_blocks.h"
#include "cli/report/number_text.h"
#include "cli/report/text/commands/when_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_setup/provenance.h"
#include "data/columns.h"
#include "data/files/shown_path.h"
#include "data/input_error.h"
#include "models/session/map_rows.h"
#include "models/session/zero_schedule.h"

namespace errmap::cli {
namespace {

struct WhenArguments {
  std::string model;
  std::optional<std::string> goal;
  models::MapDataArguments log;  // `after`: from the last probe to now
  std::string format = "table";
};

// What happened since the last probe.
struct SinceProbe {
  double age = 0.0;     // s
  double change = 0.0;  // of the temperature that the rule goes by, its unit
};

SinceProbe ReadSinceProbe(const models::FittedModel& fitted,
                          const WhenArguments& arguments,
                          const models::ZeroTrigger& advised) {
  const data::CsvTable table = models::ReadForMap(fitted,
                                                  {arguments.log.after},
                                                  models::MapColumns::kInputs,
                                                  arguments.log)
                                   .table;
  const std::vector<Index> rows = data::AllRows(table.num_rows);
  if (rows.empty()) {
    throw data::InputError(fmt::format(
        "{}: holds no rows; give the readings from the last probe to now",
        data::ShownPath(arguments.log.after)));
  }
  const std::vector<models::Moment> moments =
      models::MomentsOf(fitted, table, rows, arguments.log).at;
  SinceProbe since{.age = moments.back().time - moments.front().time};
  if (!(since.age >= 0.0)) {
    throw data::InputError(fmt::format(
        "{}: its last row is before its first; give the readings from the last "
        "probe to now, in their order",
        data::ShownPath(arguments.log.after)));
  }
  if (advised.is_clock()) return since;
  const std::string& column = fitted.held_out->temperature;
  const std::ptrdiff_t at = table.Find(column);
  if (at < 0) {
    throw data::InputError(
        fmt::format("{}: has no column {}, by which this "
                    "map is best re-zeroed",
                    data::ShownPath(arguments.log.after),
                    column));
  }
  const std::vector<double>& values = table.At(at).values;
  since.change = values.back() - values.front();
  if (!std::isfinite(since.change)) {
    throw data::InputError(
        fmt::format("{}: column {} holds no number in its first or last row",
                    data::ShownPath(arguments.log.after),
                    column));
  }
  return since;
}

Json SecondsJson(double seconds) {
  return std::isfinite(seconds) ? Json(seconds) : Json();
}

Json ErrorsJson(const models::ZeroedErrors& errors) {
  return {{"interval_s", SecondsJson(errors.trigger.time)},
          {"probes", errors.probes},
          {"rmse", errors.rmse},
          {"within_90", errors.within_90}};
}

Json TriggerJson(const models::ZeroTrigger& trigger) {
  return {{"time_s", SecondsJson(trigger.time)},
          {"temperature", SecondsJson(trigger.temperature)}};
}

Json WhenJson(const models::FittedModel& fitted,
              const models::ZeroSchedule& schedule,
              double goal) {
  Json clocks = Json::array();
  for (const models::ZeroedErrors& clock : schedule.clocks) {
    clocks.push_back(ErrorsJson(clock));
  }
  Json json = {{"schema", "errmap-when-1"},
               {"model", fitted.name},
               {"target", fitted.target.name},
               {"unit", fitted.target.unit.symbol},
               {"goal", std::isnan(goal) ? Json() : Json(goal)},
               {"sessions", schedule.sessions},
               {"temperature", fitted.held_out->temperature},
               {"none", ErrorsJson(schedule.none)},
               {"no_probe_serves", schedule.no_probe_serves},
               {"clocks", std::move(clocks)},
               {"clock", schedule.clock ? ErrorsJson(*schedule.clock) : Json()},
               {"rule", Json()},
               {"advised", TriggerJson(schedule.advised())}};
  if (schedule.rule) {
    json["rule"] = {{"trigger", TriggerJson(schedule.rule->trigger)},
                    {"rmse", schedule.rule->rmse},
                    {"clock_rmse", schedule.rule->clock_rmse},
                    {"better", schedule.rule->better},
                    {"established", schedule.rule->established}};
  }
  return json;
}

int RunWhen(const WhenArguments& arguments, const std::string& command_line) {
  if (!arguments.log.after.empty() && !arguments.goal) {
    throw UsageError(
        "--after needs a goal to say whether a probe is due: --goal 2um");
  }
  const models::FittedModel fitted = LoadMap(arguments.model, false);
  RequireAges(fitted, arguments.model);
  const models::HeldOutErrors& errors = *fitted.held_out;
  const double goal =
      GoalOrNone(arguments.goal, fitted.target, errors.rmse, false);
  const models::ZeroSchedule schedule = models::ScheduleZeros(errors, goal);
  const models::ZeroTrigger advised = schedule.advised();
  std::optional<SinceProbe> since;
  if (!arguments.log.after.empty()) {
    since = ReadSinceProbe(fitted, arguments, advised);
  }
  const bool due = since && schedule.serves() &&
                   advised.Spent(since->age, since->change) >= 1.0;
  if (arguments.format == "json") {
    Json document = WhenJson(fitted, schedule, goal);
    if (since) {
      document["now"] = {{"age_s", since->age},
                         {"change", since->change},
                         {"spent", advised.Spent(since->age, since->change)},
                         {"due", due}};
    }
    document["provenance"] =
        ProvenanceJson(command_line,
                       Json::object(),
                       {study_setup::HashInput(arguments.model)});
    PrintResult(DumpJson(document));
  } else {
    PrintFitted(fmt::format(
        "{} ({}) on {}, re-zeroed by probes\n\n{}{}",
        arguments.model,
        fitted.name,
        report::Count(static_cast<long long>(schedule.sessions),
                      "unseen session"),
        report::WhenText(schedule, fitted, goal),
        since && schedule.clock
            ? report::ZeroDueText(advised, errors, since->age, since->change)
            : ""));
  }
  const bool out_of_reach = !std::isnan(goal) && !schedule.serves();
  return due || out_of_reach ? kEveryFitFailed : kDone;
}

}  // namespace

void AddWhenCommand(CLI::App* app, Run* run) {
  const Command<WhenArguments> command(
      app, run, "when", "Say when a map needs its next probe");
  AddModelArgument(command, &command->model);
  AddOption(command, "--goal X", command->goal)
      .About(
          "Limit for 90 % of the errors: 2um (default: no goal, only the "
          "table)");
  AddMapDataArguments(command, &command->log);
  FindOption(command, "--after").About("Readings from the last probe to now");
  AddFormatOption(command, &command->format);
  SetFooter(
      command,
      R"(Simulates probes on the held-out sessions of the map. The first row of a
session is a probe, and each later row is judged by the last probe before
it. A rule by temperature is advised if it errs 5 % less than the best
interval, with no more probes, in two sessions of three.
Exit status: 0 done; 4 if a probe is due now (--after), or no interval meets
the goal.
Example: errmap when map.json --goal 2um)");
  command.Runs(RunWhen);
}

}  // namespace errmap::cli
