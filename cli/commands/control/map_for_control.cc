#include "cli/commands/control/map_for_control.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/shell/command_options.h"
#include "data/text.h"
#include "models/history/with_history.h"

namespace errmap::cli {

void AddEveryOption(CLI::App* command, std::string* every) {
  AddOption(command, "--every TIME", *every)
      .About(
          "Time between rows, for a map whose memory counts rows: 30s, 2min");
}

models::FittedModel LoadForControl(const std::string& file,
                                   const std::string& every,
                                   bool quiet) {
  models::FittedModel map = LoadMap(file, quiet);
  if (every.empty()) return map;
  const std::optional<double> seconds = data::ParseInterval(every);
  if (!seconds) {
    throw UsageError(
        fmt::format("--every must be a time such as 30s or 2min; found {}",
                    data::QuotedText(every)));
  }
  if (!models::CountsRows(map)) {
    throw UsageError(fmt::format(
        "--every is for a map whose memory counts rows; that of {} does not",
        data::PrintablePath(file)));
  }
  // What is written says what it was made for.
  map.name += " with a row every " + every;
  return models::WithRowsEvery(std::move(map), *seconds);
}

}  // namespace errmap::cli
