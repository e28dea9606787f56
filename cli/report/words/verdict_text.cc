#include "cli/report/words/verdict_text.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/words/component_numbers.h"
#include "cli/report/words/remark_text.h"
#include "cli/report/words/verdict_sentences.h"
#include "cli/report/wrap_text.h"

namespace errmap::report {
namespace {

using models::FindNamed;
using models::HoldoutRecord;
using models::RecommendationRecord;
using models::RemarkKind;
using models::RemarkRecord;
using models::VerdictRecord;

}  // namespace

const char* const kIntervalCoverage =
    "95 % is nominal: simulated, 90-94 % (normal errors), 70-86 % (heavy "
    "tails)";

void AddSentences(models::ComponentRecord* record) {
  for (ModelRecord& model : record->models) {
    if (!model.memorisation) continue;
    model.memorisation->sentence = MemorisationSentence(model);
  }
  const ComponentNumbers numbers(*record);
  if (record->gap) record->gap->warning = GapSentence(numbers);
  for (VerdictRecord& verdict : record->verdict) {
    verdict.why = VerdictSentence(numbers, verdict);
  }
  if (!record->recommendation) return;
  RecommendationRecord& advice = *record->recommendation;
  advice.sentence = AdviceSentence(numbers);
  advice.why = advice.sentence;
  for (const RemarkRecord& ground : advice.grounds) {
    advice.reasons.push_back(RemarkText(numbers, ground));
    advice.why += " " + advice.reasons.back();
  }
  for (const RemarkRecord& doubt : advice.doubts) {
    advice.caveats.push_back(RemarkText(numbers, doubt));
  }
}

std::vector<std::string> FirstWords(const models::ComponentRecord& record) {
  if (!record.recommendation) {
    return {record.interrupted
                ? "The run was interrupted before a map could be recommended."
                : "No map can be recommended: none could be judged."};
  }
  const RecommendationRecord& advice = *record.recommendation;
  std::vector<std::pair<std::int64_t, const std::string*>> ranked;
  const auto add = [&](const std::vector<RemarkRecord>& remarks,
                       const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < std::min(remarks.size(), words.size()); ++i) {
      if (remarks[i].rank) ranked.emplace_back(*remarks[i].rank, &words[i]);
    }
  };
  add(advice.grounds, advice.reasons);
  add(advice.doubts, advice.caveats);
  std::ranges::sort(ranked, {}, [](const auto& one) { return one.first; });
  std::vector<std::string> words{advice.sentence};
  for (const auto& [rank, text] : ranked) words.push_back(*text);
  return words;
}

std::vector<std::string> VerdictLines(const models::ComponentRecord& record,
                                      std::size_t width) {
  std::string told;
  for (const std::string& sentence : FirstWords(record)) {
    const std::string longer = told + (told.empty() ? "" : " ") + sentence;
    if (!told.empty() && WrapLines(longer, width).size() > kMostVerdictLines) {
      continue;  // a later one may be shorter
    }
    told = longer;
  }
  return WrapLines(told, width);
}

std::string MeasureNext(const models::ComponentRecord& record) {
  if (!record.recommendation) return "";
  std::vector<std::string> wanted;
  const auto want = [&](std::string what) {
    if (std::ranges::find(wanted, what) == wanted.end()) {
      wanted.push_back(std::move(what));
    }
  };
  bool wants_days = false;
  const RecommendationRecord& advice = *record.recommendation;
  const HoldoutRecord* holdout = FindNamed(record.holdouts, advice.holdout);
  const auto verdict = std::ranges::find(
      record.verdict, advice.holdout, &VerdictRecord::holdout);
  const bool hindered = verdict != record.verdict.end() && verdict->obstacle &&
                        verdict->obstacle->needed > 0 && holdout != nullptr;
  for (const RemarkRecord& doubt : advice.doubts) {
    switch (doubt.kind) {
      case RemarkKind::kOneRunOnly:
      case RemarkKind::kUnitsCorrelated:
        if (!wants_days) want("other days");
        break;
      case RemarkKind::kFewSessions:
        wants_days = true;
        want(fmt::format("{} days or more", models::kFewestSessionsToDecide));
        break;
      case RemarkKind::kTooFewUnits:
      case RemarkKind::kTooManyMaps:
        if (hindered) {
          want(fmt::format("{} {} or more",
                           verdict->obstacle->needed,
                           PluralOfUnit(*holdout)));
        }
        break;
      case RemarkKind::kExtrapolates:
        if (const std::string where = WhereToMeasure(doubt); !where.empty()) {
          want("states" + where.substr(where.find(' ')));
        }
        break;
      default:
        break;
    }
  }
  return fmt::format("{}", fmt::join(wanted, "; "));
}

std::string VerdictParagraphs(const models::ComponentRecord& record,
                              std::size_t width) {
  std::vector<std::string> paragraphs;
  for (const HoldoutRecord& holdout : record.holdouts) {
    const auto verdict = std::ranges::find(
        record.verdict, holdout.name, &VerdictRecord::holdout);
    paragraphs.push_back(
        verdict != record.verdict.end()
            ? verdict->why
            : fmt::format("Under {} no model could be fitted.", holdout.name));
  }
  if (record.gap) paragraphs.push_back(record.gap->warning);
  if (record.recommendation) {
    const RecommendationRecord& advice = *record.recommendation;
    paragraphs.push_back(advice.why);
    paragraphs.push_back(fmt::format("{}", fmt::join(advice.caveats, " ")));
  }
  std::string text;
  for (const std::string& paragraph : paragraphs) {
    if (paragraph.empty()) continue;
    text += (text.empty() ? "" : "\n") + WrapText(paragraph, width) + "\n";
  }
  return text;
}

}  // namespace errmap::report
