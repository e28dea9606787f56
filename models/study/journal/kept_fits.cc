#include "models/study/journal/kept_fits.h"

#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "data/files/link.h"
#include "data/input_error.h"
#include "data/text.h"
#include "models/study/journal/fit_record.h"

namespace errmap::models {
namespace {

namespace fs = std::filesystem;

// The first bytes of a database, and the place of its owner.
constexpr std::string_view kBegin{"SQLite format 3\0", 16};
constexpr std::size_t kOwnerAt = 68;
constexpr std::string_view kOwner = "ErMp";  // application_id 1165118832
constexpr std::size_t kSchemaAt = 40;        // counts changes of the tables
constexpr std::string_view kNoSchema{"\0\0\0\0", 4};
constexpr std::uintmax_t kPage = 4096;

std::string PathIn(const std::string& folder) {
  return fs::path(folder) / KeptFits::kName;
}

std::int64_t Now() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::string Count(std::size_t number, const char* what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

}  // namespace

void KeptFits::RequireNoOther(const std::string& folder, bool force) {
  const std::string path = PathIn(folder);
  if (data::IsLink(path)) {
    if (force || data::IsInOwnFolder(path)) return;
    throw data::InputError(data::PrintablePath(path) +
                           ": is a link in the folder of another user; choose "
                           "another folder, move it away, or go on with " +
                           data::ArgumentName("force"));
  }
  std::error_code absent;
  const fs::file_status status = fs::status(path, absent);
  if (!fs::exists(status)) return;
  if (!fs::is_regular_file(status)) {
    throw data::InputError(
        data::PrintablePath(path) +
        ": is not a plain file; move it away or choose another folder");
  }
  std::string begin(kOwnerAt + kOwner.size(), '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (force || stream.gcount() == 0) return;  // empty: of a killed process
  if (begin.starts_with(kBegin)) {
    // Where the first transaction was broken off, its journal lies beside the
    // file, or there is one page and no table was ever made.
    const bool is_broken_off =
        fs::exists(path + "-journal") ||
        (fs::file_size(path) == kPage &&
         begin.substr(kSchemaAt, kNoSchema.size()) == kNoSchema);
    if (is_broken_off || begin.ends_with(kOwner)) return;
  }
  throw data::InputError(data::PrintablePath(path) +
                         ": holds no fits of errmap; choose another folder, "
                         "move it away, or go on with " +
                         data::ArgumentName("force"));
}

KeptFits::KeptFits(std::string path, std::optional<std::int64_t> most_bytes)
    : path_(std::move(path)), most_bytes_(most_bytes) {
  data::RemoveLink(path_, true);  // RequireNoOther has refused another user's
  try {
    Open();
  } catch (const data::DamagedDatabase&) {
    // A damaged database loses nothing but time.
    database_.reset();
    fs::remove(path_);
    Open();
  }
}

KeptFits::KeptFits(const std::string& folder, Opening opening) try
    : KeptFits(PathIn(folder), std::nullopt) {
  if (opening == Opening::kAnew && database_) {
    // This process had it alone; even on a full disk it can be removed.
    database_.reset();
    fs::remove(path_);
    Open();
  }
} catch (const data::SqliteError& error) {
  const std::string path = data::PrintablePath(PathIn(folder));
  if (error.is_busy()) {
    throw std::runtime_error(path +
                             ": another errmap is using this folder; wait "
                             "until it ends or choose another folder");
  }
  throw std::system_error(
      error.system_error(), std::generic_category(), "cannot write " + path);
}

void KeptFits::Open() {
  database_.emplace(path_, data::Database::Access::kShared);
  try {
    // A kill loses nothing. A loss of power may cost a cache.
    database_->Execute(IsCache() ? "PRAGMA synchronous = OFF"
                                 : "PRAGMA synchronous = NORMAL;"
                                   "PRAGMA locking_mode = EXCLUSIVE");
    database_->Execute(
        "PRAGMA auto_vacuum = FULL; BEGIN EXCLUSIVE;"
        "PRAGMA application_id = 1165118832;"
        "CREATE TABLE IF NOT EXISTS fit (key TEXT PRIMARY KEY,"
        " used INTEGER NOT NULL, outcome BLOB NOT NULL); COMMIT");
  } catch (const data::SqliteError&) {
    database_.reset();
    if (data::KnowsLocks(path_)) throw;
    why_ = "the file system knows no locks";
  }
}

std::unique_ptr<KeptFits> KeptFits::OpenCache(const std::string& folder,
                                              std::int64_t most_bytes) {
  if (folder.empty()) return nullptr;
  try {
    // Maps tell of measurements: nobody else's business.
    if (fs::create_directories(folder)) {
      fs::permissions(folder, fs::perms::owner_all);
    }
    RequireNoOther(folder, true);
    std::unique_ptr<KeptFits> cache(new KeptFits(PathIn(folder), most_bytes));
    if (!cache->database_) return nullptr;
    cache->database_
        ->Prepare(
            "DELETE FROM fit WHERE key IN (SELECT key FROM (SELECT key, "
            "sum(length(outcome)) OVER (ORDER BY used DESC, key) AS kept FROM "
            "fit) WHERE kept > ?)")
        .With(most_bytes)
        .Run();
    return cache;
  } catch (const std::exception&) {
    return nullptr;  // a luxury, whatever is amiss with it
  }
}

KeptFits::~KeptFits() {
  try {
    if (damaged_) {
      database_.reset();
      fs::remove(path_);
    } else if (!used_.empty()) {
      database_->Execute("BEGIN");
      data::Statement use =
          database_->Prepare("UPDATE fit SET used = ? WHERE key = ?");
      for (const std::string& key : used_) use.With(Now(), key).Run();
      database_->Execute("COMMIT");
    }
  } catch (const std::exception&) {
    // They look older than they are.
  }
}

template <typename Work>
bool KeptFits::Try(Work&& work) {
  if (!database_) return false;
  std::string why;
  try {
    work();
    return true;
  } catch (const data::DamagedDatabase&) {
    damaged_ = true;
    why = "it is damaged";
  } catch (const data::SqliteError& error) {
    why = error.what();
  }
  if (why_.empty()) why_ = why;
  return false;
}

bool KeptFits::Has(const std::string& key) {
  const std::lock_guard lock(mutex_);
  bool has = false;
  Try([&] {
    has =
        database_->Prepare("SELECT 1 FROM fit WHERE key = ?").With(key).Next();
  });
  return has;
}

std::optional<FitOutcome> KeptFits::Find(const std::string& key) {
  std::string record;
  {
    const std::lock_guard lock(mutex_);
    Try([&] {
      data::Statement query =
          database_->Prepare("SELECT outcome FROM fit WHERE key = ?");
      if (query.With(key).Next()) record = query.Text(0);
    });
    if (record.empty()) return std::nullopt;
    if (IsCache()) used_.push_back(key);
  }
  try {
    return FitFromBytes(key, record);
  } catch (const data::InputError&) {
    ++unfit_;
    return std::nullopt;
  }
}

void KeptFits::Record(const std::string& key, const FitOutcome& outcome) {
  // A model without a form could not be made again: it is fitted again.
  if (outcome.fitted &&
      std::holds_alternative<OpaqueForm>(outcome.fitted->model->Describe())) {
    return;
  }
  // What failed may be mended in another program's code before the next run.
  if (!outcome.fitted && IsCache()) return;
  const std::string record = FitToBytes(key, outcome);
  const auto size = std::ssize(record);
  constexpr std::int64_t kShareOfOne = 4;
  const std::lock_guard lock(mutex_);
  if (record.size() > kLongestRecord ||
      (IsCache() && added_ + size > *most_bytes_ / kShareOfOne)) {
    ++too_long_;
    return;
  }
  const bool is_kept = Try([&] {
    database_->Prepare("INSERT OR REPLACE INTO fit VALUES (?, ?, ?)")
        .With(key, Now(), data::Blob{record})
        .Run();
  });
  if (is_kept) {
    added_ += size;
  } else {
    ++unwritten_;
  }
}

std::vector<std::string> KeptFits::Remarks() const {
  const std::lock_guard lock(mutex_);
  const std::string path = data::PrintablePath(path_);
  std::vector<std::string> remarks;
  if (unfit_ > 0) {
    remarks.push_back(fmt::format(
        "{}: {} whose records are not of them (changed by another hand?) made "
        "again",
        path,
        Count(unfit_, "fit")));
  }
  if (too_long_ > 0) {
    remarks.push_back(fmt::format(
        "{}: {} not kept, being above {} MiB each; {} would make them again",
        path,
        Count(too_long_, "fit"),
        kLongestRecord >> 20U,
        data::ArgumentName("resume")));
  }
  if (!why_.empty()) {
    remarks.push_back(
        fmt::format("cannot keep fits in {}: {}; {} not kept, {} would make "
                    "them again",
                    path,
                    why_,
                    Count(unwritten_, "fit"),
                    data::ArgumentName("resume")));
  }
  return remarks;
}

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

std::optional<FitOutcome> ComponentJournal::Find(const StudyTask& task) {
  const std::string key = labels_.KeyOf(task);
  for (auto file = files_.begin(); file != files_.end(); ++file) {
    std::optional<FitOutcome> found = (*file)->Find(key);
    if (!found) continue;
    if (IsOf(task, *found)) {
      for (auto before = files_.begin(); before != file; ++before) {
        (*before)->Record(key, *found);
      }
      return found;
    }
    (*file)->CountUnfit();
  }
  return std::nullopt;
}

bool ComponentJournal::IsOf(const StudyTask& task,
                            const FitOutcome& outcome) const {
  if (!outcome.fitted) {
    return !outcome.why_failed.empty() &&
           outcome.train_predictions.size() == 0 &&
           outcome.test_predictions.size() == 0;
  }
  const bool is_of_all_rows = task.holdout < 0;
  const VectorXd& recorded =
      is_of_all_rows ? outcome.train_predictions : outcome.test_predictions;
  const auto predicts = [&](const data::Dataset& rows) {
    const VectorXd predicted = outcome.fitted->Predict(rows);
    return predicted.allFinite() && predicted.size() == recorded.size() &&
           predicted == recorded;
  };
  try {
    if (outcome.fitted->model == nullptr) return false;
    if (is_of_all_rows) return predicts(dataset_);
    const Holdout& holdout = holdouts_[static_cast<std::size_t>(task.holdout)];
    const stats::Fold& fold = holdout.folds[task.fold];
    return outcome.train_predictions.allFinite() &&
           outcome.train_predictions.size() == std::ssize(fold.train) &&
           predicts(holdout.Source(dataset_).SelectRows(fold.test));
  } catch (const std::invalid_argument&) {
    return false;  // inputs that the data have not, or another number of them
  }
}

std::string DescribeResume(KeptFits* fits, const FitLabels& labels) {
  const std::vector<std::string> keys = labels.Keys();
  std::size_t at_hand = 0;
  for (const std::string& key : keys) at_hand += fits->Has(key) ? 1U : 0U;
  return fmt::format("{}: {} of {} are at hand, {} to be made",
                     labels.component(),
                     at_hand,
                     Count(keys.size(), "fit"),
                     keys.size() - at_hand);
}

}  // namespace errmap::models
