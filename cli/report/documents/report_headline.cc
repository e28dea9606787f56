#include <cmath>

#include "cli/report/documents/report_html.h"

namespace errmap::report {

const char* const kSignConvention =
    "Error = actual - nominal; the compensation is minus the predicted error. "
    "Residual = measured - predicted error.";

Headline HeadlineOf(const ReportView& view) {
  Headline line;
  line.answer = FirstAnswerOf(*view.component);
  if (!view.component->recommendation) return line;
  const models::RecommendationRecord& advice = *view.component->recommendation;
  if (std::isfinite(advice.rmse)) {
    line.error = ErrorTextOf(view).WithUnit(advice.rmse);
  }
  line.goal_standing = advice.goal_standing;
  for (const Remark& remark : RemarksOf(ComponentNumbers(*view.component))) {
    if (remark.place == Remark::Place::kAnswer) continue;
    (remark.is_caveat ? line.caveats : line.reasons)
        .push_back(SentenceOf(remark));
  }
  return line;
}

}  // namespace errmap::report
