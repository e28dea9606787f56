#include "cli/report/documents/report_headline.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/tables/result_table.h"
#include "cli/report/words/next_steps.h"
#include "cli/report/words/remark_text.h"
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

void SayGoal(const ReportView& view, const ErrorText& error, Headline* line) {
  const double goal = view.component->goal;
  if (!std::isfinite(goal)) {
    line->goal = "No goal was set; --goal sets one.";
    return;
  }
  const ResultRecord* result = ResultOf(view, view.recommended, view.decisive);
  if (result == nullptr) return;
  line->goal_standing = result->goal_standing;
  const std::string shown = fmt::format("{:g}{}{}",
                                        goal * view.scale,
                                        view.shown_unit.empty() ? "" : " ",
                                        view.shown_unit);
  std::string standing(models::ToString(line->goal_standing));
  standing.front() =
      static_cast<char>(std::toupper(static_cast<unsigned char>(standing[0])));
  line->goal = fmt::format("Goal: RMSE at most {}. {}: {}.",
                           shown,
                           standing,
                           GoalFigures(*result, error));
}

std::string CostWords(const models::RecommendationRecord& advice) {
  std::vector<std::string> parts{
      advice.sensors.empty()
          ? "No temperature sensor"
          : Count(static_cast<long long>(advice.sensors.size()), "sensor"),
      Count(advice.parameters, "parameter")};
  if (std::isfinite(advice.predict_ns)) {
    parts.push_back(fmt::format("{:.0f} ns per prediction", advice.predict_ns));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

// The first of so many that nobody reads them.
std::string SensorWords(std::vector<std::string> sensors) {
  constexpr std::size_t kMostNamed = 12;
  const std::size_t more =
      sensors.size() - std::min(sensors.size(), kMostNamed);
  sensors.resize(sensors.size() - more);
  return fmt::format("{}{}",
                     fmt::join(sensors, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
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
    const ModelRecord* model = ModelOf(view, view.recommended);
    const double other = model == nullptr ? models::kNotKnown
                                          : TestRmse(*model, view.neighbours);
    if (std::isfinite(other)) {
      line.beside =
          fmt::format("{} under {}", error.WithUnit(other), view.neighbours);
      if (view.decisive_is_unseen) line.beside += ", next to known rows";
    }
    SayGoal(view, error, &line);
    line.cost = CostWords(advice);
    line.sensors = SensorWords(SensorsByNeed(advice));
    line.sentence = advice.sentence;
    // With the recommendation three sentences, and what bounds a figure that is
    // of no other day: all others stand with the reasons.
    constexpr std::size_t kMostTold = 2;
    line.told = view.component->data.doubts;
    for (const models::RemarkRecord* remark : ToldFirst(advice)) {
      // The goal has a line of its own.
      if (remark->kind == models::RemarkKind::kGoal) continue;
      if (line.told.size() >= kMostTold && !BoundsAnotherDay(remark->kind)) {
        continue;
      }
      line.told.push_back(remark->text);
      // What it costs names them already, where they are few.
      if (remark->kind == models::RemarkKind::kCost &&
          advice.sensors.size() <= kMostSensorsNamed) {
        line.sensors.clear();
      }
    }
    line.reasons = TextsOf(advice.grounds);
    line.caveats = TextsOf(advice.doubts);
  }
  if (line.sentence.empty()) line.sentence = FallbackSentence(view, line);
  return line;
}

}  // namespace errmap::report
