#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/format_option.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/json_blocks.h"
#include "cli/shell/standard_streams.h"
#include "cli/shell/terminal.h"
#include "data/input_error.h"
#include "data/shown_path.h"
#include "data/text.h"
#include "models/model_file.h"
#include "models/promise/applicability.h"
#include "models/promise/map_rows.h"
#include "models/promise/session_check.h"
#include "models/report/number_text.h"
#include "models/study_file/provenance.h"

namespace errmap::cli {
namespace {

constexpr double kSecondsPerMinute = 60.0;
constexpr double kPercent = 100.0;

struct CheckArguments {
  std::string model;
  std::string file;
  // Rows without a target are readings between the probes.
  models::MapRowsOptions rows{.missing = data::MissingPolicy::kDropRows};
  std::string format = "table";
  bool quiet = false;
};

Json NumberOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json SitesJson(const std::vector<models::ProbeSite>& sites) {
  Json json = Json::array();
  for (const models::ProbeSite& site : sites) {
    json.push_back({{"from", site.from},
                    {"until", site.until},
                    {"position_from", NumberOrNull(site.position_from)},
                    {"position_until", NumberOrNull(site.position_until)},
                    {"factor", NumberOrNull(site.factor)}});
  }
  return json;
}

Json CheckJson(const models::SessionCheck& check) {
  return {
      {"begins_inside", check.begins_inside},
      {"status", ToString(check.status)},
      {"off_probability", NumberOrNull(check.off_probability)},
      {"remedy", ToString(check.remedy)},
      {"more_probes", check.more_probes ? Json(*check.more_probes) : Json()},
      {"promised", check.promised},
      {"probes",
       {{"n", check.probes},
        {"rms", check.probe_rms},
        {"mean", check.probe_mean},
        {"scatter", NumberOrNull(check.probe_scatter)},
        {"off_above", NumberOrNull(check.off_above)},
        {"holds_to", NumberOrNull(check.holds_to)}}},
      {"session_rmse_80",
       {NumberOrNull(check.session_low), NumberOrNull(check.session_high)}}};
}

std::string TimesText(const models::HeldOutErrors& errors,
                      const Eigen::VectorXd& elapsed) {
  if (errors.time_unit != "s") return "";
  return fmt::format(", {:.0f} to {:.0f} min after the session began",
                     elapsed.minCoeff() / kSecondsPerMinute,
                     elapsed.maxCoeff() / kSecondsPerMinute);
}

std::string StatusText(const models::SessionCheck& check,
                       const report::ErrorText& error) {
  if (check.begins_inside) {
    return "Not known whether the map holds: it has a memory, and the first "
           "rows of the session are missing. Give all rows since its start, "
           "those without a probe with an empty error, or the earlier ones "
           "with --after.\n";
  }
  const std::string range =
      fmt::format("its error is {} to {} RMSE with 80 % confidence",
                  error(check.session_low),
                  error.WithUnit(check.session_high));
  switch (check.status) {
    case models::SessionStatus::kHolds:
      return fmt::format(
          "The map holds in this session: {}, and the probability that it is "
          "above {} is {:.0f} %.\n",
          range,
          error.WithUnit(models::kOffRatio * check.promised),
          kPercent * check.off_probability);
    case models::SessionStatus::kOff:
      return fmt::format(
          "The map does not hold in this session: {}, above {} with a "
          "probability of {:.0f} %.\n",
          range,
          error.WithUnit(models::kOffRatio * check.promised),
          kPercent * check.off_probability);
    case models::SessionStatus::kUnknown:
      return fmt::format(
          "Not yet known whether the map holds: {}; above {} with a "
          "probability of {:.0f} %. {}\n",
          range,
          error.WithUnit(models::kOffRatio * check.promised),
          kPercent * check.off_probability,
          check.more_probes
              ? fmt::format("{} like these would settle it.",
                            report::Count(*check.more_probes, "more probe"))
              : "More probes like these would not settle it; take them later "
                "or elsewhere.");
  }
  return "";
}

std::string RemedyText(const models::SessionCheck& check,
                       const report::ErrorText& error) {
  switch (check.remedy) {
    case models::Remedy::kNone:
      return "";
    case models::Remedy::kRezero:
      return fmt::format(
          "An offset explains it: re-zero by {} (errmap predict --probes).\n",
          error.WithUnit(check.probe_mean));
    case models::Remedy::kRefit:
      return "An offset does not explain it: the shape is wrong; measure this "
             "state and fit again (errmap update).\n";
    case models::Remedy::kUnknown:
      return "One probe cannot tell an offset from a wrong shape: take a "
             "second one elsewhere.\n";
  }
  return "";
}

std::string SiteText(const models::HeldOutErrors& errors,
                     const models::ProbeSite& site) {
  std::string text;
  if (errors.time_unit == "s") {
    text += fmt::format("{:.0f} to {:.0f} min after the start",
                        site.from / kSecondsPerMinute,
                        site.until / kSecondsPerMinute);
  }
  if (std::isfinite(site.position_from)) {
    text +=
        fmt::format("{}{} {:.4g} to {:.4g}",
                    text.empty() ? "" : ", ",
                    data::Printable(errors.position, errors.position.size()),
                    site.position_from,
                    site.position_until);
  }
  return text;
}

std::string SitesText(const models::HeldOutErrors& errors,
                      const std::vector<models::ProbeSite>& sites) {
  if (sites.size() < 2 || !std::isfinite(sites.front().factor)) return "";
  return fmt::format(
      "Probes tell most at {}: half of them are within a factor of {:.2g} of "
      "the session's error.\n",
      SiteText(errors, sites.front()),
      sites.front().factor);
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
  const models::MapRows rows =
      ReadMapRows(fitted, arguments.file, arguments.rows, arguments.quiet);
  const RowsJudged judged = JudgeMapRows(fitted, rows, arguments.quiet);
  const Eigen::VectorXd predicted =
      fitted.PredictForm(judged.form_inputs).errors;
  if (SayNotFinite(predicted, rows.dataset.rows(), arguments.file)) {
    return kEveryFitFailed;
  }
  const Eigen::VectorXd elapsed =
      models::ElapsedSinceStart(fitted, rows, arguments.rows.log);
  const models::SessionCheck check =
      models::CheckSession(errors,
                           elapsed,
                           rows.dataset.target_values() - predicted,
                           rows.begins_inside);
  const std::vector<models::ProbeSite> sites = models::RankProbeSites(errors);
  if (arguments.format == "json") {
    Json document = {{"schema", "errmap-check-1"},
                     {"model", fitted.name},
                     {"file", data::ShownPath(arguments.file)},
                     {"target", fitted.target.name},
                     {"unit", fitted.target.unit.symbol}};
    document.update(CheckJson(check));
    document["sites"] = SitesJson(sites);
    document["provenance"] =
        ProvenanceJson(command_line,
                       {{"missing", ToString(arguments.rows.missing)},
                        {"faults", ToString(arguments.rows.faults)}},
                       {study_file::HashInput(arguments.model),
                        study_file::HashInput(arguments.file)});
    PrintResult(DumpJson(document));
  } else {
    const report::ErrorText error(fitted.target.unit, check.promised);
    PrintFitted(fmt::format(
        "{} ({}) on {} of {}{}: RMS {}, mean {}; promised {} RMSE\n",
        arguments.model,
        fitted.name,
        report::Count(check.probes, "probe"),
        arguments.file,
        TimesText(errors, elapsed),
        error.WithUnit(check.probe_rms),
        error.WithUnit(check.probe_mean),
        error.WithUnit(check.promised)));
    PrintFitted(fmt::format("{}{}{}",
                            StatusText(check, error),
                            RemedyText(check, error),
                            SitesText(errors, sites)));
  }
  return check.status == models::SessionStatus::kOff ? kEveryFitFailed : kDone;
}

}  // namespace

void AddCheckCommand(CLI::App* app, Run* run) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app->add_subcommand(
      "check", "Tell from a few probes whether a map holds in this session");
  command->add_option("MODEL", arguments->model, "Model file")
      ->required()
      ->type_name("FILE.json");
  command
      ->add_option("PROBES",
                   arguments->file,
                   "CSV file of a few measurements of one session: inputs and "
                   "target")
      ->required()
      ->type_name("PROBES.csv");
  AddRowOptions(command, &arguments->rows.missing, &arguments->rows.faults);
  AddFormatOption(command, &arguments->format);
  AddMapLogArguments(command, &arguments->rows.log);
  command->add_flag("--quiet", arguments->quiet, "No remarks on stderr");
  command->footer(
      "A session is off where its RMSE is above 1.5 times the promised one. "
      "What so many\nprobes at these times tell of a session is taken from "
      "the map's held-out days.\nExit status: 0 the map holds, or it is not "
      "yet known; 4 it does not hold.\nRows without a target are readings "
      "between the probes, through which a map's memory\nruns; readings before "
      "the first row come by --after.");
  command->callback([arguments, run] {
    run->status = RunCheck(*arguments, run->command_line);
  });
}

}  // namespace errmap::cli
