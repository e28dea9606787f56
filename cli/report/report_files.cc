#include "cli/report/report_files.h"

#include <filesystem>

#include "cli/report/figures.h"
#include "cli/report/report_html.h"
#include "cli/report/report_markdown.h"
#include "data/atomic_file.h"

namespace errmap::cli {

void WriteReport(const models::StudyRecord& record, const std::string& folder) {
  const std::filesystem::path root(folder);
  data::WriteFileAtomically((root / "report.html").string(),
                            ReportHtml(record, MakeFigures(record)));
  data::WriteFileAtomically((root / "report.md").string(),
                            ReportMarkdown(record));
}

}  // namespace errmap::cli
