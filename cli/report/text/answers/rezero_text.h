#pragma once

#include <string>

#include "models/study/record/study_record.h"

namespace errmap::report {

/// For a component whose maps were re-zeroed: "every 2 h", "once a session",
/// "every cycle"; "re-zeroed every 2 h".
std::string RezeroRuleWords(const models::ComponentRecord& component);
std::string RezeroedWords(const models::ComponentRecord& component);

/// "2 h", "90 min", "30 s".
std::string DurationText(double seconds);

}  // namespace errmap::report
