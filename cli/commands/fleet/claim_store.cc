#include "cli/commands/fleet/claim_store.h"

#include <filesystem>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "cli/command.h"
#include "data/files/prepare_folder.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

namespace fs = std::filesystem;

// Whether there is nothing in a folder but what is being written, or was when a
// task was killed: another task may be about to make it a store.
bool IsFree(const std::string& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (!entry->path().filename().string().starts_with(".errmap-")) {
      return false;
    }
  }
  return true;
}

}  // namespace

void ClaimStore(const fleet::StorePaths& paths, bool force) {
  // In this order: it may become a store meanwhile.
  if (!force && !IsFree(paths.store) && !fleet::IsStore(paths.store)) {
    throw UsageError(fmt::format(
        "{} is no store and not empty; choose another folder with --out, or "
        "use it with --force",
        data::PrintablePath(paths.store)));
  }
  data::PrepareFolder(paths.store);
}

}  // namespace errmap::cli
