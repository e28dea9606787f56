#pragma once

#include <set>
#include <string>

namespace errmap::fleet {

/// A commented study file whose components are patterns, for the CSV files
/// below a folder: folders' names that differ become fields, and so do the
/// files' own; "x_down" with a word for a direction at its end is a component
/// and a direction. Files of one name are taken to be alike: any of the first
/// three of each tells that they can be mapped, so that a broken one among good
/// ones fails in the study, where it is named. `beside` is the folder as seen
/// from the study file, `usage` how such a study is run. Throws
/// data::InputError where no file can be mapped.
struct FleetProposal {
  std::string text;
  long long files = 0;             // that the patterns match
  std::set<std::string> left_out;  // names of those that cannot be mapped
};
FleetProposal ProposeFleet(const std::string& folder,
                           const std::string& beside,
                           const std::string& target,
                           const std::string& usage);

}  // namespace errmap::fleet
