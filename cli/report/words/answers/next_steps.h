#pragma once

#include <string>
#include <vector>

#include "models/study/record/study_record.h"

namespace errmap::report {

/// Adds options by the names of a study file as flags of a command.
void AddOptions(const models::ByName<std::string>& options,
                std::vector<std::string>* words);

/// What to do with a recommendation.
using Words = std::vector<std::string>;  // of a command

struct NextStep {
  std::string purpose;  // "write the map", at most 14 characters
  Words words;          // of the command; none: `text` says it
  std::string text = {};
};

/// The file of the map, or the command that makes it; that checks it, runs it,
/// exports it; what to measure next; which rows it extrapolated; a smaller map;
/// why not a net.
/// `data`: the measurements as fit can open
/// them, empty where it cannot have the same rows; `folder`: where compare
/// --out has written the maps, "" nowhere.
std::vector<NextStep> NextSteps(const models::StudyRecord& record,
                                std::size_t component,
                                const Words& data,
                                const std::string& folder);

/// What the recommended map reads, the most needed sensor first where the
/// record knows, and the command that tells which of them would do; `page`, or
/// that in `folder`.
std::vector<NextStep> PlacesToLook(const models::StudyRecord& record,
                                   std::size_t component,
                                   const Words& data,
                                   const std::string& folder,
                                   const std::string& page);

}  // namespace errmap::report
