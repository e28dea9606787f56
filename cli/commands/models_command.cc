#include <string>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/report/table.h"
#include "cli/report/wrap_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "data/throwing_as.h"
#include "models/recipe_catalog.h"

namespace errmap::cli {
namespace {

std::string ListText(std::size_t width) {
  report::Table table{.columns = {{.name = "model", .is_number = false},
                                  {.name = "what it is", .is_number = false}}};
  for (const std::string& type : models::ModelTypes()) {
    table.rows.push_back({type, models::AboutModel(type)});
  }
  table.rows.push_back({"poly:formula=x+x^2+x*t", "the terms as written"});
  table.rows.push_back({"file:model.json", "an existing map, as it is"});
  return report::TerminalTable(table, width) + "\n" +
         report::WrapText(
             "Options follow after colons, as in "
             "net:scg:hidden=60:wfactor=1e-3; errmap models MODEL lists those "
             "of a model.",
             width) +
         "\n";
}

std::string ModelText(const std::string& type, std::size_t width) {
  const std::vector<models::ModelOption> options = models::OptionsOfModel(type);
  std::string text = fmt::format("{}: {}\n", type, models::AboutModel(type));
  if (options.empty()) return text + "It takes no options.\n";
  text += fmt::format(
      "\n{:14}{:12}what it is, and its values\n", "option", "default");
  for (const models::ModelOption& option : options) {
    text += report::Hanging(
        fmt::format("{:13} {:11} ", option.name, option.fallback),
        option.about + ": " + option.values,
        width);
  }
  return text;
}

struct ModelsArguments {
  std::string model;
};

int RunModels(const ModelsArguments& arguments) {
  const std::size_t width = OutputTerminal().columns;
  PrintResult(data::ThrowingAs<UsageError>("", [&] {
    return arguments.model.empty() ? ListText(width)
                                   : ModelText(arguments.model, width);
  }));
  return kDone;
}

}  // namespace

void AddModelsCommand(CLI::App* app, Run* run) {
  const Command<ModelsArguments> command(
      app, run, "models", "List the models, or a model's options");
  AddOption(command, "MODEL", command->model)
      .About("Show the options of this model with their ranges")
      .Value("");
  SetFooter(command, "Example: errmap models net:scg");
  command.Runs(RunModels);
}

}  // namespace errmap::cli
