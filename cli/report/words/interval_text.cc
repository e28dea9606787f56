#include "cli/report/words/interval_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/report/number_text.h"

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
        level.at_least ? " at least" : "");
  }
  if (promise.good_for) {
    text += fmt::format(
        "; good for {} to come, as neighbouring {}s err alike (correlation "
        "{:.2f})",
        Count(*promise.good_for, promise.unit),
        promise.unit,
        promise.lag1.value_or(models::kNotKnown));
  }
  return text;
}

std::string IntervalLine(const models::PromiseRecord& promise,
                         const ErrorText& error) {
  // "cycles", "blocks of rows".
  std::string plural = promise.unit;
  plural.insert(std::min(plural.find(' '), plural.size()), "s");
  return fmt::format("{} ({}: {} {} held out whole)",
                     IntervalText(promise, error),
                     promise.holdout,
                     promise.units,
                     plural);
}

}  // namespace errmap::report
