#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/files/sqlite.h"
#include "models/study/fit_outcome.h"
#include "models/study/journal/fit_label.h"

namespace errmap::models {

/// Finished fits by their keys, in one SQLite table: fit (key, used, outcome).
/// Each fit is one transaction, so a killed process loses no recorded fit. Safe
/// to use from several threads.
class KeptFits {
 public:
  enum class Opening {
    kAnew,    // empties it first
    kResume,  // continues with its fits
  };
  static constexpr const char* kName = "fits.sqlite";
  /// Longer records are not kept: 64 MiB, the predictions of 6e6 rows.
  static constexpr std::size_t kLongestRecord = std::size_t{64} << 20U;

  /// Throws data::InputError if FOLDER/fits.sqlite exists and is not errmap's.
  /// `force` allows it to be replaced, unless it is not a plain file.
  static void RequireNoOther(const std::string& folder, bool force);

  /// Opens FOLDER/fits.sqlite for this process alone. Throws std::system_error
  /// naming a path that cannot be written, and std::runtime_error if another
  /// process has it open. If the file system has no locks (NFS), nothing is
  /// kept, and Remarks says so.
  KeptFits(const std::string& folder, Opening opening);

  /// Opens the fits of all studies of a user, shared with other processes.
  /// Beyond `most_bytes`, the least recently used are removed; one process adds
  /// at most a quarter of that. Null if `folder` is "" or cannot be written:
  /// fits are then repeated, without a message.
  static std::unique_ptr<KeptFits> OpenCache(
      const std::string& folder,
      std::int64_t most_bytes = std::int64_t{512} << 20U);

  ~KeptFits();
  KeptFits(const KeptFits&) = delete;
  KeptFits& operator=(const KeptFits&) = delete;

  bool Has(const std::string& key);
  /// Returns nothing if there is none or it cannot be read.
  std::optional<FitOutcome> Find(const std::string& key);
  /// Adds a fit. If it cannot be written (disk full), it is skipped and
  /// counted: a later run repeats it, and the results are unaffected.
  void Record(const std::string& key, const FitOutcome& outcome);
  /// Call if an outcome has the right key but belongs to another fit: counts it
  /// for the remarks. The fit is repeated.
  void CountUnfit() { ++unfit_; }

  /// Returns one line for each kind of failure to keep or use fits.
  std::vector<std::string> Remarks() const;

 private:
  KeptFits(std::string path, std::optional<std::int64_t> most_bytes);
  void Open();
  /// True if `work` with the database succeeded; else notes the reason.
  template <typename Work>
  bool Try(Work&& work);
  bool IsCache() const { return most_bytes_.has_value(); }

  std::string path_;
  std::optional<std::int64_t> most_bytes_;  // of a cache
  std::atomic<std::size_t> unfit_ = 0;
  mutable std::mutex mutex_;  // protects all members below
  std::optional<data::Database> database_;
  std::vector<std::string> used_;  // keys found in a cache
  std::int64_t added_ = 0;         // bytes
  std::size_t too_long_ = 0;
  std::size_t unwritten_ = 0;
  bool damaged_ = false;
  std::string why_;  // of the first failure
};

/// Returns the folder of the last fits: errmap in $XDG_CACHE_HOME, else in
/// $HOME/.cache; "" if neither is an absolute path.
std::string DefaultCacheFolder();

/// Kept fits of one component's study in one or several files. A fit found in
/// one is copied to the files before it.
class ComponentJournal final : public FitJournal {
 public:
  /// All arguments must outlive it; null files are skipped.
  ComponentJournal(std::vector<KeptFits*> files,
                   const FitLabels* labels,
                   const data::Dataset* dataset,
                   const std::vector<Holdout>* holdouts)
      : files_(std::move(files)),
        labels_(*labels),
        dataset_(*dataset),
        holdouts_(*holdouts) {
    std::erase(files_, nullptr);
  }

  /// The map found must reproduce the stored predictions on its test rows, bit
  /// for bit: checksums detect damage but not forgery.
  std::optional<FitOutcome> Find(const StudyTask& task) override;
  void Record(const StudyTask& task, const FitOutcome& outcome) override {
    for (KeptFits* file : files_) file->Record(labels_.KeyOf(task), outcome);
  }

 private:
  bool IsOf(const StudyTask& task, const FitOutcome& outcome) const;

  std::vector<KeptFits*> files_;
  const FitLabels& labels_;
  const data::Dataset& dataset_;
  const std::vector<Holdout>& holdouts_;
};

/// Returns how many fits of a study are already done, and how many remain.
std::string DescribeResume(KeptFits* fits, const FitLabels& labels);

}  // namespace errmap::models
