#include "cli/output/output_folder.h"

#include <filesystem>
#include <string_view>

#include "cli/output/report_files.h"
#include "data/atomic_file.h"
#include "models/study_file/plan/run_files.h"

namespace errmap::cli {

void RemoveAbandoned(const std::string& folder) {
  data::RemoveAbandonedFiles(folder);
  data::RemoveAbandonedFiles(
      (std::filesystem::path(folder) / "models").string());
}

std::vector<std::string> OutputNames(const study_file::StudyPlan& plan) {
  std::vector<std::string> names = study_file::RunFileNames(plan);
  names.insert(names.begin() + 1, {kReportPage, kReportText});
  return names;
}

void WriteOutputs(const study_file::StudyRun& run,
                  const models::StudyRecord& record,
                  ClaimedFolder* folder) {
  study_file::WriteRunFiles(
      run, record, [&](const std::string& name, std::string_view content) {
        folder->Write(name, content);
      });
  WriteReport(record, folder);
  folder->Finish();
}

}  // namespace errmap::cli
