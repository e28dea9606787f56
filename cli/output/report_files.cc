#include "cli/output/report_files.h"

#include <exception>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "cli/report/documents/report_html.h"
#include "cli/report/figures/figures.h"
#include "cli/report/report.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_setup/plan/run_files.h"
#include "data/files/atomic_file.h"
#include "data/text.h"
#include "models/learning/learning_record.h"

namespace errmap::cli {
namespace {

std::vector<models::LearningRecord> ReadLearning(const std::string& folder) {
  std::vector<models::LearningRecord> found;
  for (const std::string_view by : models::kLearntBy) {
    const std::string path =
        (std::filesystem::path(folder) / (LearningStem(by) + ".json")).string();
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) continue;
    try {
      found.push_back(models::LearningFromJsonText(
          data::ReadFile(path, data::kMostTextOfPrograms)));
    } catch (const std::exception& error) {
      WriteMessage(fmt::format(
          "{} is not drawn: {}", data::PrintablePath(path), error.what()));
    }
  }
  return found;
}

}  // namespace

std::string LearningStem(std::string_view by) {
  return fmt::format("learn-{}", by);
}

report::FigureSet FiguresInFolder(const models::StudyRecord& record,
                                  const std::string& folder) {
  report::FigureSet figures = report::MakeFigures(record);
  report::AddLearning(record, ReadLearning(folder), &figures);
  return figures;
}

void WriteReport(const models::StudyRecord& record, ClaimedFolder* folder) {
  folder->Write(
      kReportPage,
      report::ReportHtml(record, FiguresInFolder(record, folder->PathOf("."))));
  folder->Write(kReportText, report::ReportMarkdown(record));
}

void RemoveAbandoned(const std::string& folder) {
  data::RemoveAbandonedFiles(folder);
  data::RemoveAbandonedFiles(
      (std::filesystem::path(folder) / "models").string());
}

std::vector<std::string> OutputNames(const study_setup::StudyPlan& plan) {
  std::vector<std::string> names = study_setup::RunFileNames(plan);
  names.insert(names.begin() + 1, {kReportPage, kReportText});
  return names;
}

void WriteOutputs(const study_setup::StudyRun& run,
                  const models::StudyRecord& record,
                  ClaimedFolder* folder) {
  study_setup::WriteRunFiles(
      run, record, [&](const std::string& name, std::string_view content) {
        folder->Write(name, content);
      });
  WriteReport(record, folder);
  folder->Finish();
}

}  // namespace errmap::cli
