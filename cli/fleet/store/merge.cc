#include "cli/fleet/store/merge.h"

#include <filesystem>

#include <fmt/format.h>

#include "cli/fleet/store/store.h"
#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "data/text.h"
#include "data/throwing_as.h"

namespace errmap::fleet {

std::string MissingWords(const FleetSummaries& found) {
  if (found.missing.empty()) return "";
  constexpr std::size_t kMostNamed = 5;
  std::vector<std::string> names;
  for (const std::string& name : found.missing) {
    names.push_back(data::Printable(name));
  }
  return fmt::format(
      "{} of {} components are missing: {}; run the shards again",
      names.size(),
      found.fleet.components.size(),
      data::ShortList(names, kMostNamed, "; "));
}

FleetSummaries ReadSummaries(const StorePaths& paths) {
  FleetSummaries found{
      .fleet = ReadFleet(paths), .summaries = {}, .missing = {}, .damaged = {}};
  for (const FleetComponentRecord& component : found.fleet.components) {
    const std::string path = paths.InFolder(component.name, kSummaryFile);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) {
      ComponentSummary summary =
          data::ThrowingAs<data::InputError, data::InputError>(
              data::PrintablePath(path) + ": ", [&] {
                return SummaryFromJsonText(
                    data::ReadFile(path, data::kMostTextOfPeople));
              });
      if (summary.asked == component.asked && summary.name == component.name) {
        found.summaries.push_back(std::move(summary));
        continue;
      }
    }
    found.missing.push_back(component.name);
  }
  return found;
}

void DrawFleetReport(const StorePaths& paths, const FleetSummaries& found) {
  data::WriteFileAtomically(paths.Report(), FleetReportHtml(paths, found));
}

FleetSummaries MergeStore(const StorePaths& paths) {
  FleetSummaries found;
  ReadFleet(paths);  // no lock is left where there is no store
  const StoreLock lock(paths);
  found = ReadSummaries(paths);
  const auto write = [&] {
    ChangeStore(paths, lock, [&](Database* store) {
      WriteSummaries(store, paths, found.fleet, found.summaries);
    });
  };
  try {
    write();
  } catch (const DamagedDatabase&) {
    found.damaged = paths.Database() + ".damaged";
    std::filesystem::rename(paths.Database(), found.damaged);
    write();
  }
  DrawFleetReport(paths, found);
  return found;
}

}  // namespace errmap::fleet
