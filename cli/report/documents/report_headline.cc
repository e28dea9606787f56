#include "cli/report/documents/report_headline.h"

#include <cmath>

#include <fmt/format.h>

#include "cli/report/tables/result_table.h"
#include "cli/report/words/verdict_text.h"

namespace errmap::report {

const char* const kSignConvention =
    "Error = actual - nominal: compensate by minus the predicted error. "
    "Residual = measured - predicted error.";

namespace {

void SayError(const models::RecommendationRecord& advice,
              const ErrorText& error,
              Headline* line) {
  if (!std::isfinite(advice.rmse)) return;
  line->error = error.WithUnit(advice.rmse);
  if (std::isfinite(advice.ci95[0]) && std::isfinite(advice.ci95[1])) {
    line->interval = fmt::format("95 % interval {} to {}",
                                 error(advice.ci95[0]),
                                 error.WithUnit(advice.ci95[1]));
  }
}

std::vector<std::string> TextsOf(
    const std::vector<models::RemarkRecord>& remarks) {
  std::vector<std::string> texts;
  for (const models::RemarkRecord& remark : remarks) {
    if (!remark.text.empty()) texts.push_back(remark.text);
  }
  return texts;
}

// Who reads the figure alone must not take it for one of another day.
bool BoundsAnotherDay(models::RemarkKind kind) {
  switch (kind) {
    case models::RemarkKind::kInterrupted:
    case models::RemarkKind::kOneRunOnly:
    case models::RemarkKind::kGroupFitsFailed:
    case models::RemarkKind::kNoGroupsHeldOut:
    case models::RemarkKind::kNoGroups:
    case models::RemarkKind::kFewSessions:
      return true;
    default:
      return false;
  }
}

std::string FallbackSentence(const ReportView& view, const Headline& line) {
  if (view.recommended.empty()) {
    return "No map can be recommended: no model was fitted and judged.";
  }
  return fmt::format(
      "Use {}.{}",
      view.recommended,
      line.error.empty()
          ? ""
          : fmt::format(" Expect {} {}.", line.error, line.where));
}

}  // namespace

Headline HeadlineOf(const ReportView& view) {
  Headline line;
  const ErrorText error = ErrorTextOf(view);
  line.where = fmt::format("RMSE, {} ({})", UnseenWords(view), view.decisive);
  if (view.component->recommendation) {
    const models::RecommendationRecord& advice =
        *view.component->recommendation;
    SayError(advice, error, &line);
    line.goal_standing = advice.goal_standing;
    if (!std::isfinite(view.component->goal)) {
      line.goal = "No goal was set; --goal sets one.";
    }
    line.sentence = advice.sentence;
    // With the recommendation three sentences, and what bounds a figure that is
    // of no other day: all others stand with the reasons.
    constexpr std::size_t kMostTold = 2;
    line.told = view.component->data.doubts;
    for (const models::RemarkRecord* remark : ToldFirst(advice)) {
      if (remark->kind == models::RemarkKind::kGoal) {
        line.goal = remark->text;  // has a line of its own
        continue;
      }
      if (line.told.size() >= kMostTold && !BoundsAnotherDay(remark->kind)) {
        continue;
      }
      line.told.push_back(remark->text);
    }
    line.reasons = TextsOf(advice.grounds);
    line.caveats = TextsOf(advice.doubts);
  }
  if (line.sentence.empty()) line.sentence = FallbackSentence(view, line);
  return line;
}

}  // namespace errmap::report
