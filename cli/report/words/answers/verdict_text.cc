#include "cli/report/words/answers/verdict_text.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "cli/report/words/answers/component_numbers.h"
#include "cli/report/words/answers/first_answer.h"
#include "cli/report/words/answers/remark_text.h"
#include "cli/report/words/answers/rezero_text.h"
#include "cli/report/words/answers/verdict_sentences.h"
#include "cli/report/wrap_text.h"
#include "data/input_error.h"
#include "data/text.h"

namespace errmap::report {
namespace {

using models::FindNamed;
using models::HoldoutRecord;
using models::RecommendationRecord;
using models::RemarkKind;
using models::RemarkRecord;
using models::VerdictRecord;

// What next_steps.cc answers in lines of their own.
bool StandsInNextSteps(RemarkKind kind) {
  return kind == RemarkKind::kSmaller || kind == RemarkKind::kBestNet ||
         kind == RemarkKind::kExtrapolates;
}

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
  if (record->rezero) record->rezero->sentence = RezeroSentence(*record);
  if (!record->recommendation) return;
  RecommendationRecord& advice = *record->recommendation;
  advice.sentence = FirstAnswerOf(*record).Sentence();
  advice.why = advice.sentence;
  const auto put = [&](std::vector<RemarkRecord>* remarks,
                       std::vector<std::string>* words) {
    words->clear();
    for (RemarkRecord& remark : *remarks) {
      remark.text = RemarkText(numbers, remark);
      words->push_back(remark.text);
    }
  };
  put(&advice.grounds, &advice.reasons);
  put(&advice.doubts, &advice.caveats);
  for (const std::string& reason : advice.reasons) advice.why += " " + reason;
}

models::StudyRecord WithPageUnits(models::StudyRecord record) {
  for (models::ComponentRecord& component : record.components) {
    models::ComponentRecord page = component;
    page.display.unit = PrettyUnit(page.display.unit);
    try {
      AddSentences(&page);
    } catch (const data::InputError&) {
      continue;  // an incomplete record, whose words stay as they are
    }
    component = std::move(page);
  }
  return record;
}

std::string MeasureNext(const models::ComponentRecord& record) {
  if (!record.recommendation) return "";
  std::vector<std::string> wanted;
  const auto want = [&](std::string what) {
    if (std::ranges::find(wanted, what) == wanted.end()) {
      wanted.push_back(std::move(what));
    }
  };
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
        want("other days");
        break;
      case RemarkKind::kTooFewUnits:
      case RemarkKind::kTooManyMaps:
        if (hindered) {
          want(fmt::format("{} {} or more in all",
                           verdict->obstacle->needed,
                           PluralOfUnit(*holdout)));
        }
        break;
      case RemarkKind::kExtrapolates:
        if (const std::string where = WhereToMeasure(doubt); !where.empty()) {
          want(where);
        }
        break;
      default:
        break;
    }
  }
  return data::JoinWords(wanted, "; ");
}

std::string VerdictParagraphs(const models::ComponentRecord& record,
                              std::size_t width,
                              bool next_steps) {
  std::vector<std::string> paragraphs;
  for (const HoldoutRecord& holdout : record.holdouts) {
    const auto verdict = std::ranges::find(
        record.verdict, holdout.name, &VerdictRecord::holdout);
    paragraphs.push_back(
        verdict != record.verdict.end()
            ? verdict->why
            : fmt::format("Under {} no model could be fitted.", holdout.name));
  }
  const std::string warning = record.gap ? record.gap->warning : "";
  paragraphs.push_back(warning);
  if (record.recommendation) {
    for (const auto* remarks :
         {&record.recommendation->grounds, &record.recommendation->doubts}) {
      std::string more;
      for (const RemarkRecord& remark : *remarks) {
        if (remark.text.empty() ||
            (next_steps && StandsInNextSteps(remark.kind)) ||
            (!warning.empty() &&
             remark.kind == RemarkKind::kIgnoreNeighbours)) {
          continue;
        }
        more += (more.empty() ? "" : " ") + remark.text;
      }
      paragraphs.push_back(std::move(more));
    }
  }
  std::string text;
  for (const std::string& paragraph : paragraphs) {
    if (paragraph.empty()) continue;
    text += (text.empty() ? "" : "\n") + WrapText(paragraph, width) + "\n";
  }
  return text;
}

}  // namespace errmap::report
