#include "cli/report/documents/report_files.h"

#include "cli/report/documents/report_html.h"
#include "cli/report/documents/report_markdown.h"
#include "cli/report/figures/figures.h"

namespace errmap::cli {

void WriteReport(const models::StudyRecord& record, ClaimedFolder* folder) {
  folder->Write(kReportPage, ReportHtml(record, MakeFigures(record)));
  folder->Write(kReportText, ReportMarkdown(record));
}

}  // namespace errmap::cli
