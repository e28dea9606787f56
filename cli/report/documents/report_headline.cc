#include "cli/report/documents/report_headline.h"

#include <cmath>

namespace errmap::report {

const char* const kSignConvention =
    "Error = actual - nominal: compensate by minus the predicted error. "
    "Residual = measured - predicted error.";

namespace {

std::vector<std::string> TextsOf(
    const std::vector<models::RemarkRecord>& remarks) {
  std::vector<std::string> texts;
  for (const models::RemarkRecord& remark : remarks) {
    if (!remark.text.empty()) texts.push_back(remark.text);
  }
  return texts;
}

}  // namespace

Headline HeadlineOf(const ReportView& view) {
  Headline line;
  line.answer = FirstAnswerOf(*view.component);
  if (!view.component->recommendation) return line;
  const models::RecommendationRecord& advice = *view.component->recommendation;
  if (std::isfinite(advice.rmse)) {
    line.error = ErrorTextOf(view).WithUnit(advice.rmse);
  }
  line.goal_standing = advice.goal_standing;
  line.reasons = TextsOf(advice.grounds);
  line.caveats = TextsOf(advice.doubts);
  return line;
}

}  // namespace errmap::report
