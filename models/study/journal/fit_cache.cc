#include "models/study/journal/fit_cache.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <system_error>
#include <vector>

namespace errmap::models {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kNameLength = 64;  // of a SHA-256 in hexadecimal

struct KeptJournal {
  fs::path folder;
  fs::file_time_type used;
  std::int64_t bytes = 0;
};

// Ours alone: whatever else lies in `folder` stays as it is.
std::vector<KeptJournal> JournalsIn(const fs::path& folder) {
  std::vector<KeptJournal> journals;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().size() != kNameLength) continue;
    std::error_code absent;  // another process may take it away meanwhile
    const fs::path file = entry.path() / JournalFile::kName;
    const auto bytes = static_cast<std::int64_t>(fs::file_size(file, absent));
    if (absent) continue;
    const fs::file_time_type used = fs::last_write_time(file, absent);
    if (!absent) journals.push_back({entry.path(), used, bytes});
  }
  return journals;
}

void MakeRoom(const fs::path& folder,
              const fs::path& in_use,
              std::int64_t room) {
  std::vector<KeptJournal> journals = JournalsIn(folder);
  std::ranges::sort(journals, std::ranges::greater(), &KeptJournal::used);
  for (const KeptJournal& journal : journals) {
    if (journal.folder == in_use) continue;
    room -= journal.bytes;
    if (room >= 0) continue;
    std::error_code ignored;
    fs::remove(journal.folder / JournalFile::kName, ignored);
    fs::remove(journal.folder, ignored);
  }
}

}  // namespace

std::string DefaultCacheFolder() {
  const auto place = [](const char* variable) {
    const char* const value = std::getenv(variable);
    const fs::path path = value == nullptr ? "" : value;
    return path.is_absolute() ? path : fs::path();
  };
  fs::path cache = place("XDG_CACHE_HOME");
  if (const fs::path home = place("HOME"); cache.empty() && !home.empty()) {
    cache = home / ".cache";
  }
  return cache.empty() ? "" : (cache / "errmap").string();
}

std::unique_ptr<JournalFile> OpenKeptFits(const std::string& folder,
                                          const FitLabels& labels,
                                          std::int64_t most_bytes) {
  if (folder.empty()) return nullptr;
  constexpr std::int64_t kShareOfOne = 4;
  const std::int64_t most_of_one = most_bytes / kShareOfOne;
  try {
    // Maps tell of measurements: nobody else's business.
    const auto make = [](const fs::path& path) {
      if (fs::create_directories(path)) {
        fs::permissions(path, fs::perms::owner_all);
      }
    };
    make(folder);
    const fs::path own = fs::path(folder) / labels.DataKey();
    make(own);
    JournalFile::RequireNoOther(own, true);
    const fs::path file = own / JournalFile::kName;
    if (fs::exists(file) &&
        static_cast<std::int64_t>(fs::file_size(file)) > most_of_one) {
      fs::remove(file);
    }
    auto journal = std::make_unique<JournalFile>(
        own, JournalFile::Opening::kResume, most_of_one);
    fs::last_write_time(file, fs::file_time_type::clock::now());
    MakeRoom(folder, own, most_bytes - most_of_one);
    return journal;
  } catch (const std::exception&) {
    return nullptr;  // a luxury, whatever is amiss with it
  }
}

}  // namespace errmap::models
