#include "cli/fleet/watched_files.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>

#include <fmt/format.h>

#include "data/input_error.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

namespace fs = std::filesystem;

// Names from the last to the first.
std::vector<std::string> Backwards(const fs::path& path) {
  std::vector<std::string> names;
  for (const fs::path& name : path.lexically_normal()) {
    names.insert(names.begin(), name.string());
  }
  return names;
}

std::size_t AlikeAtTheEnd(const fs::path& a, const fs::path& b) {
  const std::vector<std::string> of_a = Backwards(a);
  const std::vector<std::string> of_b = Backwards(b);
  const auto end = std::ranges::mismatch(of_a, of_b);
  return static_cast<std::size_t>(end.in1 - of_a.begin());
}

std::vector<std::string> FilesOf(const std::string& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) return {path};
  std::vector<std::string> files;
  fs::recursive_directory_iterator entry(path, error);
  if (error) {
    throw data::InputError(data::PrintablePath(path) +
                           ": is neither a file nor a folder that can be read");
  }
  for (const fs::recursive_directory_iterator end; !error && entry != end;
       entry.increment(error)) {
    if (entry->is_regular_file(error) && entry->path().extension() == ".csv") {
      files.push_back(entry->path().string());
    }
  }
  std::ranges::sort(files);
  return files;
}

class Finder {
 public:
  explicit Finder(const std::vector<Deployment>& deployments)
      : deployments_(deployments) {
    for (const Deployment& deployment : deployments) {
      by_file_[fs::path(deployment.data).filename().string()].push_back(
          &deployment);
    }
  }

  void Add(const std::string& path) {
    const std::size_t equals = path.find('=');
    std::error_code ignored;
    if (equals != path.npos && !fs::exists(path, ignored)) {
      const std::string name = path.substr(0, equals);
      const auto named =
          std::ranges::find(deployments_, name, &Deployment::component);
      if (named == deployments_.end()) {
        throw data::InputError(fmt::format(
            "{} has no map deployed; errmap deploy STORE COMPONENT does that",
            data::QuotedName(name)));
      }
      found_.files.push_back({path.substr(equals + 1), &*named});
      return;
    }
    for (const std::string& file : FilesOf(path)) AddFile(file);
  }

  WatchedFiles Found() {
    std::ranges::stable_sort(found_.files, {}, &WatchedFile::deployment);
    return std::move(found_);
  }

 private:
  void AddFile(const std::string& file) {
    const auto alike = by_file_.find(fs::path(file).filename().string());
    if (alike == by_file_.end()) {
      found_.unknown.push_back(file);
      return;
    }
    const Deployment* best = nullptr;
    const Deployment* rival = nullptr;
    std::size_t most = 0;
    for (const Deployment* deployment : alike->second) {
      const std::size_t names = AlikeAtTheEnd(file, deployment->data);
      if (names > most) {
        best = deployment;
        rival = nullptr;
        most = names;
      } else if (names == most) {
        rival = deployment;
      }
    }
    if (rival == nullptr) {
      found_.files.push_back({file, best});
      return;
    }
    found_.unknown.push_back(file);
    found_.remarks.push_back(
        fmt::format("{} may be of {} or of {}: keep the folders of the study, "
                    "or write COMPONENT=FILE",
                    data::PrintablePath(file),
                    data::QuotedName(best->component),
                    data::QuotedName(rival->component)));
  }

  const std::vector<Deployment>& deployments_;
  std::map<std::string, std::vector<const Deployment*>> by_file_;
  WatchedFiles found_;
};

}  // namespace

WatchedFiles FindWatchedFiles(const std::vector<Deployment>& deployments,
                              const std::vector<std::string>& paths) {
  Finder finder(deployments);
  for (const std::string& path : paths) finder.Add(path);
  return finder.Found();
}

}  // namespace errmap::cli
