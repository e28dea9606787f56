#include "models/study/journal/fit_journal_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include "data/argument_name.h"
#include "data/files/link.h"
#include "data/input_error.h"
#include "data/sha256.h"
#include "data/text.h"
#include "models/study/journal/fit_record.h"

namespace errmap::models {
namespace {

using data::FileDescriptor;

constexpr std::string_view kBeforeSum = R"({"sum":")";
constexpr std::string_view kBeforeLabel = R"(","fit":)";
// Cannot stand in a label, whose quotation marks are escaped.
constexpr std::string_view kBeforeOutcome = R"(,"outcome":)";
constexpr std::size_t kSumLength = 64;

[[noreturn]] void ThrowUnwritable(const std::string& path, int error) {
  throw std::system_error(error,
                          std::generic_category(),
                          "cannot write " + data::PrintablePath(path));
}

bool SameFile(int descriptor, const std::string& path) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

// Open for this process alone. Where the file system knows no locks, the run is
// worth more than the protection.
int OpenLocked(const std::string& path) {
  constexpr mode_t kMode = 0666;  // less the umask
  for (;;) {
    // RequireNoOther has refused a link that may not be replaced.
    data::RemoveLink(path, true);
    FileDescriptor file(
        open(path.c_str(),
             O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW,
             kMode));
    if (!file.is_open()) ThrowUnwritable(path, errno);
    if (flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      throw std::runtime_error(
          fmt::format("{}: another errmap is at work in this folder; wait for "
                      "its end or choose another folder",
                      data::PrintablePath(path)));
    }
    // It may have been set aside between the opening and the locking.
    if (SameFile(file.get(), path)) return file.Release();
  }
}

std::string LineOf(const FitLabel& label, const FitOutcome& outcome) {
  std::string rest{kBeforeLabel};
  rest += LabelToText(label);
  rest += kBeforeOutcome;
  rest += FitToText(outcome);
  rest += "}";
  std::string line{kBeforeSum};
  line += data::Sha256(rest);
  line += rest;
  line += "\n";
  return line;
}

// The part of a line that its sum is of, or "" where they do not agree.
std::string_view CheckedRest(std::string_view line) {
  if (!line.starts_with(kBeforeSum)) return {};
  line.remove_prefix(kBeforeSum.size());
  if (line.size() < kSumLength) return {};
  const std::string_view rest = line.substr(kSumLength);
  if (data::Sha256(rest) != line.substr(0, kSumLength)) return {};
  return rest.starts_with(kBeforeLabel) ? rest : std::string_view();
}

std::string Count(std::size_t number, const char* what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

// The words of `text` that `other` has not.
std::string WordsOnlyIn(const std::string& text, const std::string& other) {
  const auto words = [](const std::string& line) {
    std::istringstream stream(line);
    return std::vector<std::string>(std::istream_iterator<std::string>(stream),
                                    {});
  };
  const std::vector<std::string> known = words(other);
  std::string only;
  for (const std::string& word : words(text)) {
    if (std::ranges::count(known, word) > 0) continue;
    only += (only.empty() ? "" : " ") + word;
  }
  return only.empty() ? "nothing" : only;
}

// Why `found`, which stands in the place of `wanted`, does not serve.
std::string WhyNot(const FitLabel& found, const FitLabel& wanted) {
  if (found.program != wanted.program) {
    return found.program + " -> " + wanted.program;
  }
  if (found.options != wanted.options) {
    return fmt::format(
        "{}: {} -> {}", wanted.model, found.options, wanted.options);
  }
  if (found.context != wanted.context) {
    return WordsOnlyIn(found.context, wanted.context) + " -> " +
           WordsOnlyIn(wanted.context, found.context);
  }
  if (found.rows != wanted.rows) return "the data that they see have changed";
  return "their record cannot be read";
}

}  // namespace

JournalFile::JournalFile(const std::string& folder,
                         Opening opening,
                         std::optional<std::int64_t> most_bytes)
    : path_(std::filesystem::path(folder) / kName),
      previous_path_(std::filesystem::path(folder) / kPreviousName),
      most_bytes_(most_bytes),
      file_(OpenLocked(path_)) {
  if (opening == Opening::kAnew) {
    SetAside();
  } else {
    ReadAll();
  }
}

