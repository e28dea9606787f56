#include "cli/output/claimed_folder.h"

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "cli/command.h"
#include "data/files/atomic_file.h"
#include "data/files/prepare_folder.h"
#include "data/files/sheet_path.h"
#include "data/formats/nesting.h"
#include "data/sha256.h"
#include "data/text.h"
#include "models/record_json.h"

namespace errmap::cli {

struct WrittenFile {
  std::string name;
  std::optional<std::string> sha256;  // nothing until it is written
};
struct WrittenFiles {
  std::string schema;
  std::vector<WrittenFile> files;
};

namespace {

namespace fs = std::filesystem;

constexpr const char* kSchema = "errmap-files-1";

}  // namespace

void CheckOutputName(const std::string& flag,
                     const std::string& output,
                     const std::vector<std::string>& inputs) {
  // A bare "-" on the command line is standard input by now.
  if (output == "-" || output == "/dev/stdin") {
    throw UsageError(flag +
                     ": - names no file; name one (./- is one of that "
                     "name)");
  }
  for (const std::string& input : inputs) {
    if (!data::IsSameFile(output, input)) continue;
    throw UsageError(
        fmt::format("{}: {} would overwrite {}, which is read; name another",
                    flag,
                    data::PrintablePath(output),
                    output == input ? "itself" : data::PrintablePath(input)));
  }
}

void RequirePlaceFor(const std::string& output) {
  if (output.empty()) return;
  const auto refuse = [&](std::error_code why) {
    throw std::system_error(why, "cannot write " + data::PrintablePath(output));
  };
  std::error_code unknown;
  const fs::file_status there = fs::status(output, unknown);
  if (fs::is_directory(there)) {
    refuse(std::make_error_code(std::errc::is_a_directory));
  }
  // Devices and pipes are written to as they are, without their folder.
  if (fs::exists(there) && !fs::is_regular_file(there)) return;
  const fs::path parent = fs::path(output).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (fs::exists(folder, unknown) && !fs::is_directory(folder, unknown)) {
    refuse(std::make_error_code(std::errc::not_a_directory));
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    refuse({errno, std::generic_category()});
  }
}

ClaimedFolder::ClaimedFolder(std::string path,
                             const std::vector<std::string>& names,
                             const std::vector<std::string>& inputs,
                             bool force)
    : path_(std::move(path)), names_(names) {
  for (const std::string& name : names_) {
    CheckOutputName("output folder", PathOf(name), inputs);
  }
  ReadList(force);
  for (const std::string& name : names_) {
    std::error_code ignored;
    if (force || !fs::exists(fs::symlink_status(PathOf(name), ignored)) ||
        IsAsWeLeftIt(name)) {
      continue;
    }
    throw UsageError(fmt::format(
        "{} stands in the way: it is not as errmap left it; choose another "
        "folder, move it away, or replace it with --force",
        data::PrintablePath(PathOf(name))));
  }
  data::PrepareFolder(path_);
}

std::string ClaimedFolder::PathOf(const std::string& name) const {
  return (fs::path(path_) / name).string();
}

void ClaimedFolder::ReadList(bool force) {
  const std::string path = PathOf(kListName);
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(path, ignored))) return;
  if (fs::is_regular_file(path, ignored)) {
    const std::string text = data::ReadFile(path, data::kMostTextOfPeople);
    models::record_json::Tree json;
    WrittenFiles list;
    if (data::IsShallowJson(text) && json.Parse(text) &&
        models::FromJson(*json.root(), &list) && list.schema == kSchema) {
      for (const WrittenFile& file : list.files) {
        if (!file.name.empty()) hashes_[file.name] = file.sha256;
      }
      return;
    }
  }
  if (force) return;
  throw UsageError(
      fmt::format("{} is not errmap's list of the files that it wrote; choose "
                  "another folder, move it away, or replace it with --force",
                  data::PrintablePath(path)));
}

bool ClaimedFolder::IsAsWeLeftIt(const std::string& name) const {
  const auto found = hashes_.find(name);
  std::error_code ignored;
  if (found == hashes_.end() || !fs::is_regular_file(PathOf(name), ignored)) {
    return false;
  }
  return !found->second.has_value() ||
         data::Sha256(data::ReadFile(PathOf(name))) == *found->second;
}

void ClaimedFolder::Write(const std::string& name, std::string_view content) {
  if (!is_begun_) {
    earlier_ = hashes_;
    for (const std::string& claimed : names_) hashes_[claimed].reset();
    WriteList();
    is_begun_ = true;
  }
  const std::string path = PathOf(name);
  data::PrepareFolder(fs::path(path).parent_path().string());
  data::WriteFileAtomically(path, content);
  hashes_[name] = data::Sha256(content);
}

void ClaimedFolder::Finish() {
  // A model that failed has no file, or that of an earlier run.
  for (const std::string& name : names_) {
    if (hashes_[name].has_value()) continue;
    hashes_.erase(name);
    std::error_code ignored;
    if (earlier_.contains(name) && fs::exists(PathOf(name), ignored)) {
      hashes_[name] = earlier_[name];
    }
  }
  WriteList();
}

void ClaimedFolder::WriteList() const {
  WrittenFiles list{.schema = kSchema, .files = {}};
  for (const auto& [name, hash] : hashes_) list.files.push_back({name, hash});
  data::WriteFileAtomically(PathOf(kListName),
                            models::JsonText(list, 1) + "\n");
}

}  // namespace errmap::cli
