#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cli/fleet/store/component_summary.h"
#include "cli/fleet/store/store_folder.h"
#include "data/files/file_descriptor.h"
#include "data/files/sqlite.h"

namespace errmap::fleet {

using data::DamagedDatabase;
using data::Database;
using data::SqliteError;
using data::Statement;

/// Version of the tables in errmap.sqlite that this program writes. The next
/// command that writes upgrades an older store.
inline constexpr std::int64_t kStoreVersion = 3;
/// SQL that upgrades a store from each version to the next, from 0, the empty
/// store. Lengths are in the data file's own unit, times in seconds.
extern const char* const kStoreMigrations[];

/// Holds the store's lock for its lifetime, so that merge, deploy and watch
/// never write at the same time. Throws std::runtime_error if another process
/// holds it for too long.
class StoreLock {
 public:
  explicit StoreLock(const StorePaths& paths);

 private:
  data::FileDescriptor file_;
};

/// Opens errmap.sqlite for reading. Throws data::InputError if it is missing,
/// is not a store, or has a newer version.
Database OpenStore(const StorePaths& paths);

/// Changes or creates errmap.sqlite. `change` gets a copy, which replaces the
/// old file once it is complete and on disk. Readers see either the old file or
/// the new one. If anything throws, as on a full disk, the store is unchanged.
void ChangeStore(const StorePaths& paths,
                 const StoreLock& lock,
                 const std::function<void(Database*)>& change);

/// Upgrades an older store, then opens it for a command that writes later.
Database OpenStore(const StorePaths& paths, const StoreLock& lock);

/// Replaces all summaries of a fleet. Components that the study no longer has
/// are removed, unless a deployment names them.
void WriteSummaries(Database* store,
                    const StorePaths& paths,
                    const FleetRecord& fleet,
                    const std::vector<ComponentSummary>& summaries);

}  // namespace errmap::fleet
