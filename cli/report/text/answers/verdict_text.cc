#include "cli/report/text/answers/verdict_text.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "cli/report/text/answers/first_answer.h"
#include "cli/report/text/answers/remarks.h"
#include "cli/report/text/answers/verdict_sentences.h"
#include "cli/report/wrap_text.h"
#include "data/input_error.h"
#include "data/text.h"

namespace errmap::report {
namespace {

using models::HoldoutRecord;
using models::RecommendationRecord;
using models::VerdictRecord;

void AddRemarks(const ComponentNumbers& numbers, RecommendationRecord* advice) {
  advice->reasons.clear();
  advice->caveats.clear();
  for (const Remark& remark : RemarksOf(numbers)) {
    (remark.is_caveat ? advice->caveats : advice->reasons)
        .push_back(SentenceOf(remark));
  }
  advice->why = advice->sentence;
  for (const std::string& reason : advice->reasons) advice->why += " " + reason;
}

}  // namespace

const char* const kIntervalCoverage =
    "In simulations the 95 % ranges held the true value in 93 to 98 % of the "
    "cases, in 79 to 87 % where outliers are common";

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
  advice.sentence = FirstAnswerOf(*record).Sentence();
  AddRemarks(numbers, &advice);
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
  for (const Remark& remark : RemarksOf(ComponentNumbers(record))) {
    if (!remark.measure.empty() &&
        std::ranges::find(wanted, remark.measure) == wanted.end()) {
      wanted.push_back(remark.measure);
    }
  }
  return data::JoinWords(wanted, "; ");
}

std::string VerdictParagraphs(const models::ComponentRecord& record,
                              std::size_t width,
                              bool next_steps) {
  std::string text;
  for (const HoldoutRecord& holdout : record.holdouts) {
    const auto verdict = std::ranges::find(
        record.verdict, holdout.name, &VerdictRecord::holdout);
    text += WrapText(verdict != record.verdict.end()
                         ? verdict->why
                         : fmt::format("Under {} no model could be fitted.",
                                       holdout.name),
                     width) +
            "\n\n";
  }
  if (!record.recommendation) return text;
  for (const Remark& remark : RemarksOf(ComponentNumbers(record))) {
    if (remark.place == Remark::Place::kAnswer ||
        (next_steps && remark.place == Remark::Place::kNextSteps)) {
      continue;
    }
    text += data::JoinWords(LabelledLines(remark, width), "\n") + "\n";
  }
  return text;
}

}  // namespace errmap::report
