#include "data/files/shown_path.h"

#include <atomic>
#include <filesystem>

namespace errmap::data {
namespace {

std::atomic<bool> keeps_paths = false;

}  // namespace

void KeepPaths() { keeps_paths = true; }

std::string ShownPath(const std::string& path) {
  if (keeps_paths || !path.starts_with('/')) return path;
  std::string name = std::filesystem::path(path).filename().string();
  // Of "/home/me/" the folder's own name; "/" has none.
  if (!name.empty()) return name;
  return std::filesystem::path(path).parent_path().filename().string();
}

}  // namespace errmap::data
