#include "cli/report/report_files.h"

#include <filesystem>

#include "cli/report/figures.h"
#include "cli/report/report_html.h"
#include "cli/report/report_markdown.h"
#include "data/atomic_file.h"

namespace errmap::cli {

std::string WriteReport(const Json& results, const std::string& folder) {
  FigureSet figures = MakeFigures(results);
  DrawFigures(&figures);
  const std::filesystem::path root(folder);
  data::WriteFileAtomically((root / "report.html").string(),
                            ReportHtml(results, figures));
  data::WriteFileAtomically((root / "report.md").string(),
                            ReportMarkdown(results));
  if (figures.failure.empty()) return "";
  return "report.html has no figures: " + figures.failure;
}

}  // namespace errmap::cli
