#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/fleet/store/component_summary.h"
#include "models/record.h"

namespace errmap::fleet {

/// Where the files of a store are:
///
///   fleet.json                          what was asked for
///   components/COMPONENT/summary.json   at most 20 kB, written last; of
///       machine/component in components/MACHINE/COMPONENT/
///   components/COMPONENT/results.json.gz
///   components/COMPONENT/map.json.gz    the recommended map
///   components/COMPONENT/relations.json.gz  how its sensors go together
///   components/COMPONENT/report.html    on demand
///   maps/SHA-256.json                   maps that were deployed
///   errmap.sqlite                       all summaries together
///   report.html, watch.html
struct StorePaths {
  std::string store;

  std::string Fleet() const { return In("fleet.json"); }
  std::string Database() const { return In("errmap.sqlite"); }
  std::string Lock() const { return In("errmap.lock"); }
  std::string Report() const { return In("report.html"); }
  std::string Watch() const { return In("watch.html"); }
  /// Of maps that were deployed.
  std::string Map(const std::string& sha256) const {
    return In("maps/" + sha256 + ".json");
  }
  /// The component's folder below the store: its name where that is a plain
  /// file name, else what is safe of it and a hash; of a name with a slash in
  /// the folder of what stands before, such as a machine, but for stores that
  /// have it beside the others already.
  std::string FolderOf(const std::string& component) const;
  std::string InFolder(const std::string& component, const char* file) const {
    return In(FolderOf(component) + "/" + file);
  }
  /// Of a name below the store.
  std::string In(const std::string& name) const;
};

inline constexpr const char* kSummaryFile = "summary.json";
inline constexpr const char* kResultsFile = "results.json.gz";
inline constexpr const char* kMapFile = "map.json.gz";
inline constexpr const char* kRelationsFile = "relations.json.gz";
inline constexpr const char* kPageFile = "report.html";

struct FleetComponentRecord {
  std::string name;
  std::string data;   // relative to the study file
  std::string asked;  // ComponentSummary::asked
};

/// fleet.json: a study of many components as it was asked for.
struct FleetRecord {
  std::string schema = "errmap-fleet-1";
  std::string version;
  std::string file;    // the study file
  std::string sha256;  // of it
  std::uint64_t seed = 0;
  std::string command_line;
  std::vector<FleetComponentRecord> components;
};

/// Whether the folder holds a store.
bool IsStore(const std::string& folder);

/// Throws data::InputError where the folder is no store.
FleetRecord ReadFleet(const StorePaths& paths);
/// Writes fleet.json unless it says the same already.
void WriteFleet(const StorePaths& paths, const FleetRecord& fleet);

/// What was written of a component last; nothing where it was not studied yet,
/// or what is there cannot be read.
std::optional<ComponentSummary> FindSummary(const StorePaths& paths,
                                            const std::string& component);

/// Of a component that failed in the study.
std::string WhyNoMap(const std::string& component, const std::string& why);

/// A component's results with the lists of training rows taken out where they
/// are just those that are not held out: each list of rows stands once.
std::string PackResults(models::StudyRecord record);
/// Its inverse. Throws data::InputError naming the path, or why the component
/// failed.
models::StudyRecord ReadResultsOf(const StorePaths& paths,
                                  const std::string& component);

}  // namespace errmap::fleet
