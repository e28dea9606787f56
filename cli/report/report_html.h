#pragma once

#include <string>

#include "cli/report/figures.h"

namespace errmap::cli {

/// report.html: one self-contained page drawn from results.json alone, with
/// the figures of MakeFigures and DrawFigures. Never throws on a document that
/// is older, incomplete or of a failed run: it says what is not there.
std::string ReportHtml(const Json& results, const FigureSet& figures);

}  // namespace errmap::cli
