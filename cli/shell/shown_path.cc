#include "cli/shell/shown_path.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>

namespace errmap::cli {
namespace {

bool keeps_paths = false;

}  // namespace

void KeepPaths() { keeps_paths = true; }

std::string ShownPath(const std::string& path) {
  if (keeps_paths || !path.starts_with('/')) return path;
  const std::string name = std::filesystem::path(path).filename().string();
  // Of "/home/me/" the folder's own name; "/" has none.
  if (!name.empty()) return name;
  return std::filesystem::path(path).parent_path().filename().string();
}

std::string ShownWord(const std::string& word) {
  if (keeps_paths) return word;
  if (word.starts_with('/')) return ShownPath(word);  // commas are part of it
  std::string shown;
  for (std::size_t at = 0; at < word.size();) {
    const bool begins =
        word[at] == '/' && at > 0 &&
        std::string("=:,\"").find(word[at - 1]) != std::string::npos;
    if (!begins) {
      shown += word[at++];
      continue;
    }
    const std::size_t end =
        std::min(word.find_first_of(",\"", at), word.size());
    shown += ShownPath(word.substr(at, end - at));
    at = end;
  }
  return shown;
}

}  // namespace errmap::cli
