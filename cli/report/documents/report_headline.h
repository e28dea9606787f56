#pragma once

#include <string>
#include <vector>

#include "cli/report/report_view.h"
#include "cli/report/words/answers/first_answer.h"

namespace errmap::report {

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
