#include "cli/report/report.h"

#include "cli/report/documents/report_html.h"
#include "cli/report/documents/study_table.h"
#include "cli/report/tables/report_tables.h"
#include "cli/report/text/answers/first_answer.h"
#include "cli/report/text/answers/verdict_text.h"
#include "data/text.h"
#include "models/study/record/make_study_record.h"
#include "models/study/record/provenance_record.h"
#include "models/version.h"

namespace errmap::report {

models::StudyRecord MakeRecord(
    const std::vector<models::ComponentStudy>& components,
    std::uint64_t seed,
    int jobs) {
  std::vector<models::InputFileRecord> inputs;
  models::StudyRecord record;
  record.schema = models::kResultsSchema;
  record.version = models::Version();
  record.seed = seed;
  for (const models::ComponentStudy& component : components) {
    record.interrupted |= component.study.interrupted;
    inputs.insert(inputs.end(), component.files.begin(), component.files.end());
    record.components.push_back(models::MakeComponentRecord(component, jobs));
    AddSentences(&record.components.back());
  }
  record.provenance = models::MakeProvenance("", std::move(inputs));
  record.provenance.configuration.seed = seed;
  return record;
}

std::string VerdictText(const models::ComponentRecord& component,
                        std::size_t columns) {
  const std::vector<std::string> lines =
      AnswerLines(FirstAnswerOf(component), columns).lines;
  return data::JoinWords(lines, "\n");
}

std::string ScreenText(const models::StudyRecord& record, std::size_t columns) {
  return StudyTable(record, {.terminal = {.columns = columns}}).text;
}

std::optional<std::string> TableText(const models::StudyRecord& record,
                                     std::string_view format) {
  return TableText(LeaderboardRows(record), format);
}

std::string ReportHtml(const models::StudyRecord& record) {
  return ReportHtml(record, MakeFigures(record));
}

}  // namespace errmap::report
