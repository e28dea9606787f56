#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/fleet/store/deployments.h"
#include "cli/fleet/store/store.h"
#include "cli/report/number_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "data/files/atomic_file.h"
#include "data/files/prepare_folder.h"
#include "data/input_error.h"
#include "data/sha256.h"
#include "data/tables/text/gzip.h"
#include "data/text.h"
#include "data/throwing_as.h"
#include "fitting/parallel_for.h"
#include "models/fleet/watch.h"
#include "models/model_file.h"
#include "stats/not_a_number.h"

namespace errmap::cli {
namespace {

struct DeployArguments {
  std::string store;
  std::vector<std::string> components;
  bool all = false;
  std::string model;
};

// A packed file of a component, "" if there is none.
std::string Unpacked(const fleet::StorePaths& paths,
                     const std::string& component,
                     const char* file) {
  const std::string path = paths.InFolder(component, file);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return "";
  return data::ThrowingAs<data::InputError, data::InputError>(
      data::PrintablePath(path) + ": ", [&] {
        return data::Gunzip(data::ReadFile(path), data::kMostTextOfPrograms);
      });
}

// What a component's map is by the store: its target and its file's hash.
struct Recommended {
  std::string component;
  std::string target;
  std::string sha256 = {};  // "": none
  std::string why_failed = {};
};

// Every component of the study, by name.
std::map<std::string, Recommended> ComponentsIn(fleet::Database* store) {
  fleet::Statement rows = store->Prepare(
      "SELECT name, target, maps.sha256, why FROM components LEFT JOIN maps ON "
      "component = name");
  std::map<std::string, Recommended> found;
  while (rows.Next()) {
    found[rows.Text(0)] = {.component = rows.Text(0),
                           .target = rows.Text(1),
                           .sha256 = rows.Text(2),
                           .why_failed = rows.Text(3)};
  }
  return found;
}

// Those that are asked for; of --all those that have a map.
std::vector<Recommended> Asked(fleet::Database* store,
                               const DeployArguments& arguments) {
  const std::map<std::string, Recommended> known = ComponentsIn(store);
  std::vector<Recommended> asked;
  for (const auto& [name, component] : known) {
    if (arguments.all && !component.sha256.empty()) asked.push_back(component);
  }
  std::set<std::string> named;
  for (const std::string& name : arguments.components) {
    const auto found = known.find(name);
    if (found == known.end()) {
      throw UsageError(
          fmt::format("no component {} in {}; errmap merge STORE lists them",
                      data::QuotedName(name),
                      data::PrintablePath(arguments.store)));
    }
    if (!found->second.why_failed.empty()) {
      throw data::InputError(fleet::WhyNoMap(name, found->second.why_failed));
    }
    if (named.insert(name).second) asked.push_back(found->second);
  }
  if (asked.empty()) {
    throw data::InputError(data::PrintablePath(arguments.store) +
                           ": no component has a map to deploy");
  }
  return asked;
}

std::string MapText(const fleet::StorePaths& paths,
                    const std::string& model,
                    const Recommended& recommended) {
  if (!model.empty()) return data::ReadFile(model, data::kMostTextOfPrograms);
  const std::string& component = recommended.component;
  std::string text = Unpacked(paths, component, fleet::kMapFile);
  if (!recommended.sha256.empty() && data::Sha256(text) == recommended.sha256) {
    return text;
  }
  throw data::InputError(fmt::format(
      "{} has no recommended map, or it is not the one that was merged: run "
      "errmap merge again, or name one with --model",
      data::QuotedName(component)));
}

// Keeps a text under its hash, which is returned; flushed by the caller.
std::string Keep(const fleet::StorePaths& paths, const std::string& text) {
  std::string sha256 = data::Sha256(text);
  const std::string path = paths.Map(sha256);
  std::error_code ignored;
  const bool is_kept = std::filesystem::exists(path, ignored) &&
                       data::Sha256(data::ReadFile(path)) == sha256;
  if (!is_kept) data::WriteFileUnflushed(path, text);
  return sha256;
}

// A deployment, and what a person is told of it.
struct Deployed {
  fleet::Deployment deployment;
  std::string promised;
  std::string why_not_watched;
  std::vector<std::string> remarks;  // on the map's file
};

Deployed Prepare(const fleet::StorePaths& paths,
                 const std::string& model,
                 const std::string& since,
                 const Recommended& recommended) {
  const std::string map = MapText(paths, model, recommended);
  const models::FittedModel fitted =
      models::ModelFromJson(map, model.empty() ? recommended.component : model);
  if (fitted.target.name != recommended.target) {
    throw data::InputError(
        fmt::format("the map is of {}, the target of {} is {}",
                    data::QuotedName(fitted.target.name),
                    data::QuotedName(recommended.component),
                    data::QuotedName(recommended.target)));
  }
  const bool has_levels = fitted.interval && fitted.interval->levels.size() > 1;
  Deployed deployed{
      .deployment = {.component = recommended.component,
                     .since = since,
                     .map = Keep(paths, map),
                     .model = fitted.name,
                     .promised =
                         fitted.held_out ? fitted.held_out->rmse : stats::kNaN,
                     .within_95 = has_levels
                                      ? fitted.interval->levels[1].half_width
                                      : stats::kNaN},
      .promised = "nothing, since no rows were held out",
      .why_not_watched = models::WhyNotWatched(fitted),
      .remarks = fitted.remarks};
  if (const double promised = deployed.deployment.promised;
      std::isfinite(promised)) {
    deployed.promised =
        report::ErrorText(fitted.target.unit, promised).WithUnit(promised) +
        " RMSE";
  }
  const std::string relations =
      Unpacked(paths, recommended.component, fleet::kRelationsFile);
  if (!relations.empty())
    deployed.deployment.relations = Keep(paths, relations);
  return deployed;
}

// The first to fail ends them all: nobody knows of what was written so far.
std::vector<Deployed> PrepareAll(const fleet::StorePaths& paths,
                                 const std::string& model,
                                 const std::vector<Recommended>& asked) {
  const std::string since = fleet::NowText();
  const std::string folder =
      std::filesystem::path(paths.Map("")).parent_path().string();
  data::PrepareFolder(folder);
  std::vector<Deployed> deployed(asked.size());
  fitting::ParallelFor(0, asked.size(), [&](std::size_t i) {
    deployed[i] = Prepare(paths, model, since, asked[i]);
  });
  data::FlushFileSystemOf(folder);
  return deployed;
}

std::string DeployedText(const fleet::StorePaths& paths,
                         const std::vector<Deployed>& all) {
  if (all.size() == 1) {
    const fleet::Deployment& deployment = all.front().deployment;
    return fmt::format("{}: {} since {}, expected error {}; its file: {}\n",
                       data::Printable(deployment.component),
                       deployment.model,
                       deployment.since,
                       all.front().promised,
                       data::PrintablePath(paths.Map(deployment.map)));
  }
  return fmt::format(
      "{} deployed since {}; their files: {}\n",
      report::Count(std::ssize(all), "map"),
      all.front().deployment.since,
      data::PrintablePath(
          std::filesystem::path(paths.Map("")).parent_path().string()));
}

// What errmap watch will not tell.
void SayNotWatched(const std::vector<Deployed>& all) {
  std::vector<const Deployed*> unwatched;
  for (const Deployed& deployed : all) {
    if (!deployed.why_not_watched.empty()) unwatched.push_back(&deployed);
  }
  if (unwatched.empty()) return;
  const auto others = unwatched.size() - 1;
  Warn(fmt::format("errmap watch will not judge {}{}: {}",
                   data::QuotedName(unwatched[0]->deployment.component),
                   others > 0 ? fmt::format(" and {} more", others) : "",
                   unwatched[0]->why_not_watched));
}

int RunDeploy(const DeployArguments& arguments) {
  if (arguments.all == !arguments.components.empty()) {
    throw UsageError("name components, or --all for every one with a map");
  }
  if (!arguments.model.empty() && arguments.components.size() != 1) {
    throw UsageError("--model is for one component: name only that");
  }
  const fleet::StorePaths paths{arguments.store};
  fleet::ReadFleet(paths);
  const fleet::StoreLock lock(paths);
  fleet::Database store = fleet::OpenStore(paths);
  const std::vector<Deployed> all =
      PrepareAll(paths, arguments.model, Asked(&store, arguments));
  // Files of a newer schema are refused before this; what was written so far
  // nobody knows of.
  fleet::ChangeStore(paths, lock, [&](fleet::Database* copy) {
    for (const Deployed& deployed : all) {
      fleet::WriteDeployment(copy, deployed.deployment);
    }
  });
  PrintFitted(DeployedText(paths, all));
  for (const Deployed& one : all) SayUnless(false, one.remarks);
  SayNotWatched(all);
  return kDone;
}

}  // namespace

void AddDeployCommand(CLI::App* app, Run* run) {
  const Command<DeployArguments> command(
      app, run, "deploy", "Record which map a machine uses from now on");
  AddOption(command, "STORE DIR", command->store)
      .About("Folder with an errmap.sqlite")
      .Required();
  AddOption(command, "COMPONENT NAME", command->components)
      .About("Names of components");
  AddFlag(command, "--all", command->all)
      .About("Every component that has a recommended map");
  AddOption(command, "--model FILE.json", command->model)
      .About("Map to deploy in place of the recommended one");
  SetFooter(
      command,
      R"(The map goes into the store's maps/ with its expected error, and errmap watch
compares new measurements with it. It replaces the map that the component
had. Of several components, either all are deployed or none.
Exit status: 0 done, 2 no such component, 3 no map or no usable store.
Example: errmap deploy fleet "m01/x, down")");
  command.Runs(RunDeploy);
}

}  // namespace errmap::cli
