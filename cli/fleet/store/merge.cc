#include "cli/fleet/store/merge.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

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

namespace {

// Nothing if there is none, or one of another study.
std::optional<ComponentSummary> ReadSummary(
    const StorePaths& paths, const FleetComponentRecord& component) {
  const std::string path = paths.InFolder(component.name, kSummaryFile);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  ComponentSummary summary =
      data::ThrowingAs<data::InputError, data::InputError>(
          data::PrintablePath(path) + ": ", [&] {
            return SummaryFromJsonText(
                data::ReadFile(path, data::kMostTextOfPeople));
          });
  if (summary.asked != component.asked || summary.name != component.name) {
    return std::nullopt;
  }
  return summary;
}

}  // namespace

FleetSummaries ReadSummaries(const StorePaths& paths) {
  FleetSummaries found{
      .fleet = ReadFleet(paths), .summaries = {}, .missing = {}, .damaged = {}};
  const auto add = [&](FleetComponentRecord component,
                       std::optional<ComponentSummary> summary) {
    if (summary) {
      found.summaries.push_back(*std::move(summary));
    } else {
      found.missing.push_back(component.name);
    }
    found.fleet.components.push_back(std::move(component));
  };
  std::set<std::string> names;
  for (const FleetComponentRecord& component : found.fleet.components) {
    names.insert(component.name);
  }
  for (FleetComponentRecord& component :
       std::exchange(found.fleet.components, {})) {
    std::optional<ComponentSummary> summary = ReadSummary(paths, component);
    // Another component has the name of a way since then.
    if (summary && summary->ways &&
        std::ranges::any_of(*summary->ways, [&](const std::string& way) {
          return names.contains(way);
        })) {
      summary.reset();
    }
    if (!summary || !summary->ways) {
      add(std::move(component), std::move(summary));
      continue;
    }
    for (const std::string& way : *summary->ways) {
      component.name = way;
      add(component, ReadSummary(paths, component));
    }
  }
  return found;
}

void DrawFleetReport(const StorePaths& paths, const FleetSummaries& found) {
  data::WriteFileAtomically(paths.Report(), FleetReportHtml(paths, found));
}

FleetSummaries MergeStore(const StorePaths& paths) {
  FleetSummaries found;
  ReadFleet(paths);  // no lock is left if there is no store
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