void JournalFile::RequireNoOther(const std::string& folder, bool force) {
  const std::string path = std::filesystem::path(folder) / kName;
  if (data::IsLink(path)) {
    if (force || data::IsInOwnFolder(path)) return;
    throw data::InputError(data::PrintablePath(path) +
                           ": is a link in the folder of another user; choose "
                           "another folder, move it away, or go on with " +
                           data::ArgumentName("force"));
  }
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) return;
  if (!S_ISREG(status.st_mode)) {
    throw data::InputError(data::PrintablePath(path) +
                           ": is no plain file; move it away or choose another "
                           "folder");
  }
  // A journal's first line may be torn anywhere.
  std::ifstream stream(path, std::ios::binary);
  std::string begin(kBeforeSum.size(), '\0');
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(stream.gcount()));
  if (force || kBeforeSum.starts_with(begin)) return;
  throw data::InputError(data::PrintablePath(path) +
                         ": is no journal of errmap; choose another folder, "
                         "move it away, or go on with " +
                         data::ArgumentName("force"));
}

JournalFile::~JournalFile() { Flush(); }

void JournalFile::SetAside() {
  struct stat status {};
  if (fstat(file_.get(), &status) != 0) ThrowUnwritable(path_, errno);
  if (status.st_size == 0) return;
  if (rename(path_.c_str(), previous_path_.c_str()) != 0) {
    ThrowUnwritable(previous_path_, errno);
  }
  // The old lock is kept until the new one is had.
  FileDescriptor fresh(OpenLocked(path_));
  file_ = std::move(fresh);
  set_aside_ = true;
}

void JournalFile::ReadAll() {
  std::ifstream stream(path_, std::ios::binary);
  std::string line;
  while (std::getline(stream, line) && !stream.eof()) {
    if (!ReadLine(line, size_)) ++damaged_lines_;
    size_ += static_cast<std::int64_t>(line.size()) + 1;
  }
  if (!stream.eof()) ThrowUnwritable(path_, EIO);
  if (ftruncate(file_.get(), size_) != 0) ThrowUnwritable(path_, errno);
}

bool JournalFile::ReadLine(std::string_view line, std::int64_t offset) {
  const std::string_view rest = CheckedRest(line);
  const std::size_t split = rest.find(kBeforeOutcome);
  if (split == std::string_view::npos) return false;
  FitLabel label;
  try {
    label = LabelFromText(
        rest.substr(kBeforeLabel.size(), split - kBeforeLabel.size()));
  } catch (const data::InputError&) {
    return false;
  }
  const std::size_t begin = split + kBeforeOutcome.size();
  found_[label.Key()] = {
      offset + (rest.data() - line.data()) + static_cast<std::int64_t>(begin),
      rest.size() - begin - 1};
  places_[PlaceOf(label)] = std::move(label);
  return true;
}

JournalFile::Place JournalFile::PlaceOf(const FitLabel& label) {
  return {label.component, label.holdout, label.fold, label.model};
}

bool JournalFile::Has(const FitLabel& label) const {
  return found_.contains(label.Key());
}

std::optional<FitOutcome> JournalFile::Find(const FitLabel& label) const {
  const auto found = found_.find(label.Key());
  if (found == found_.end()) return std::nullopt;
  const Extent& extent = found->second;
  std::string text(extent.length, '\0');
  std::size_t size = 0;
  while (size < text.size()) {
    const ssize_t count =
        pread(file_.get(),
              text.data() + size,
              text.size() - size,
              extent.offset + static_cast<std::int64_t>(size));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return std::nullopt;
    size += static_cast<std::size_t>(count);
  }
  try {
    return FitFromText(text);
  } catch (const data::InputError&) {
    ++unfit_;
    return std::nullopt;
  }
}

const FitLabel* JournalFile::FindPlace(const FitLabel& label) const {
  const auto found = places_.find(PlaceOf(label));
  return found == places_.end() ? nullptr : &found->second;
}

void JournalFile::Record(const FitLabel& label, const FitOutcome& outcome) {
  // A model without a form could not be made again: it is fitted again.
  if (outcome.fitted &&
      std::holds_alternative<OpaqueForm>(outcome.fitted->model->Describe())) {
    return;
  }
  // What failed may be mended in another program's code before the next run.
  if (!outcome.fitted && most_bytes_) return;
  const std::string line = LineOf(label, outcome);
  const std::lock_guard lock(mutex_);
  const bool is_full =
      most_bytes_ &&
      size_ + static_cast<std::int64_t>(line.size()) > *most_bytes_;
  if (is_full || line.size() > kLongestRecord) {
    ++too_long_;
    return;
  }
  Append(line);
  // A kill loses nothing that was written. Against a loss of power the disk is
  // waited for once it is worth it: fits are often quicker than a disk.
  constexpr double kWorthFlushing = 0.5;
  seconds_at_stake_ += outcome.seconds;
  if (seconds_at_stake_ >= kWorthFlushing) Flush();
}

