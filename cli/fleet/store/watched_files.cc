#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "cli/fleet/store/watched_maps.h"
#include "data/input_error.h"
#include "data/text.h"

namespace errmap::fleet {
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

std::string FolderOf(const fs::path& path) {
  return path.parent_path().filename().string();
}

class Finder {
 public:
  Finder(const FleetRecord& study, const std::vector<Deployment>& deployments)
      : deployments_(deployments) {
    for (const Deployment& deployment : deployments) {
      Know(deployment.component, deployment.data, &deployment);
    }
    for (const FleetComponentRecord& component : study.components) {
      if (!known_.contains(component.name)) {
        Know(component.name, component.data, nullptr);
      }
    }
  }

  void Add(const std::string& path) {
    const std::size_t equals = path.find('=');
    std::error_code ignored;
    if (equals == path.npos || fs::exists(path, ignored)) {
      for (const std::string& file : FilesOf(path)) AddFile(file);
      return;
    }
    const std::string name = path.substr(0, equals);
    const auto named =
        std::ranges::find(deployments_, name, &Deployment::component);
    if (named == deployments_.end()) {
      throw data::InputError(fmt::format(
          "{} has no map deployed; errmap deploy STORE COMPONENT does that",
          data::QuotedName(name)));
    }
    const std::string file = path.substr(equals + 1);
    if (!fs::is_regular_file(file, ignored)) {
      throw data::InputError(data::PrintablePath(file) +
                             ": is not a file that can be read");
    }
    found_.files.push_back({file, &*named});
  }

  WatchedFiles Found() {
    std::ranges::stable_sort(found_.files, {}, &WatchedFile::deployment);
    return std::move(found_);
  }

 private:
  struct Component {
    std::string name;
    std::string data;
    const Deployment* deployment = nullptr;  // null: none
  };

  void Know(const std::string& name,
            const std::string& data,
            const Deployment* deployment) {
    known_.insert(name);
    folders_.insert(FolderOf(data));
    by_file_[fs::path(data).filename().string()].push_back(
        {name, data, deployment});
  }

  // Of the components whose data have the file's name those whose folders are
  // most like its own.
  std::vector<Component> AlikeMost(const std::string& file) {
    std::vector<Component> alike;
    std::size_t most = 0;
    for (const Component& component :
         by_file_[fs::path(file).filename().string()]) {
      const std::size_t names = AlikeAtTheEnd(file, component.data);
      if (names > most) alike.clear();
      if (names >= most) alike.push_back(component);
      most = std::max(most, names);
    }
    const std::string folder = FolderOf(file);
    if (most == 1 && folders_.contains(folder) &&
        folder != FolderOf(alike.front().data)) {
      return {};
    }
    return alike;
  }

  void AddFile(const std::string& file) {
    const std::vector<Component> alike = AlikeMost(file);
    if (alike.size() == 1 && alike.front().deployment != nullptr) {
      found_.files.push_back({file, alike.front().deployment});
      return;
    }
    found_.unknown.push_back(file);
    const bool matters =
        std::ranges::any_of(alike, [](const Component& component) {
          return component.deployment != nullptr;
        });
    if (alike.size() < 2 || !matters) return;
    found_.remarks.push_back(
        fmt::format("{} may be of {} or of {}: keep the folders of the study, "
                    "or write COMPONENT=FILE",
                    data::PrintablePath(file),
                    data::QuotedName(alike[0].name),
                    data::QuotedName(alike[1].name)));
  }

  const std::vector<Deployment>& deployments_;
  std::set<std::string> known_;    // names
  std::set<std::string> folders_;  // that data lie in
  std::map<std::string, std::vector<Component>> by_file_;
  WatchedFiles found_;
};

}  // namespace

WatchedFiles FindWatchedFiles(const FleetRecord& study,
                              const std::vector<Deployment>& deployments,
                              const std::vector<std::string>& paths) {
  Finder finder(study, deployments);
  for (const std::string& path : paths) finder.Add(path);
  return finder.Found();
}

}  // namespace errmap::fleet
