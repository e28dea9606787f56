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

/// Version of the tables in errmap.sqlite that this program writes; an older
/// store is brought up to it by the next command that writes.
inline constexpr std::int64_t kStoreVersion = 3;
/// SQL that brings a store from each version to the next, from 0: nothing.
/// Lengths are in the data file's own unit, times in seconds.
extern const char* const kStoreMigrations[];

/// The store's lock, held while it lives: merge, deploy and watch write one
/// after another. Throws std::runtime_error where another has it for too long.
class StoreLock {
 public:
  explicit StoreLock(const StorePaths& paths);

 private:
  data::FileDescriptor file_;
};

/// Opens errmap.sqlite to read. Throws data::InputError where there is none, it
/// is no store, or of a newer version.
Database OpenStore(const StorePaths& paths);

/// Changes errmap.sqlite, or makes it: `change` gets a copy, which takes the
/// old one's place once it is whole and on the disk. Whoever reads sees the old
/// or the new one. What throws, a full disk too, leaves the store as it was.
void ChangeStore(const StorePaths& paths,
                 const StoreLock& lock,
                 const std::function<void(Database*)>& change);

/// Opens it for a command that writes later: one of an older version is brought
/// up to this one first.
Database OpenStore(const StorePaths& paths, const StoreLock& lock);

/// Puts the summaries of a fleet in the place of those there were. Components
/// that the study no longer has go, unless a deployment names them.
void WriteSummaries(Database* store,
                    const StorePaths& paths,
                    const FleetRecord& fleet,
                    const std::vector<ComponentSummary>& summaries);

}  // namespace errmap::fleet
