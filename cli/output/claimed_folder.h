#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::cli {

/// Refuses to write `output`, which the user named by `flag`, where it is the
/// same file as one of `inputs`, links followed, or "-", by which others mean
/// standard output. Throws UsageError naming both.
void CheckOutputName(const std::string& flag,
                     const std::string& output,
                     const std::vector<std::string>& inputs);

/// Refuses what would be found out only after the work: `output`, a file named
/// by the user, is a folder, or lies in one that is not there or cannot be
/// written to. Throws std::system_error as the writing would.
void RequirePlaceFor(const std::string& output);

/// A folder that errmap writes files of its own names into. errmap-files.json
/// there says which it wrote, so that a later run replaces these and no others:
///
///   {"schema": "errmap-files-1",
///    "files": [{"name": "models/mean.json", "sha256": "..." or null}]}
///
/// null: a run was writing it and may have been broken off.
class ClaimedFolder {
 public:
  static constexpr const char* kListName = "errmap-files.json";

  /// Makes the folder and looks whether the files `names` (relative to it) may
  /// be written. Changes nothing in it. Throws UsageError where one of them is
  /// a file of `inputs`, or, unless `force`, is there and is not as errmap left
  /// it; std::system_error where the folder cannot be made or written to.
  ClaimedFolder(std::string path,
                const std::vector<std::string>& names,
                const std::vector<std::string>& inputs,
                bool force);

  /// Writes one of `names`, whole or not at all; folders on the way to it are
  /// made. Throws std::system_error naming the path.
  void Write(const std::string& name, std::string_view content);

  /// Writes errmap-files.json with the hashes of what was written; what earlier
  /// runs wrote under other names stays in it.
  void Finish();

  std::string PathOf(const std::string& name) const;

 private:
  void ReadList(bool force);
  void WriteList() const;
  bool IsAsWeLeftIt(const std::string& name) const;

  std::string path_;
  std::vector<std::string> names_;
  // By name; nothing where a file may be in the making.
  std::map<std::string, std::optional<std::string>> hashes_;
  std::map<std::string, std::optional<std::string>> earlier_;
  bool is_begun_ = false;
};

}  // namespace errmap::cli
