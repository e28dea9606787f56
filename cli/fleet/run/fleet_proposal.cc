#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <map>
#include <new>
#include <vector>

#include <fmt/format.h>

#include "cli/fleet/run/fleet_run.h"
#include "cli/study_setup/plan/study_plan.h"
#include "cli/study_setup/toml/toml_text.h"
#include "data/argument_name.h"
#include "data/input_error.h"
#include "data/measurements/measured_files.h"
#include "data/text.h"

namespace errmap::fleet {
namespace {

namespace fs = std::filesystem;

using study_setup::TomlText;

constexpr int kDeepest = 6;

// What stands at the end of a name and tells in which direction was measured.
constexpr auto kMotionWords = std::to_array<std::string_view>({
    // clang-format off
    "down", "up", "forward", "reverse", "fwd", "rev", "backward", "plus",
    "minus", "pos", "neg", "left", "right", "in", "out",
    // clang-format on
});

// "x_down" taken apart; no direction if there is none.
struct Stem {
  std::string component;
  std::string direction;
};
Stem Apart(const std::string& stem) {
  const std::size_t at = stem.rfind('_');
  if (at != stem.npos && at > 0 &&
      std::ranges::find(kMotionWords, stem.substr(at + 1)) !=
          kMotionWords.end()) {
    return {stem.substr(0, at), stem.substr(at + 1)};
  }
  return {stem, ""};
}

// Files below a folder that lie equally deep.
struct Level {
  std::vector<std::vector<std::string>> folders;  // of each file
  std::vector<std::string> stems;
};

std::map<std::size_t, Level> LevelsOf(const std::string& folder) {
  std::map<std::size_t, Level> levels;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, error);
  if (error) {
    throw data::InputError(data::PrintablePath(folder) +
                           ": cannot be read: " + error.message());
  }
  std::set<fs::path> files;  // in an order of their own
  for (const fs::recursive_directory_iterator end; !error && entry != end;
       entry.increment(error)) {
    const fs::path path = entry->path().lexically_relative(folder);
    if (path.filename().string().starts_with('.') ||
        entry.depth() >= kDeepest) {
      entry.disable_recursion_pending();
      continue;
    }
    // Braces would be fields.
    if (!entry->is_regular_file(error) || path.extension() != ".csv" ||
        data::IsOfComparison(entry->path().string()) ||
        path.string().find_first_of("{}|") != std::string::npos) {
      continue;
    }
    files.insert(path);
  }
  for (const fs::path& path : files) {
    std::vector<std::string> folders;
    for (const fs::path& name : path.parent_path()) {
      folders.push_back(name.string());
    }
    Level& level = levels[folders.size()];
    level.folders.push_back(std::move(folders));
    level.stems.push_back(path.stem().string());
  }
  return levels;
}

bool CanBeMapped(const std::string& file, const std::string& target) {
  study_setup::ComponentConfig component;
  component.data = file;
  component.selection.target = target;
  study_setup::StudyConfig study;
  study.models = {"mean"};
  study.components = {component};
  try {
    study_setup::PlanStudy(study);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return false;
  }
  return true;
}

// The patterns of one level.
class LevelPatterns {
 public:
  LevelPatterns(const std::string& folder,
                const Level& level,
                const std::string& target)
      : level_(level) {
    struct Looks {
      int taken = 0;
      bool good = false;
    };
    std::map<std::string, Looks> looks;
    for (std::size_t i = 0; i < level.stems.size(); ++i) {
      // Names that are all different are not kinds of files.
      constexpr std::size_t kMostKinds = 60;
      constexpr int kMostOfAKind = 3;
      const std::string& stem = level.stems[i];
      Looks& of = looks[stem];
      if (of.good || of.taken == kMostOfAKind) continue;
      ++of.taken;
      fs::path file = folder;
      for (const std::string& name : level.folders[i]) file /= name;
      of.good = looks.size() > kMostKinds ||
                CanBeMapped((file / (stem + ".csv")).string(), target);
    }
    for (const std::string& stem : level.stems) {
      if (!looks[stem].good) {
        left_out_.insert(stem);
        continue;
      }
      ++files_;
      const Stem apart = Apart(stem);
      auto& of = apart.direction.empty() ? plain_ : directed_;
      of.components.insert(apart.component);
      of.directions.insert(apart.direction);
    }
  }

