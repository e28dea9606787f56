#pragma once

#include <string>
#include <vector>

#include "models/study/record/study_record.h"

namespace errmap::report {

/// Adds options by the names of a study file as flags of a command.
void AddOptions(const models::ByName<std::string>& options,
                std::vector<std::string>* words);

/// What to do with a recommended map.
using Words = std::vector<std::string>;  // of a command

struct NextStep {
  std::string purpose;  // "write the map", at most 14 characters
  Words words;          // of the command; none: `text` says it
  std::string text = {};
};

/// Returns the next steps: the map's file or the command that makes it;
/// commands that check, run and export it; what to measure next; which rows it
/// extrapolated; a smaller map; why not a net. `data`: arguments with which
/// `fit` opens the measurements; empty if it cannot get the same rows.
/// `folder`: where compare --out wrote the maps; "" if nowhere.
std::vector<NextStep> NextSteps(const models::StudyRecord& record,
                                std::size_t component,
                                const Words& data,
                                const std::string& folder);

/// Names the inputs of the recommended map, the most important sensor first if
/// known, and the command that finds which sensors are enough. `page`: the
/// report to look at, or the one in `folder`.
std::vector<NextStep> PlacesToLook(const models::StudyRecord& record,
                                   std::size_t component,
                                   const Words& data,
                                   const std::string& folder,
                                   const std::string& page);

}  // namespace errmap::report
