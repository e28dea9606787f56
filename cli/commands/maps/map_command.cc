#include "cli/commands/maps/map_command.h"

#include "cli/desk/provenance.h"
#include "cli/shell/command_options.h"

namespace errmap::cli {

CLI::App* AddMapCommand(CLI::App* app,
                        const char* name,
                        const char* about,
                        std::string* model) {
  CLI::App* command = AddCommand(app, name, about);
  AddOption(command, "MODEL FILE.json", *model, "Model file").Required();
  return command;
}

Json MapAnswerJson(const char* schema,
                   const models::FittedModel& fitted,
                   const std::vector<std::string>& files) {
  return {{"schema", schema},
          {"model", fitted.name},
          {"file", desk::ShownNames(files)},
          {"target", fitted.target.name},
          {"unit", fitted.target.unit.symbol}};
}

}  // namespace errmap::cli
