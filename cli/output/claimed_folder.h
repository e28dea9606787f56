#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::cli {

/// Refuses `output`, which the user named with `flag`, if it is one of the
/// files `inputs` (links are followed), or "-", which usually means standard
/// output. Throws UsageError naming both.
void CheckOutputName(const std::string& flag,
                     const std::string& output,
                     const std::vector<std::string>& inputs);

/// Checks `output`, a file named by the user, before the work starts. It must
/// not be a folder, and its folder must exist and be writable. Throws
/// std::system_error, as writing would.
void RequirePlaceFor(const std::string& output);

/// A folder into which errmap writes files with its own names. Its
/// errmap-files.json lists what errmap wrote, so that a later run replaces only
/// these files:
///
///   {"schema": "errmap-files-1",
///    "files": [{"name": "models/mean.json", "sha256": "..." or null}]}
///
/// null: a run was writing this file and may have been interrupted.
class ClaimedFolder {
 public:
  static constexpr const char* kListName = "errmap-files.json";

  /// Makes the folder and checks that the files `names` (relative to it) may be
  /// written; changes no file. Throws UsageError if one of them is a file of
  /// `inputs`, or exists and differs from what errmap wrote (unless `force`).
  /// Throws std::system_error if the folder cannot be made or written to.
  ClaimedFolder(std::string path,
                const std::vector<std::string>& names,
                const std::vector<std::string>& inputs,
                bool force);

  /// Writes the file `name`, one of `names`, completely or not at all, and
  /// makes missing folders. Throws std::system_error that names the path.
  void Write(const std::string& name, std::string_view content);

  /// Writes errmap-files.json with the hashes of the written files. Entries of
  /// earlier runs under other names are kept.
  void Finish();

  std::string PathOf(const std::string& name) const;

 private:
  void ReadList(bool force);
  void WriteList() const;
  bool IsAsWeLeftIt(const std::string& name) const;

  std::string path_;
  std::vector<std::string> names_;
  // By name; nothing if a file may be half-written.
  std::map<std::string, std::optional<std::string>> hashes_;
  std::map<std::string, std::optional<std::string>> earlier_;
  bool is_begun_ = false;
};

}  // namespace errmap::cli
