#include "data/files/prepare_folder.h"

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <unistd.h>

#include "data/text.h"

namespace errmap::data {

void PrepareFolder(const std::string& path) {
  const auto refuse = [&](std::error_code why) {
    throw std::system_error(
        why, "cannot write into the folder " + PrintablePath(path));
  };
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) refuse(error);
  if (access(path.c_str(), W_OK | X_OK) != 0) {
    refuse({errno, std::generic_category()});
  }
}

}  // namespace errmap::data