  long long files() const { return files_; }
  const std::set<std::string>& left_out() const { return left_out_; }

  std::string Text(const std::string& beside, const std::string& target) const {
    const auto [path, name] = Folders();
    std::string text;
    if (!directed_.components.empty()) {
      text += Component(beside,
                        target,
                        path + Field("component", directed_.components) + "_" +
                            Words("direction", directed_.directions),
                        name + "{component}, {direction}");
    }
    if (!plain_.components.empty()) {
      text += Component(beside,
                        target,
                        path + Field("component", plain_.components),
                        name + "{component}");
    }
    return text;
  }

 private:
  struct Kind {
    std::set<std::string> components;
    std::set<std::string> directions;
  };

  // "{machine}/spring/", and the part of a name.
  std::pair<std::string, std::string> Folders() const {
    std::string path;
    std::string name;
    int fields = 0;
    const std::size_t depth = level_.folders.front().size();
    for (std::size_t i = 0; i < depth; ++i) {
      const std::string& first = level_.folders.front()[i];
      if (std::ranges::all_of(level_.folders, [&](const auto& folders) {
            return folders[i] == first;
          })) {
        path += first + "/";
        continue;
      }
      const std::string field = fields == 0   ? "machine"
                                : fields == 1 ? "campaign"
                                              : fmt::format("level{}", fields);
      ++fields;
      path += "{" + field + "}/";
      name += "{" + field + "}/";
    }
    return {path, name};
  }

  // Any, unless files that cannot be mapped lie among them.
  std::string Field(const std::string& field,
                    const std::set<std::string>& words) const {
    return left_out_.empty() ? "{" + field + "}" : Words(field, words);
  }
  static std::string Words(const std::string& field,
                           const std::set<std::string>& words) {
    return fmt::format(
        "{{{}:{}}}", field, data::JoinWords({words.begin(), words.end()}, "|"));
  }

  static std::string Component(const std::string& beside,
                               const std::string& target,
                               const std::string& path,
                               const std::string& name) {
    const std::string folder = beside == "." ? "" : beside + "/";
    return fmt::format(
        "\n[[component]]\nname = {}\ndata = {}\n{}# goal = 0.0005   # in the "
        "target's unit\n# exclude = [\"humidity\"]\n",
        TomlText(name),
        TomlText(folder + path + ".csv"),
        target.empty() ? "# target = \"error_mm\"   # default: the only column "
                         "named error*\n"
                       : "target = " + TomlText(target) + "\n");
  }

  const Level& level_;
  Kind directed_;
  Kind plain_;
  long long files_ = 0;
  std::set<std::string> left_out_;
};

}  // namespace

FleetProposal ProposeFleet(const std::string& folder,
                           const std::string& beside,
                           const std::string& target,
                           const std::string& usage) {
  FleetProposal proposal;
  proposal.text =
      "# A study of many components: " + usage +
      "\n# {fields} of a path stand for the parts that differ; words after a "
      "colon are a\n# field's only values. Each component is studied "
      "separately, and a failed one\n# does not stop the others.\n\n"
      "seed = 1\n# models = [\"mean\", \"poly:ridge:view=history\", "
      "\"net:scg\"]   # default: all suitable\n"
      "# holdouts = [\"sessions:5\"]\n";
  for (const auto& [depth, level] : LevelsOf(folder)) {
    const LevelPatterns patterns(folder, level, target);
    proposal.files += patterns.files();
    proposal.left_out.insert(patterns.left_out().begin(),
                             patterns.left_out().end());
    if (patterns.files() > 0) proposal.text += patterns.Text(beside, target);
  }
  if (proposal.files > 0) return proposal;
  throw data::InputError(
      data::PrintablePath(folder) +
      ": no CSV file below it that can be mapped; name the column with " +
      data::ArgumentName("target") +
      ", or give one file to errmap init to see why");
}

}  // namespace errmap::fleet
