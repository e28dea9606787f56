#include "cli/output/output_folder.h"

#include <filesystem>
#include <string_view>

#include "cli/desk/plan/run_files.h"
#include "cli/output/report_files.h"
#include "data/files/atomic_file.h"

namespace errmap::cli {

void RemoveAbandoned(const std::string& folder) {
  data::RemoveAbandonedFiles(folder);
  data::RemoveAbandonedFiles(
      (std::filesystem::path(folder) / "models").string());
}

std::vector<std::string> OutputNames(const desk::StudyPlan& plan) {
  std::vector<std::string> names = desk::RunFileNames(plan);
  names.insert(names.begin() + 1, {kReportPage, kReportText});
  return names;
}

void WriteOutputs(const desk::StudyRun& run,
                  const models::StudyRecord& record,
                  ClaimedFolder* folder) {
  desk::WriteRunFiles(
      run, record, [&](const std::string& name, std::string_view content) {
        folder->Write(name, content);
      });
  WriteReport(record, folder);
  folder->Finish();
}

}  // namespace errmap::cli
