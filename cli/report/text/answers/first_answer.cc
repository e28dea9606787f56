#include "cli/report/text/answers/first_answer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "cli/report/report_view.h"
#include "cli/report/wrap_text.h"
#include "data/text.h"
#include "models/study/judgement/recommendation.h"

namespace errmap::report {
namespace {

using models::HoldoutRecord;
using models::RecommendationRecord;

std::string Use(const models::ComponentRecord& record) {
  const RecommendationRecord& advice = *record.recommendation;
  if (advice.model == "zero") return "Do not compensate: no map does better.";
  if (advice.choice == models::Choice::kBaseline) {
    return fmt::format(
        "Use {}: {}.",
        advice.model,
        std::ranges::all_of(record.models, &ModelRecord::baseline)
            ? "only simple maps were compared"
            : "no richer map is proven better");
  }
  return fmt::format(
      "Use {}{}.", advice.model, advice.single ? ", an average of maps" : "");
}

// "another day", "unseen cycles": where the error was measured.
std::string WhereMeasured(const HoldoutRecord& holdout) {
  if (IsOfLaterUnits(holdout)) return "later " + PluralOfUnit(holdout);
  if (holdout.whole_sessions) return "another " + holdout.unit_of_analysis;
  if (holdout.whole_groups) return "unseen " + PluralOfUnit(holdout);
  if (holdout.among_neighbours) return "between rows";
  return holdout.another_file ? "another file" : "unseen rows";
}

// Why the error of the recommended map has no range. Where other maps have
// one, it is that map's errors, not the number of units.
std::string WhyNoRange(const ComponentNumbers& of,
                       const HoldoutRecord& holdout) {
  const bool others_have_one =
      std::ranges::any_of(of.record.models, [&](const ModelRecord& model) {
        const ResultRecord* const result = ResultOf(model, holdout.name);
        return result != nullptr && std::isfinite(result->ci95[0]);
      });
  if (others_have_one) {
    return fmt::format(
        " (no 95 % range: its errors on neighbouring {} may be alike)",
        PluralOfUnit(holdout));
  }
  return fmt::format(" ({} are too few or too alike for a range)",
                     of.CountOfHeldOut(holdout.units, holdout));
}

Remark ErrorOf(const ComponentNumbers& of) {
  // From so many on only units that resemble their neighbours give no range.
  constexpr std::int64_t kFewestForRange = 3;
  const HoldoutRecord& holdout = of.HoldoutOfAdvice();
  const ResultRecord& result =
      of.Result(of.Advice().model, of.Advice().holdout);
  const auto& [low, high] = result.ci95;
  std::string text = of.RmseWithUnit(of.Advice().model) + " RMSE";
  // An interval that reaches below no error at all tells nothing.
  if (std::isfinite(low) && low > 0.0) {
    text += fmt::format(" (95 %: {} to {})", of.error(low), of.error(high));
  } else if (holdout.units >= kFewestForRange && !std::isfinite(low)) {
    text += WhyNoRange(of, holdout);
  }
  text += ", largest " + of.error.WithUnit(std::max(std::abs(result.test.min),
                                                    std::abs(result.test.max)));
  if (holdout.among_neighbours) text += ", next to training rows";
  return {.label = WhereMeasured(holdout),
          .text = std::move(text),
          .must_show = true};
}

std::ptrdiff_t WordsIn(const std::string& text) {
  return 1 + std::ranges::count(text, ' ');
}

FirstAnswer WithoutAMap(const models::ComponentRecord& record) {
  const std::string why =
      record.interrupted ? "the run was interrupted."
      : record.data.rows < models::kFewestRowsToRecommend
          ? fmt::format(
                "{} rows are too few to judge one. Measure {} or more, best "
                "ten cycles on each of six days.",
                record.data.rows,
                models::kFewestRowsToRecommend)
          : "none could be judged.";
  FirstAnswer answer{.use = "No map can be recommended: " + why, .lines = {}};
  for (const std::string& doubt : record.data.doubts) {
    answer.lines.push_back({.label = "check the data",
                            .text = doubt,
                            .tone = Remark::Tone::kBad,
                            .must_show = true});
  }
  return answer;
}

}  // namespace

FirstAnswer FirstAnswerOf(const models::ComponentRecord& record) {
  if (!record.recommendation) return WithoutAMap(record);
  const ComponentNumbers numbers(record);
  FirstAnswer answer{.use = Use(record), .lines = {ErrorOf(numbers)}};
  for (Remark& remark : RemarksOf(numbers)) {
    if (remark.place != Remark::Place::kAnswer) continue;
    answer.lines.push_back(std::move(remark));
  }
  return answer;
}

std::string FirstAnswer::Sentence() const {
  return lines.empty() ? use : use + " " + SentenceOf(lines.front());
}

std::vector<std::string> LabelledLines(const Remark& remark,
                                       std::size_t width) {
  constexpr std::size_t kIndent = 19;  // two blanks, a label, two blanks
  std::string begin = fmt::format("  {:<15}  ", remark.label);
  std::vector<std::string> lines;
  for (const std::string& text :
       WrapLines(data::Printable(remark.text),
                 width > 2 * kIndent ? width - kIndent : width)) {
    lines.push_back(begin + text);
    begin.assign(kIndent, ' ');
  }
  return lines;
}

ShownAnswer AnswerLines(const FirstAnswer& answer,
                        std::size_t width,
                        const std::vector<std::string>& above) {
  ShownAnswer shown{.lines = WrapLines(answer.use, width), .left_out = {}};
  // Ten seconds of reading.
  constexpr std::size_t kMostLines = 12;
  constexpr std::ptrdiff_t kMostWords = 110;
  std::size_t all_lines = above.size() + shown.lines.size();
  std::ptrdiff_t all_words = WordsIn(answer.use);
  for (const std::string& line : above) all_words += WordsIn(line);
  std::vector<bool> taken;
  for (const bool must_show : {true, false}) {
    for (std::size_t i = 0; i < answer.lines.size(); ++i) {
      const Remark& remark = answer.lines[i];
      if (must_show) taken.push_back(remark.must_show);
      if (remark.must_show != must_show) continue;
      const std::size_t lines = LabelledLines(remark, width).size();
      const auto words = WordsIn(remark.label) + WordsIn(remark.text);
      taken[i] = must_show || (all_lines + lines <= kMostLines &&
                               all_words + words <= kMostWords);
      if (!taken[i]) continue;
      all_lines += lines;
      all_words += words;
    }
  }
  for (std::size_t i = 0; i < answer.lines.size(); ++i) {
    if (!taken[i]) {
      shown.left_out.push_back(answer.lines[i]);
      continue;
    }
    for (std::string& line : LabelledLines(answer.lines[i], width)) {
      shown.lines.push_back(std::move(line));
    }
  }
  return shown;
}

}  // namespace errmap::report
