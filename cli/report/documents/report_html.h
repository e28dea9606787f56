#pragma once

#include <string>
#include <vector>

#include "cli/report/figures/figures.h"
#include "cli/report/report_view.h"
#include "cli/report/text/answers/first_answer.h"

namespace errmap::report {

/// Returns report.html: one self-contained page drawn from the record alone,
/// with the figures of MakeFigures. For an incomplete or failed study, it says
/// what is missing.
std::string ReportHtml(const models::StudyRecord& record,
                       const FigureSet& figures);

/// Returns a page with its style sheet. Every contrast is at least 4.5 to 1.
/// The page runs no script and loads nothing. `title` is text, `body` HTML.
std::string PageHtml(const std::string& title, const std::string& body);

/// Returns HTML links from a page's first screen to the section that explains
/// the terms.
std::string GlossaryLinks();
std::string Glossary();

/// The first screen of a component, as plain text.
struct Headline {
  FirstAnswer answer;
  std::string error;  // "0.938 µm", "" if there is none
  models::GoalStanding goal_standing = models::GoalStanding::kNone;
  // Further details, for which the answer has no room.
  std::vector<std::string> reasons;
  std::vector<std::string> caveats;
};

Headline HeadlineOf(const ReportView& view);

/// The sign convention, in one sentence.
extern const char* const kSignConvention;

}  // namespace errmap::report