void JournalFile::Append(std::string_view line) {
  if (torn_) {
    ++unwritten_;
    return;
  }
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t written = write(file_.get(), rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      ++unwritten_;
      if (error_ == 0) error_ = errno;
      // Else the next line would be taken for the end of this one.
      torn_ = ftruncate(file_.get(), size_) != 0;
      return;
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  size_ += static_cast<std::int64_t>(line.size());
}

void JournalFile::Flush() {
  seconds_at_stake_ = 0.0;
  if (most_bytes_) return;
  if (fdatasync(file_.get()) != 0 && error_ == 0) error_ = errno;
}

std::vector<std::string> JournalFile::OpeningRemarks() const {
  const std::string path = data::PrintablePath(path_);
  std::vector<std::string> remarks;
  if (set_aside_) {
    remarks.push_back(fmt::format(
        "{}: that of an earlier run is now {}; {} would have gone on from it",
        path,
        kPreviousName,
        data::ArgumentName("resume")));
  }
  if (damaged_lines_ > 0) {
    remarks.push_back(fmt::format("{}: {} passed over; the fits are made again",
                                  path,
                                  Count(damaged_lines_, "damaged line")));
  }
  return remarks;
}

std::vector<std::string> JournalFile::WritingRemarks() const {
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
  if (error_ != 0) {
    remarks.push_back(fmt::format(
        "cannot write {}: {}; {} not kept, {} would make them again",
        path,
        std::generic_category().message(error_),
        Count(unwritten_, "fit"),
        data::ArgumentName("resume")));
  }
  return remarks;
}

std::optional<FitOutcome> ComponentJournal::Find(const StudyTask& task) {
  const FitLabel label = labels_.Of(task);
  for (auto file = files_.begin(); file != files_.end(); ++file) {
    std::optional<FitOutcome> found = (*file)->Find(label);
    if (!found) continue;
    if (IsOf(task, *found)) {
      for (auto before = files_.begin(); before != file; ++before) {
        (*before)->Record(label, *found);
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
  const Eigen::VectorXd& recorded =
      is_of_all_rows ? outcome.train_predictions : outcome.test_predictions;
  const auto predicts = [&](const data::Dataset& rows) {
    const Eigen::VectorXd predicted = outcome.fitted->Predict(rows);
    return predicted.allFinite() && predicted.size() == recorded.size() &&
           predicted == recorded;
  };
  try {
    if (outcome.fitted->model == nullptr) return false;
    if (is_of_all_rows) return predicts(dataset_);
    const Holdout& holdout = holdouts_[static_cast<std::size_t>(task.holdout)];
    const stats::Fold& fold = holdout.folds[task.fold];
    return outcome.train_predictions.allFinite() &&
           outcome.train_predictions.size() ==
               static_cast<Eigen::Index>(fold.train.size()) &&
           predicts(holdout.test_data != nullptr
                        ? *holdout.test_data
                        : dataset_.SelectRows(fold.test));
  } catch (const std::invalid_argument&) {
    return false;  // inputs that the data have not, or another number of them
  }
}

std::vector<std::string> DescribeResume(const JournalFile& file,
                                        const FitLabels& labels) {
  const std::vector<FitLabel> all = labels.All();
  std::size_t at_hand = 0;
  std::vector<std::pair<std::string, std::size_t>> reasons;  // as they come
  for (const FitLabel& label : all) {
    if (file.Has(label)) {
      ++at_hand;
      continue;
    }
    const FitLabel* found = file.FindPlace(label);
    if (found == nullptr) continue;
    const std::string why = WhyNot(*found, label);
    auto reason = reasons.begin();
    while (reason != reasons.end() && reason->first != why) ++reason;
    if (reason == reasons.end()) reason = reasons.insert(reason, {why, 0});
    ++reason->second;
  }
  std::vector<std::string> lines{
      fmt::format("{}: {} of {} are at hand, {} to be made",
                  labels.component(),
                  at_hand,
                  Count(all.size(), "fit"),
                  all.size() - at_hand)};
  for (const auto& [why, count] : reasons) {
    lines.push_back(fmt::format(
        "{}: {} made again: {}", labels.component(), Count(count, "fit"), why));
  }
  return lines;
}

}  // namespace errmap::models
