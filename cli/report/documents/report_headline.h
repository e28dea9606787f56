#pragma once

#include <string>
#include <vector>

#include "cli/report/report_view.h"
#include "cli/report/words/answers/first_answer.h"

namespace errmap::report {

/// What the first screen says of a component, as plain text.
struct Headline {
  FirstAnswer answer;
  std::string error;  // "0.938 µm", "" where there is none
  models::GoalStanding goal_standing = models::GoalStanding::kNone;
  std::vector<std::string> reasons;
  std::vector<std::string> caveats;
};

Headline HeadlineOf(const ReportView& view);

/// The sign convention, in one sentence.
extern const char* const kSignConvention;

}  // namespace errmap::report
