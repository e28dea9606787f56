#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands/fleet/fleet_commands.h"
#include "cli/fleet/store/deployments.h"
#include "cli/fleet/store/gzip.h"
#include "cli/fleet/store/store.h"
#include "cli/report/number_text.h"
#include "cli/shell/standard_streams.h"
#include "data/atomic_file.h"
#include "data/input_error.h"
#include "data/prepare_folder.h"
#include "data/sha256.h"
#include "data/text.h"
#include "models/model_file.h"

namespace errmap::cli {
namespace {

struct DeployArguments {
  std::string store;
  std::string component;
  std::string model;
};

// A packed file of a component, "" where there is none.
std::string Unpacked(const fleet::StorePaths& paths,
                     const std::string& component,
                     const char* file) {
  const std::string path = paths.InFolder(component, file);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return "";
  try {
    return fleet::Gunzip(data::ReadFile(path), data::kMostTextOfPrograms);
  } catch (const data::InputError& error) {
    throw data::InputError(data::PrintablePath(path) + ": " + error.what());
  }
}

// What the component's map is by the store: its target and its file's hash.
struct Recommended {
  std::string target;
  std::string sha256;
};
Recommended FindComponent(fleet::Database* store,
                          const DeployArguments& arguments) {
  fleet::Statement row = store->Prepare(
      "SELECT target, maps.sha256, why FROM components LEFT JOIN maps ON "
      "component = name WHERE name = ?");
  row.With(arguments.component);
  if (row.Next()) {
    const std::string why = row.Text(2);
    if (!why.empty()) {
      throw data::InputError(fleet::WhyNoMap(arguments.component, why));
    }
    return {.target = row.Text(0), .sha256 = row.Text(1)};
  }
  throw UsageError(fmt::format(
      "no component {} in {}; errmap query STORE \"SELECT name FROM "
      "components\" lists them",
      data::QuotedName(arguments.component),
      data::PrintablePath(arguments.store)));
}

std::string MapText(const fleet::StorePaths& paths,
                    const DeployArguments& arguments,
                    const Recommended& recommended) {
  if (!arguments.model.empty()) {
    return data::ReadFile(arguments.model, data::kMostTextOfPrograms);
  }
  const std::string text =
      Unpacked(paths, arguments.component, fleet::kMapFile);
  if (!recommended.sha256.empty() && data::Sha256(text) == recommended.sha256) {
    return text;
  }
  throw data::InputError(fmt::format(
      "{} has no recommended map, or it is not the one that was merged: run "
      "errmap merge again, or name one with --model",
      data::QuotedName(arguments.component)));
}

fleet::Deployment DeploymentOf(const DeployArguments& arguments,
                               const models::FittedModel& fitted) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const bool has_levels = fitted.interval && fitted.interval->levels.size() > 1;
  return {
      .component = arguments.component,
      .since = fleet::NowText(),
      .model = fitted.name,
      .promised = fitted.held_out ? fitted.held_out->rmse : kNaN,
      .within_95 = has_levels ? fitted.interval->levels[1].half_width : kNaN,
      .shown_unit = fitted.target.unit.display_symbol,
      .shown_scale = fitted.target.unit.display_scale};
}

int RunDeploy(const DeployArguments& arguments) {
  const fleet::StorePaths paths{arguments.store};
  fleet::ReadFleet(paths);
  const fleet::StoreLock lock(paths);
  fleet::Database store = fleet::OpenStore(paths);
  const Recommended recommended = FindComponent(&store, arguments);
  const std::string map = MapText(paths, arguments, recommended);
  const models::FittedModel fitted = models::ModelFromJson(
      map, arguments.model.empty() ? arguments.component : arguments.model);
  if (fitted.target.name != recommended.target) {
    throw data::InputError(
        fmt::format("the map is of {}, the component's target is {}",
                    data::QuotedName(fitted.target.name),
                    data::QuotedName(recommended.target)));
  }
  fleet::Deployment deployment = DeploymentOf(arguments, fitted);
  deployment.map = data::Sha256(map);
  const auto keep = [&](const std::string& text) {
    const std::string path = paths.Map(data::Sha256(text));
    data::PrepareFolder(std::filesystem::path(path).parent_path().string());
    data::WriteFileAtomically(path, text);
  };
  keep(map);
  const std::string relations =
      Unpacked(paths, arguments.component, fleet::kRelationsFile);
  if (!relations.empty()) {
    deployment.relations = data::Sha256(relations);
    keep(relations);
  }
  // Files of a newer schema are refused before this; what was written so far
  // nobody knows of.
  fleet::ChangeStore(paths, lock, [&](fleet::Database* copy) {
    fleet::WriteDeployment(copy, deployment);
  });
  const report::ErrorText error(fitted.target.unit, deployment.promised);
  PrintResult(fmt::format(
      "{}: {} since {}, promised {}; its file: {}\n",
      data::Printable(arguments.component, arguments.component.size()),
      fitted.name,
      deployment.since,
      std::isfinite(deployment.promised)
          ? error.WithUnit(deployment.promised) + " RMSE"
          : "nothing, since no rows were held out",
      data::PrintablePath(paths.Map(deployment.map))));
  return kDone;
}

}  // namespace

void AddDeployCommand(CLI::App* app, Run* run) {
  auto arguments = std::make_shared<DeployArguments>();
  CLI::App* command = app->add_subcommand(
      "deploy", "Write down which map a machine has from now on");
  command->add_option("STORE", arguments->store, "Folder with an errmap.sqlite")
      ->required()
      ->type_name("DIR");
  command->add_option("COMPONENT", arguments->component, "Its name")
      ->required()
      ->type_name("NAME");
  command
      ->add_option("--model",
                   arguments->model,
                   "Map to deploy in place of the recommended one")
      ->type_name("FILE.json");
  command->footer(
      "The map is kept in the store's maps/ with what it promised, and errmap "
      "watch holds new\nmeasurements against it. What the component had before "
      "is ended.\nExit status: 0 done, 2 no such component, 3 no map, no "
      "store, or one of a newer errmap.\nExample: errmap deploy fleet \"m01/x, "
      "down\"");
  command->callback([arguments, run] { run->status = RunDeploy(*arguments); });
}

}  // namespace errmap::cli
