#include "cli/commands/maps/map_command.h"

#include "cli/desk/provenance.h"
#include "cli/shell/command_options.h"

namespace errmap::cli {

void AddModelArgument(CLI::App* command, std::string* model) {
  AddOption(command, "MODEL FILE.json", *model, "Model file").Required();
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
