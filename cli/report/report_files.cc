#include "cli/report/report_files.h"

#include "cli/report/figures.h"
#include "cli/report/report_html.h"
#include "cli/report/report_markdown.h"

namespace errmap::cli {

void WriteReport(const models::StudyRecord& record, ClaimedFolder* folder) {
  folder->Write(kReportPage, ReportHtml(record, MakeFigures(record)));
  folder->Write(kReportText, ReportMarkdown(record));
}

}  // namespace errmap::cli
