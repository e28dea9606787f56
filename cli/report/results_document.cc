#include "cli/report/results_document.h"

#include "cli/report/configuration_record.h"
#include "cli/report/verdict_text.h"
#include "cli/study_file/provenance.h"
#include "models/study/make_study_record.h"
#include "models/version.h"

namespace errmap::cli {
namespace {

void AddSentences(const Comparison& comparison,
                  models::ComponentRecord* record) {
  for (std::size_t i = 0; i < record->models.size(); ++i) {
    auto& memorisation = record->models[i].memorisation;
    if (!memorisation) continue;
    memorisation->sentence = MemorisationSentence(comparison.study.models[i]);
  }
  if (record->gap) record->gap->warning = GapSentence(comparison);
  auto verdict = record->verdict.begin();
  for (std::size_t h = 0; h < comparison.holdouts.size(); ++h) {
    if (!comparison.judgement.verdicts[h]) continue;
    verdict->why = VerdictSentence(comparison, h);
    ++verdict;
  }
  if (!record->recommendation) return;
  models::RecommendationRecord& advice = *record->recommendation;
  advice.sentence = RecommendationSentence(comparison);
  advice.reasons = Reasons(comparison);
  advice.caveats = Caveats(comparison);
  advice.why = advice.sentence;
  for (const std::string& reason : advice.reasons) advice.why += " " + reason;
}

}  // namespace

models::StudyRecord RecordOf(const StudyRun& run) {
  models::StudyRecord record;
  record.schema = "errmap-results-1";
  record.version = models::Version();
  record.seed = run.seed;
  record.interrupted = run.interrupted;
  record.provenance = MakeProvenance(run.command_line, run.inputs);
  record.provenance.configuration = EffectiveConfiguration(run.config);
  for (const Comparison& component : run.components) {
    record.components.push_back(models::MakeComponentRecord(component));
    AddSentences(component, &record.components.back());
  }
  return record;
}

}  // namespace errmap::cli
