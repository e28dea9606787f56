#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/fleet/store/deployments.h"
#include "cli/fleet/store/store.h"
#include "cli/fleet/store/watched_maps.h"
#include "cli/json_blocks.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

using models::WatchStatus;

struct WatchArguments {
  std::string store;
  std::vector<std::string> data;
  std::string format = "table";
  bool quiet = false;
};

// The files of components with a map deployed. What is of none is said on
// stderr.
fleet::WatchedFiles FilesOf(const WatchArguments& arguments,
                            const fleet::FleetRecord& study,
                            const std::vector<fleet::Deployment>& deployments) {
  if (deployments.empty()) {
    throw data::InputError(
        "no map is deployed in this store; errmap deploy STORE COMPONENT "
        "does that");
  }
  fleet::WatchedFiles files =
      fleet::FindWatchedFiles(study, deployments, arguments.data);
  constexpr std::size_t kMostTold = 5;
  for (std::size_t i = 0; i < files.remarks.size(); ++i) {
    if (i == kMostTold) {
      Warn(fmt::format("likewise {} more", files.remarks.size() - i));
      break;
    }
    Warn(files.remarks[i]);
  }
  if (!files.unknown.empty() && !arguments.quiet) {
    Warn(fmt::format("{} of no component with a map deployed",
                     report::Count(std::ssize(files.unknown), "file")));
  }
  if (files.files.empty()) {
    throw data::InputError(
        "no file belongs to a component with a deployed map: keep the names "
        "and folders of the study, or write COMPONENT=FILE");
  }
  return files;
}

Json WatchJson(const std::string& store,
               const std::vector<fleet::WatchedComponent>& components) {
  Json list = Json::array();
  for (const fleet::WatchedComponent& component : components) {
    Json json = {
        {"name", component.deployment.component},
        {"status", ToString(component.status)},
        {"since", component.deployment.since},
        {"model", component.deployment.model},
        {"sessions", component.checks.size()},
        {"found", component.found},
        {"promised", component.deployment.promised},
        {"p_map", component.p_map},
        {"expected",
         component.judgement ? Json(component.judgement->promised) : Json()},
        {"proposal", component.Proposal(store)}};
    if (component.examined) {
      const models::WatchedSession& newest = component.checks.back().session;
      json["session"] = newest.label;
      json["offset"] = newest.offset;
      json["outside_share"] = newest.outside_share;
      json["sensor"] = newest.sensor;
      json["sensor_shift"] = newest.sensor_shift;
      json["p_sensor"] = newest.p_sensor;
      json["rows"] = newest.rows;
    }
    list.push_back(std::move(json));
  }
  return {{"schema", "errmap-watch-1"}, {"components", std::move(list)}};
}

std::string WatchText(const std::string& store,
                      const std::vector<fleet::WatchedComponent>& components) {
  std::vector<fleet::WatchedComponent> told;
  std::string proposals;
  for (const fleet::WatchedComponent& component : components) {
    if (component.status != WatchStatus::kAsPromised) told.push_back(component);
    const std::string proposal = component.Proposal(store);
    if (proposal.empty()) continue;
    const std::string& name = component.deployment.component;
    proposals += data::Printable(name) + ": " + proposal + "\n";
  }
  std::string text = fleet::WatchHeadline(components) + "\n";
  if (!told.empty()) {
    text += report::TerminalTable(fleet::WatchTable(told, true),
                                  OutputTerminal().columns);
  }
  return text + proposals;
}

// Worse goes before what could not be read, and that before what could not be
// judged: silence would be taken for health.
int StatusOf(const std::vector<fleet::WatchedComponent>& components) {
  const auto any = [&](const auto& is) {
    return std::ranges::any_of(components, is);
  };
  const auto has = [](WatchStatus status) {
    return [=](const fleet::WatchedComponent& component) {
      return component.status == status;
    };
  };
  if (any(has(WatchStatus::kWorse))) return kEveryFitFailed;
  if (!std::ranges::all_of(components, &fleet::WatchedComponent::examined)) {
    return kUnusableInput;
  }
  if (any(has(WatchStatus::kDoubtful))) return kNothingJudged;
  return any([](const fleet::WatchedComponent& component) {
    return component.status != WatchStatus::kNotJudged &&
           component.status != WatchStatus::kTooFewRows;
  })
             ? kDone
             : kNothingJudged;
}

int RunWatch(const WatchArguments& arguments) {
  const fleet::StorePaths paths{arguments.store};
  const fleet::FleetRecord study =
      fleet::ReadFleet(paths);  // before a lock is left there
  const fleet::StoreLock lock(paths);
  fleet::Database store = fleet::OpenStore(paths, lock);
  const std::vector<fleet::Deployment> deployments =
      fleet::DeploymentsInUse(&store);
  const fleet::WatchedMaps watched = fleet::WatchMaps(
      paths, &store, FilesOf(arguments, study, deployments).files);
  if (watched.as_studied > 0 && !arguments.quiet) {
    Warn(fmt::format(
        "{} from the study itself: they say nothing about another day",
        report::Count(watched.as_studied, "file")));
  }
  const std::vector<fleet::WatchedComponent>& components = watched.components;
  const std::string now = fleet::NowText();
  fleet::ChangeStore(paths, lock, [&](fleet::Database* copy) {
    for (const fleet::WatchedComponent& component : components) {
      if (!component.examined) continue;
      fleet::WriteChecks(copy, component.deployment.id, component.checks, now);
    }
  });
  data::WriteFileAtomically(paths.Watch(),
                            fleet::WatchHtml(arguments.store, components));
  if (arguments.format == "json") {
    PrintResult(DumpJson(WatchJson(arguments.store, components)));
  } else {
    const auto text =
        report::TableText(fleet::WatchTable(components), arguments.format);
    if (text) {
      PrintResult(*text);
    } else {
      PrintFitted(WatchText(arguments.store, components));
    }
  }
  const int status = StatusOf(components);
  if (status == kNothingJudged &&
      std::ranges::none_of(components, [](const auto& component) {
        return component.status == WatchStatus::kDoubtful;
      })) {
    Warn("none of the maps could be judged, for the reasons given");
  }
  return status;
}

}  // namespace

void AddWatchCommand(CLI::App* app, Run* run) {
  const Command<WatchArguments> command(
      app, run, "watch", "Check deployed maps against new measurements");
  AddOption(command, "STORE DIR", command->store)
      .About("Folder with an errmap.sqlite")
      .Required();
  AddOption(command, "DATA FILE|DIR", command->data)
      .About(
          "New measurements: CSV files named like those of the study, folders "
          "of them, or COMPONENT=FILE")
      .Required();
  AddTableFormatOption(command,
                       "What to print; csv, json and md have every component",
                       &command->format);
  AddQuietFlag(command, &command->quiet);
  SetFooter(
      command,
      R"(Compares offset and RMS of each session with the sessions held out when the
map was made, by t statistics. Compares each sensor with the others. A map
is worse if p is below 0.0025 and it errs 20 % more than promised. It is
doubtful if p is below 0.02 or it errs twice as much: measure one more
session. The store keeps the sessions, and watch.html draws them. A file
belongs to the component whose data file has the same name and shares most
folders.
Exit status: 0 none is worse, 3 nothing usable or deployed, 4 a map is worse
than
promised, 5 nothing judged, or doubtful.
Example: errmap watch fleet september/)");
  command.Runs(RunWatch);
}

}  // namespace errmap::cli
