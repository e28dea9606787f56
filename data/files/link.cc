#include "data/files/link.h"

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <unistd.h>

#include <sys/stat.h>

#include "data/text.h"

namespace errmap::data {

bool IsLink(const std::string& path) {
  struct stat status {};
  return lstat(path.c_str(), &status) == 0 && S_ISLNK(status.st_mode);
}

bool IsInOwnFolder(const std::string& path) {
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) folder = ".";
  struct stat status {};
  return stat(folder.c_str(), &status) == 0 && status.st_uid == geteuid();
}

void RequireOwnLink(const std::string& path) {
  if (!IsLink(path) || IsInOwnFolder(path)) return;
  throw std::system_error(
      EPERM,
      std::generic_category(),
      "cannot write " + PrintablePath(path) +
          ", which is a link in the folder of another user (remove it, or name "
          "another file)");
}

void RemoveLink(const std::string& path, bool forced) {
  if (!IsLink(path)) return;
  if (!forced) RequireOwnLink(path);
  if (unlink(path.c_str()) == 0 || errno == ENOENT) return;
  throw std::system_error(
      errno, std::generic_category(), "cannot write " + PrintablePath(path));
}

}  // namespace errmap::data
