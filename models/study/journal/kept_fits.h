#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/files/sqlite.h"
#include "models/study/fit_outcome.h"
#include "models/study/journal/fit_label.h"

namespace errmap::models {

/// Finished fits by their keys, in one SQLite table: fit (key, used, outcome).
/// Each fit is a transaction, so a process that is killed loses none that was
/// recorded. Safe to use from several threads.
class KeptFits {
 public:
  enum class Opening {
    kAnew,    // empties it
    kResume,  // goes on with what there is
  };
  static constexpr const char* kName = "fits.sqlite";
  /// A longer record is not kept: 64 MiB, predictions of 6e6 rows.
  static constexpr std::size_t kLongestRecord = std::size_t{64} << 20U;

  /// Throws data::InputError where FOLDER/fits.sqlite is there and is not
  /// errmap's: never where it is no plain file; `force` lets it be replaced.
  static void RequireNoOther(const std::string& folder, bool force);

  /// FOLDER/fits.sqlite, for this process alone. Throws std::system_error
  /// naming the path that cannot be written, and std::runtime_error where
  /// another process has it open. Where the file system knows no locks (NFS)
  /// nothing is kept, and Remarks says so.
  KeptFits(const std::string& folder, Opening opening);

  /// The fits of all studies of a user, shared with other processes: those used
  /// longest ago go until `most_bytes` are left, and one process adds at most a
  /// quarter of that. Null where `folder` is "" or cannot be written: then fits
  /// are made again, and nobody need know.
  static std::unique_ptr<KeptFits> OpenCache(
      const std::string& folder,
      std::int64_t most_bytes = std::int64_t{512} << 20U);

  ~KeptFits();
  KeptFits(const KeptFits&) = delete;
  KeptFits& operator=(const KeptFits&) = delete;

  bool Has(const std::string& key);
  /// Empty where there is none or it cannot be read.
  std::optional<FitOutcome> Find(const std::string& key);
  /// Adds a fit. What cannot be written (a full disk) is given up and counted:
  /// it costs a repetition later, not the results now.
  void Record(const std::string& key, const FitOutcome& outcome);
  /// An outcome of the right key that is not of its fit: counted for the
  /// remarks; the fit is made again.
  void CountUnfit() { ++unfit_; }

  /// What people should know of what could not be kept or used, a line each.
  std::vector<std::string> Remarks() const;

 private:
  KeptFits(std::string path, std::optional<std::int64_t> most_bytes);
  void Open();
  /// Whether `work` with the database could be done; why not is noted.
  template <typename Work>
  bool Try(Work&& work);
  bool IsCache() const { return most_bytes_.has_value(); }

  std::string path_;
  std::optional<std::int64_t> most_bytes_;  // of a cache
  std::atomic<std::size_t> unfit_ = 0;
  mutable std::mutex mutex_;  // of all that follows
  std::optional<data::Database> database_;
  std::vector<std::string> used_;  // keys found in a cache
  std::int64_t added_ = 0;         // bytes
  std::size_t too_long_ = 0;
  std::size_t unwritten_ = 0;
  bool damaged_ = false;
  std::string why_;  // of the first failure
};

/// Where the last fits are kept: errmap in $XDG_CACHE_HOME or else in
/// $HOME/.cache; "" where neither is an absolute path.
std::string DefaultCacheFolder();

/// Kept fits of one component's study, in one place or in several: what one
/// has, those before it are given.
class ComponentJournal final : public FitJournal {
 public:
  /// All must outlive it; null files are left out.
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

  /// The map found must predict what stands beside it, bit for bit, on the rows
  /// that it is judged by: sums keep damage out, and forgers not.
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

/// How many fits of a study are at hand, and how many are to be made.
std::string DescribeResume(KeptFits* fits, const FitLabels& labels);

}  // namespace errmap::models
