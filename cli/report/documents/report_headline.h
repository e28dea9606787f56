#pragma once

#include <string>
#include <vector>

#include "cli/report/report_view.h"

namespace errmap::report {

/// What the first screen says of a component, as plain text.
struct Headline {
  std::string sentence;  // the recommendation
  std::string error;     // "0.938 µm", "" where there is none
  std::string interval;  // "95 % interval 0.81 to 1.06 µm", "" likewise
  std::string where;     // "RMSE on whole groups never seen (groups:5)"
  std::string goal;      // in one sentence
  models::GoalStanding goal_standing = models::GoalStanding::kNone;
  std::vector<std::string> told;  // what is told with it first
  std::vector<std::string> reasons;
  std::vector<std::string> caveats;
};

Headline HeadlineOf(const ReportView& view);

/// The sign convention, in one sentence.
extern const char* const kSignConvention;

}  // namespace errmap::report
