#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/fleet/store/component_summary.h"
#include "models/record.h"

namespace errmap::fleet {

/// Paths of the files of a store:
///
///   fleet.json                          what was asked for
///   components/COMPONENT/summary.json   at most 20 kB, written last; of
///       machine/component in components/MACHINE/COMPONENT/
///   components/COMPONENT/results.json.gz
///   components/COMPONENT/map.json.gz    the recommended map
///   components/COMPONENT/relations.json.gz  relations between its sensors
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
  /// Path of a deployed map.
  std::string Map(const std::string& sha256) const {
    return In("maps/" + sha256 + ".json");
  }
  /// Returns the component's folder below the store. It is the name if that is
  /// a valid file name, else its safe characters and a hash. For
  /// "machine/component" the folder is within that of the machine, unless an
  /// older store has it next to the others.
  std::string FolderOf(const std::string& component) const;
  std::string InFolder(const std::string& component, const char* file) const {
    return In(FolderOf(component) + "/" + file);
  }
  /// Returns the path of a name below the store.
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

/// The content of fleet.json: the study of many components as requested.
struct FleetRecord {
  std::string schema = "errmap-fleet-1";
  std::string version;
  std::string file;    // the study file
  std::string sha256;  // of it
  std::uint64_t seed = 0;
  std::string command_line;
  std::vector<FleetComponentRecord> components;
};

/// True if the folder holds a store.
bool IsStore(const std::string& folder);

/// Throws data::InputError if the folder is not a store.
FleetRecord ReadFleet(const StorePaths& paths);
/// Writes fleet.json unless its content is unchanged.
void WriteFleet(const StorePaths& paths, const FleetRecord& fleet);

/// Returns the last summary of a component, or nothing if it has not been
/// studied yet or its summary cannot be read.
std::optional<ComponentSummary> FindSummary(const StorePaths& paths,
                                            const std::string& component);

/// Returns a sentence on why a failed component has no map.
std::string WhyNoMap(const std::string& component, const std::string& why);

/// Returns a component's results. Older stores omit lists of training rows that
/// are simply all rows not held out. Throws data::InputError naming the path,
/// or the reason why the component failed.
models::StudyRecord ReadResultsOf(const StorePaths& paths,
                                  const std::string& component);

}  // namespace errmap::fleet
