#include "cli/commands/studies/compare_plan.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/report/shell_word.h"
#include "data/input_error.h"
#include "data/text.h"
#include "models/model_spec.h"
#include "stats/holdout.h"

namespace errmap::cli {
namespace {

// The words before the colon.
std::vector<std::string> HoldoutNames() {
  std::vector<std::string> names;
  for (const stats::HoldoutForm& form : stats::HoldoutForms()) {
    const std::string text(form.form);
    names.push_back(text.substr(0, text.find_first_of(":[")));
  }
  return names;
}

// What the command line alone can get wrong is said before any file is read.
void CheckHoldouts(const std::vector<std::string>& texts) {
  std::set<std::string> seen;
  for (const std::string& text : texts) {
    if (!seen.insert(text).second) {
      throw UsageError("--holdout " + text + " is given twice");
    }
    try {
      stats::ParseHoldout(text);
    } catch (const std::invalid_argument& error) {
      const std::string nearest =
          data::NearestName(text.substr(0, text.find(':')), HoldoutNames());
      throw UsageError(
          nearest.empty() || text.starts_with(nearest)
              ? error.what()
              : fmt::format("{}; did you mean {}?", error.what(), nearest));
    }
  }
}

std::vector<std::string> ModelSpecs(const CompareArguments& arguments) {
  std::vector<std::string> specs;
  if (!arguments.model_list.empty()) {
    try {
      specs = models::SplitList(arguments.model_list);
    } catch (const std::invalid_argument& error) {
      throw UsageError(fmt::format("--models: {}", error.what()));
    }
  }
  specs.insert(specs.end(), arguments.models.begin(), arguments.models.end());
  std::set<std::string> seen;
  for (const std::string& spec : specs) {
    if (!seen.insert(spec).second) {
      throw UsageError("model " + spec + " is given twice");
    }
    RecipeFromArgument(spec);
  }
  return specs;
}

// Without a study file the command line asks for one component.
desk::StudyConfig ConfigOf(const CompareArguments& arguments) {
  const desk::GivenError goal = ErrorOfFlag("--goal", arguments.goal, false);
  const desk::GivenError indifference =
      ErrorOfFlag("--indifference", arguments.indifference, true);
  CheckHoldouts(arguments.holdouts);
  if (!arguments.rezero.empty()) {
    try {
      desk::CheckRezero(arguments.rezero);
    } catch (const std::invalid_argument& error) {
      throw UsageError(fmt::format("--rezero {}", error.what()));
    }
  }
  const DataArguments& data = arguments.data;
  desk::ComponentConfig component;
  component.data = data.file;
  component.selection = data.selection;
  component.split = arguments.split;
  component.save_split = arguments.save_split;
  component.predictions = arguments.predictions;
  std::vector<std::string> specs = ModelSpecs(arguments);
  for (const desk::PredictionsFile& predictions : component.predictions) {
    if (std::ranges::find(specs, predictions.name) != specs.end() ||
        std::ranges::count(component.predictions,
                           predictions.name,
                           &desk::PredictionsFile::name) > 1) {
      throw UsageError("two models are named " + predictions.name +
                       "; give the --predictions another name");
    }
  }
  return {.seed = arguments.seed,
          .goal = goal,
          .indifference = indifference,
          .choose = arguments.choose,
          .prefer = arguments.prefer,
          .holdouts = arguments.holdouts,
          .models = std::move(specs),
          .rezero = arguments.rezero,
          .components = {std::move(component)}};
}

desk::StudyFile ReadChanged(const CompareArguments& arguments) {
  try {
    return desk::ReadStudyFile(arguments.config, arguments.changes);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

// Of how many components the word of a flag may be true.
enum class Reach {
  kOne,
  kMachine,  // one, or all of a machine
  kAll,
};

// A flag that says something of components, and takes its word to them.
struct ComponentFlag {
  const char* name;
  Reach reach;
  void (*copy)(const desk::ComponentConfig& from, desk::ComponentConfig* to);
};

template <auto kMember>
void Copy(const desk::ComponentConfig& from, desk::ComponentConfig* to) {
  if constexpr (requires { to->*kMember; }) {
    to->*kMember = from.*kMember;
  } else {
    to->selection.*kMember = from.selection.*kMember;
  }
}

const std::vector<ComponentFlag>& ComponentFlags() {
  using desk::ComponentConfig;
  using Selection = data::DatasetSelection;
  static const std::vector<ComponentFlag> flags = {
      {"--target", Reach::kOne, Copy<&Selection::target>},
      {"--inputs", Reach::kOne, Copy<&Selection::inputs>},
      {"--exclude", Reach::kMachine, Copy<&Selection::exclude>},
      {"--group", Reach::kMachine, Copy<&Selection::group>},
      {"--time", Reach::kMachine, Copy<&Selection::time>},
      {"--session", Reach::kMachine, Copy<&Selection::session>},
      {"--weight", Reach::kOne, Copy<&Selection::weight>},
      {"--split", Reach::kOne, Copy<&ComponentConfig::split>},
      {"--save-split", Reach::kOne, Copy<&ComponentConfig::save_split>},
      {"--predictions", Reach::kOne, Copy<&ComponentConfig::predictions>},
      {"--align", Reach::kAll, Copy<&Selection::align>},
      {"--missing", Reach::kAll, Copy<&Selection::missing>},
      {"--faults", Reach::kAll, Copy<&Selection::faults>},
      {"--keep-dead", Reach::kAll, Copy<&Selection::keep_dead>}};
  return flags;
}

// A folder of files is a study, of which somebody must say what belongs
// together.
void RefuseFolder(const std::string& data) {
  if (!std::filesystem::is_directory(data)) return;
  const std::string folder = data::PrintablePath(data);
  throw data::InputError(fmt::format(
      "{}: is a folder; name one CSV file in it, or have a study of all of "
      "them proposed: errmap init {} -o study.toml, then errmap compare "
      "--config study.toml --out STUDY",
      folder,
      report::ShellWord(folder)));
}

}  // namespace

desk::StudyFile ConfigOfFile(const CompareArguments& arguments) {
  const auto given = [&](const char* flag) {
    return arguments.given.contains(flag);
  };
  if (given("DATA")) {
    throw UsageError(
        "DATA and --config exclude each other; the study file names its data");
  }
  desk::StudyFile file = ReadChanged(arguments);
  desk::StudyConfig& config = file.config;
  const desk::StudyConfig flags = ConfigOf(arguments);
  if (given("--seed")) config.seed = flags.seed;
  if (given("--goal")) {
    config.goal = flags.goal;
    for (desk::ComponentConfig& component : config.components) {
      component.goal = flags.goal;
    }
  }
  if (given("--indifference")) {
    config.indifference = flags.indifference;
    for (desk::ComponentConfig& component : config.components) {
      component.indifference = flags.indifference;
    }
  }
  if (given("--choose")) config.choose = flags.choose;
  if (given("--prefer")) config.prefer = flags.prefer;
  if (given("--holdout")) config.holdouts = flags.holdouts;
  if (given("--rezero")) config.rezero = flags.rezero;
  if (given("--models") || given("--model")) config.models = flags.models;
  const desk::ComponentConfig& from = flags.components.front();
  for (const ComponentFlag& flag : ComponentFlags()) {
    if (!given(flag.name)) continue;
    if (flag.reach != Reach::kAll && config.components.size() != 1) {
      throw UsageError(
          fmt::format("{} is for one component, and {} has {}; write --set "
                      "component.0.KEY=VALUE",
                      flag.name,
                      data::PrintablePath(arguments.config),
                      config.components.size()));
    }
    for (desk::ComponentConfig& component : config.components) {
      flag.copy(from, &component);
    }
  }
  return file;
}

std::optional<desk::MachineStudy> MachineOf(const CompareArguments& arguments) {
  if (arguments.machine.empty()) {
    if (arguments.given.contains("--later")) {
      throw UsageError("--later goes with --machine");
    }
    return std::nullopt;
  }
  std::vector<const char*> of_one = {"--config", "--rezero"};
  for (const ComponentFlag& flag : ComponentFlags()) {
    if (flag.reach == Reach::kOne) of_one.push_back(flag.name);
  }
  for (const char* flag : of_one) {
    if (arguments.given.contains(flag)) {
      throw UsageError(fmt::format(
          "{} is for one component, and --machine has several", flag));
    }
  }
  if (!arguments.given.contains("DATA")) {
    throw UsageError(
        "--machine needs the folder of its components' data: errmap compare "
        "--machine machine.toml DIR");
  }
  return desk::ReadMachineStudy(arguments.machine,
                                arguments.data.file,
                                arguments.later,
                                arguments.data.selection.session);
}

desk::StudyPlan PlanOf(const CompareArguments& arguments,
                       const std::optional<desk::MachineStudy>& machine) {
  const desk::Remark remark = Sayer(arguments.data.quiet);
  if (machine) {
    return desk::PlanOfMachine(*machine, ConfigOf(arguments), remark);
  }
  if (arguments.config.empty()) {
    if (!arguments.given.contains("DATA")) {
      throw UsageError("DATA is required; see errmap --help");
    }
    if (!arguments.changes.empty()) {
      throw UsageError("--set changes a study file; name it with --config");
    }
    RefuseFolder(arguments.data.file);
    return desk::PlanStudy(ConfigOf(arguments), remark);
  }
  return desk::PlanStudy(ConfigOfFile(arguments), remark);
}

}  // namespace errmap::cli
