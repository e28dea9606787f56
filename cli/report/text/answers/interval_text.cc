#include "cli/report/text/answers/interval_text.h"

#include <fmt/format.h>

#include "cli/report/text/answers/component_numbers.h"

namespace errmap::report {

std::string IntervalText(const models::PromiseRecord& promise,
                         const ErrorText& error) {
  std::string text;
  for (const models::PromiseLevelRecord& level : promise.levels) {
    text += fmt::format(
        "{}{:.0f} %{} within {}{}",
        text.empty() ? "" : ", ",
        kPercent * level.coverage,
        text.empty()
            ? fmt::format(" of the errors on an unseen {} lie", promise.unit)
            : "",
        error.WithUnit(level.half_width),
        level.at_least ? " or more" : "");
  }
  if (promise.good_for) {
    text += fmt::format(
        ". Trust this for the next {} only: neighbouring {} may err alike "
        "(lag-1 autocorrelation {:.2f})",
        *promise.good_for == 1 ? promise.unit
                               : Count(*promise.good_for, promise.unit),
        PluralOf(promise.unit),
        promise.lag1.value_or(models::kNotKnown));
  }
  return text;
}

std::string IntervalLine(const models::PromiseRecord& promise,
                         const ErrorText& error) {
  return fmt::format("{}. Found on {} {} ({})",
                     IntervalText(promise, error),
                     promise.units,
                     PluralOf(promise.unit),
                     promise.holdout);
}

std::string HalfWidthsLine(const models::PredictionInterval& interval,
                           const data::Unit& unit) {
  const models::PredictionInterval::Level& level = interval.levels[0];
  if (!(level.inside < level.outside)) return "";
  const ErrorText error(unit, level.inside);
  return fmt::format(
      "half-width written, {:.0f} %: {} where inside = 1, {} where inside = 0",
      kPercent * level.coverage,
      error.WithUnit(level.inside),
      error.WithUnit(level.outside));
}

}  // namespace errmap::report
