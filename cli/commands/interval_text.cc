#include "cli/commands/interval_text.h"

#include <algorithm>

#include <fmt/format.h>

namespace errmap::cli {

std::string IntervalText(const models::PredictionInterval& interval,
                         const ErrorText& error) {
  constexpr double kPercent = 100.0;
  std::string text;
  for (const models::PredictionInterval::Level& level : interval.levels) {
    text += fmt::format(
        "{}{:.0f} %{} within {}{}",
        text.empty() ? "" : ", ",
        kPercent * level.coverage,
        text.empty()
            ? fmt::format(" of the errors on an unseen {} lie", interval.unit)
            : "",
        error.WithUnit(level.half_width),
        level.at_least ? " at least" : "");
  }
  // "cycles", "blocks of rows".
  std::string plural = interval.unit;
  plural.insert(std::min(plural.find(' '), plural.size()), "s");
  return fmt::format("{} ({}: {} {} held out whole)",
                     text,
                     interval.holdout,
                     interval.units,
                     plural);
}

}  // namespace errmap::cli
