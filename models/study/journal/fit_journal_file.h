#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "data/files/file_descriptor.h"
#include "models/study/fit_outcome.h"
#include "models/study/journal/fit_label.h"

namespace errmap::models {

/// Finished fits in FOLDER/journal.jsonl, one line each:
///
///   {"sum":"SHA-256 of the rest","fit":[label],"outcome":[record]}
///
/// A line is added by one write at the end of the file, so a process that is
/// killed leaves at most its last line torn; that line is cut off when the
/// file is opened again, and a line whose sum is wrong is passed over. The file
/// stays locked while it is open. Safe to use from several threads.
class JournalFile {
 public:
  enum class Opening {
    kAnew,    // what there is becomes journal.previous.jsonl
    kResume,  // goes on with what there is
  };
  static constexpr const char* kName = "journal.jsonl";
  static constexpr const char* kPreviousName = "journal.previous.jsonl";
  /// A longer record is not kept: 64 MiB, predictions of 6e6 rows.
  static constexpr std::size_t kLongestRecord = std::size_t{64} << 20U;

  /// Throws data::InputError where FOLDER/journal.jsonl is there and is no
  /// journal: never where it is no plain file, which could not be read to an
  /// end; `force` lets another file be set aside or added to.
  static void RequireNoOther(const std::string& folder, bool force);

  /// Throws std::system_error naming the path that cannot be written, and
  /// std::runtime_error where another process has the folder's journal open.
  /// With `most_bytes` the file is a cache, of no more bytes than that: it does
  /// not outlast a loss of power.
  JournalFile(const std::string& folder,
              Opening opening,
              std::optional<std::int64_t> most_bytes = std::nullopt);
  ~JournalFile();
  JournalFile(const JournalFile&) = delete;
  JournalFile& operator=(const JournalFile&) = delete;

  /// Fits found at the opening.
  std::size_t num_found() const { return found_.size(); }
  bool Has(const FitLabel& label) const;
  /// The outcome of a fit of the same key; empty where it cannot be read.
  std::optional<FitOutcome> Find(const FitLabel& label) const;
  /// The last fit found that stands at the place of `label`, or null: what it
  /// differs in is why the fit has to be made again.
  const FitLabel* FindPlace(const FitLabel& label) const;

  /// Adds a fit. What cannot be written (a full disk) is given up and counted:
  /// it costs a repetition later, not the results now.
  void Record(const FitLabel& label, const FitOutcome& outcome);

  /// What people should know of what was found, a line each.
  std::vector<std::string> OpeningRemarks() const;
  /// A record of the right label that is not of its fit: counted for the
  /// remarks; the fit is made again.
  void CountUnfit() { ++unfit_; }

  /// Of what could not be kept or not be used, a line each.
  std::vector<std::string> WritingRemarks() const;

 private:
  struct Extent {  // of a record in the file
    std::int64_t offset = 0;
    std::size_t length = 0;
  };
  using Place = std::tuple<std::string, std::string, std::size_t, std::string>;

  static Place PlaceOf(const FitLabel& label);
  void SetAside();
  void ReadAll();
  bool ReadLine(std::string_view line, std::int64_t offset);
  void Append(std::string_view line);
  void Flush();

  std::string path_;
  std::string previous_path_;
  std::optional<std::int64_t> most_bytes_;
  data::FileDescriptor file_;
  bool set_aside_ = false;
  std::size_t damaged_lines_ = 0;
  std::map<std::string, Extent> found_;  // by key
  std::map<Place, FitLabel> places_;

  mutable std::atomic<std::size_t> unfit_ = 0;
  mutable std::mutex mutex_;  // of all that follows
  std::int64_t size_ = 0;     // up to the last whole line
  bool torn_ = false;         // a piece of a line could not be taken back
  double seconds_at_stake_ = 0.0;
  std::size_t unwritten_ = 0;
  std::size_t too_long_ = 0;
  int error_ = 0;  // errno of the first failure
};

/// The journal of one component's study in a file that all components share,
/// or in several: what one has, those before it are given.
class ComponentJournal final : public FitJournal {
 public:
  /// All must outlive it; null files are left out.
  ComponentJournal(std::vector<JournalFile*> files,
                   const FitLabels* labels,
                   const data::Dataset* dataset,
                   const std::vector<Holdout>* holdouts)
      : files_(std::move(files)),
        labels_(*labels),
        dataset_(*dataset),
        holdouts_(*holdouts) {
    std::erase(files_, nullptr);
  }

  /// Sums in a journal keep damage out and forgers not: the map found must
  /// predict what stands beside it, bit for bit, on the rows that it is judged
  /// by.
  std::optional<FitOutcome> Find(const StudyTask& task) override;
  void Record(const StudyTask& task, const FitOutcome& outcome) override {
    for (JournalFile* file : files_) file->Record(labels_.Of(task), outcome);
  }

 private:
  bool IsOf(const StudyTask& task, const FitOutcome& outcome) const;

  std::vector<JournalFile*> files_;
  const FitLabels& labels_;
  const data::Dataset& dataset_;
  const std::vector<Holdout>& holdouts_;
};

/// How many fits of a study are at hand, and why others are made again; a line
/// each.
std::vector<std::string> DescribeResume(const JournalFile& file,
                                        const FitLabels& labels);

}  // namespace errmap::models
