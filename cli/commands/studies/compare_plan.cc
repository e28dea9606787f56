#include <algorithm>
#include <array>
#include <set>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/studies/compare_arguments.h"
#include "data/text.h"
#include "data/throwing_as.h"
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
    specs = SplitFlag("--models", arguments.model_list);
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

study_setup::StudyFile ReadChanged(const CompareArguments& arguments) {
  return data::ThrowingAs<UsageError>("", [&] {
    return study_setup::ReadStudyFile(arguments.config, arguments.changes);
  });
}

// Flags of one component that are not keys of study files.
constexpr std::array kFilesOfOne = {"--split", "--save-split", "--predictions"};

// Puts what was given on the command line in the place of what a file says;
// both are visited in one order.
template <typename ForOptions, typename Config>
void Override(const std::set<std::string>& given,
              const ForOptions& for_options,
              const Config& flags,
              Config* config) {
  for_options(flags,
              [&]<typename Member>(const study_setup::StudyOption& option,
                                   const Member& said,
                                   const auto&... /*values*/) {
                if (!given.contains(FlagOf(option.key))) return;
                for_options(
                    *config,
                    [&]<typename Other>(const study_setup::StudyOption& other,
                                        Other& member,
                                        const auto&... /*values*/) {
                      if constexpr (std::is_same_v<Member, Other>) {
                        if (std::string_view(other.key) == option.key)
                          member = said;
                      }
                    });
              });
}

}  // namespace

study_setup::StudyConfig ConfigOf(const CompareArguments& arguments) {
  CheckHoldouts(arguments.holdouts);
  const DataArguments& data = arguments.data;
  study_setup::ComponentConfig component;
  if (!data.files.empty()) {
    component.data = data.files.front();
    component.more_data.assign(data.files.begin() + 1, data.files.end());
  }
  component.selection = data.selection;
  component.split = arguments.split;
  component.save_split = arguments.save_split;
  component.predictions = arguments.predictions;
  std::vector<std::string> specs = ModelSpecs(arguments);
  for (const study_setup::PredictionsFile& predictions :
       component.predictions) {
    if (std::ranges::find(specs, predictions.name) != specs.end() ||
        std::ranges::count(component.predictions,
                           predictions.name,
                           &study_setup::PredictionsFile::name) > 1) {
      throw UsageError("two models are named " + predictions.name +
                       "; give the --predictions another name");
    }
  }
  study_setup::StudyConfig config = arguments.study;
  config.holdouts = arguments.holdouts;
  config.models = std::move(specs);
  config.components = {std::move(component)};
  return config;
}

std::vector<std::string> GivenOfFewer(const CompareArguments& arguments,
                                      study_setup::Reach reach) {
  std::vector<std::string> flags;
  const auto add = [&](const std::string& flag) {
    if (arguments.given.contains(flag)) flags.push_back(flag);
  };
  study_setup::ForSelectionOptions(
      arguments.data.selection,
      [&](const study_setup::StudyOption& option, const auto&... /*said*/) {
        if (option.reach < reach) add(FlagOf(option.key));
      });
  for (const char* flag : kFilesOfOne) add(flag);
  return flags;
}

study_setup::StudyFile ConfigOfFile(const CompareArguments& arguments) {
  const auto given = [&](const char* flag) {
    return arguments.given.contains(flag);
  };
  if (given("DATA")) {
    throw UsageError(
        "DATA and --config exclude each other; the study file names its data");
  }
  study_setup::StudyFile file = ReadChanged(arguments);
  study_setup::StudyConfig& config = file.config;
  const study_setup::StudyConfig flags = ConfigOf(arguments);
  if (given("--seed")) config.seed = flags.seed;
  if (given("--holdout")) config.holdouts = flags.holdouts;
  if (given("--models") || given("--model")) config.models = flags.models;
  const auto of_study = [](auto& of, const auto& visit) {
    study_setup::ForStudyOptions(of, visit);
  };
  const auto of_component = [](auto& of, const auto& visit) {
    study_setup::ForComponentOptions(of, visit);
  };
  Override(arguments.given, of_study, flags, &config);
  if (config.components.size() != 1) {
    for (const std::string& flag :
         GivenOfFewer(arguments, study_setup::Reach::kAll)) {
      throw UsageError(
          fmt::format("{} is for one component, and {} has {}; write --set "
                      "component.0.KEY=VALUE",
                      flag,
                      data::PrintablePath(arguments.config),
                      config.components.size()));
    }
  }
  study_setup::ComponentConfig from = flags.components.front();
  from.goal = flags.goal;
  from.indifference = flags.indifference;
  for (study_setup::ComponentConfig& component : config.components) {
    Override(arguments.given, of_component, from, &component);
    if (given("--split")) component.split = from.split;
    if (given("--save-split")) component.save_split = from.save_split;
    if (given("--predictions")) component.predictions = from.predictions;
  }
  return file;
}

study_setup::StudyPlan PlanOf(const CompareArguments& arguments,
                              const study_setup::MakeOwnRecipes& own) {
  for (const auto& mode : arguments.modes) {
    if (auto plan = mode->Plan(arguments, own)) return *std::move(plan);
  }
  const study_setup::Remark remark = Sayer(arguments.data.quiet);
  if (arguments.config.empty()) {
    if (!arguments.given.contains("DATA")) {
      throw UsageError("compare: DATA is required; see errmap compare --help");
    }
    if (!arguments.changes.empty()) {
      throw UsageError("--set changes a study file; name it with --config");
    }
    return study_setup::PlanStudy(ConfigOf(arguments), remark, own);
  }
  return study_setup::PlanStudy(ConfigOfFile(arguments), remark, own);
}

}  // namespace errmap::cli
