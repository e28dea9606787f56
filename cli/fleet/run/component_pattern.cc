#include "cli/fleet/run/component_pattern.h"

#include <filesystem>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "cli/study_setup/plan/component_names.h"
#include "data/input_error.h"
#include "data/text.h"

namespace errmap::fleet {
namespace {

namespace fs = std::filesystem;

using study_setup::ComponentConfig;

bool HasFields(std::string_view text) { return text.find('{') != text.npos; }

std::vector<std::string> Split(std::string_view text, char separator) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

bool IsFieldName(std::string_view name) {
  constexpr std::string_view kLetters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  return !name.empty() && name.find_first_not_of(kLetters) == name.npos;
}

// Calls with_text for what stands between fields, with_field for what stands
// between braces.
template <typename WithText, typename WithField>
void ForEachPiece(std::string_view text,
                  const WithText& with_text,
                  const WithField& with_field) {
  while (!text.empty()) {
    const std::size_t open = text.find_first_of("{}");
    if (open > 0) with_text(text.substr(0, open));
    if (open == text.npos) return;
    const std::size_t close = text.find_first_of("{}", open + 1);
    if (text[open] == '}' || close == text.npos || text[close] == '{') {
      throw std::invalid_argument("braces that do not pair: {field}");
    }
    with_field(text.substr(open + 1, close - open - 1));
    text.remove_prefix(close + 1);
  }
}

std::vector<std::string> NamesIn(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end;
       !error && entry != end;
       entry.increment(error)) {
    names.push_back(entry->path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

std::string Joined(const std::string& folder, const std::string& path) {
  if (folder.empty()) return path;
  return (fs::path(folder) / path).lexically_normal().string();
}

// A component of a study, and where its data are.
struct Sourced {
  ComponentConfig config;
  ComponentSource source;
};

// What tells the files of one pattern apart and is not in their name yet.
void TellApart(const std::string& name, const std::vector<Sourced*>& files) {
  const PathFields& first = files.front()->source.fields;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (name.find("{" + first[i].first + "}") != name.npos) continue;
    if (std::ranges::all_of(files, [&](const Sourced* file) {
          return file->source.fields[i].second == first[i].second;
        })) {
      continue;
    }
    for (Sourced* file : files) {
      file->config.name += ", " + file->source.fields[i].second;
    }
  }
}

std::string NameOf(const ComponentConfig& pattern,
                   const std::string& path,
                   const PathFields& fields) {
  if (!pattern.name.empty()) return FillIn(pattern.name, fields);
  return fs::path(path).replace_extension().generic_string();
}

std::vector<Sourced> ExpandOne(const ComponentConfig& pattern,
                               const ComponentSource& source) {
  std::vector<Sourced> files;
  for (auto& [path, fields] :
       PathPattern(source.path).FilesBelow(pattern.data)) {
    Sourced& file = files.emplace_back();
    file.config = pattern;
    file.config.name = NameOf(pattern, path, fields);
    file.config.data = Joined(pattern.data, path);
    file.source = {.path = path, .fields = std::move(fields)};
  }
  std::map<std::string, std::vector<Sourced*>> by_name;
  for (Sourced& file : files) by_name[file.config.name].push_back(&file);
  for (const auto& [name, alike] : by_name) {
    if (alike.size() > 1) TellApart(pattern.name, alike);
  }
  return files;
}

}  // namespace

PathPattern::PathPattern(std::string_view text) {
  for (const std::string& part : Split(text, '/')) {
    Segment segment;
    ForEachPiece(
        part,
        [&](std::string_view plain) {
          segment.push_back({.text = std::string(plain), .words = {}});
        },
        [&](std::string_view field) {
          const std::size_t colon = field.find(':');
          const std::string name(field.substr(0, colon));
          if (!IsFieldName(name)) {
            throw std::invalid_argument(
                fmt::format("{}: a field's name has letters, digits and _",
                            data::QuotedName(name)));
          }
          if (std::ranges::find(fields_, name) != fields_.end()) {
            throw std::invalid_argument("field {" + name + "} is there twice");
          }
          fields_.push_back(name);
          segment.push_back({.text = name, .is_field = true, .words = {}});
          if (colon == field.npos) return;
          segment.back().words = Split(field.substr(colon + 1), '|');
        });
    segments_.push_back(std::move(segment));
  }
}

bool PathPattern::MatchSegment(const Segment& segment,
                               std::string_view name,
                               PathFields* fields) {
  if (!segment.empty() && segment.front().is_field && name.starts_with('.')) {
    return false;
  }
  // ends[i][at]: the pieces from i on match name from `at` on, piece i ending
  // there; 0 where they do not.
  const std::size_t size = name.size();
  std::vector<std::vector<std::size_t>> ends(
      segment.size() + 1, std::vector<std::size_t>(size + 1, 0));
  constexpr std::size_t kAtEnd = 1;
  ends[segment.size()][size] = kAtEnd;
  for (std::size_t i = segment.size(); i-- > 0;) {
    const Piece& piece = segment[i];
    for (std::size_t at = 0; at < size; ++at) {
      const std::string_view rest = name.substr(at);
      for (std::size_t length = rest.size(); length > 0; --length) {
        const std::string_view part = rest.substr(0, length);
        const bool fits =
            piece.is_field
                ? piece.words.empty() ||
                      std::ranges::find(piece.words, part) != piece.words.end()
                : part == piece.text;
        if (!fits || ends[i + 1][at + length] == 0) continue;
        ends[i][at] = at + length;
        break;
      }
    }
  }
  if (size == 0 || ends[0][0] == 0) return segment.empty() && size == 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < segment.size(); ++i) {
    const std::size_t end = ends[i][at];
    if (segment[i].is_field) {
      fields->emplace_back(segment[i].text, name.substr(at, end - at));
    }
    at = end;
  }
  return true;
}

std::vector<std::pair<std::string, PathFields>> PathPattern::FilesBelow(
    const std::string& folder) const {
  std::vector<std::pair<std::string, PathFields>> found{{"", {}}};
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segment& segment = segments_[i];
    const bool is_plain = std::ranges::none_of(
        segment, [](const Piece& p) { return p.is_field; });
    std::vector<std::pair<std::string, PathFields>> next;
    for (const auto& [path, fields] : found) {
      const auto add = [&, &before = path](const std::string& name,
                                           PathFields more) {
        std::string longer = i == 0 ? "" : before + "/";
        longer += name;
        std::error_code ignored;
        const fs::path whole = Joined(folder, longer);
        if (i + 1 == segments_.size() ? !fs::is_regular_file(whole, ignored)
                                      : !fs::is_directory(whole, ignored)) {
          return;
        }
        next.emplace_back(longer, std::move(more));
      };
      if (is_plain) {
        add(segment.empty() ? "" : segment.front().text, fields);
        continue;
      }
      const std::string here = path.empty() ? folder : Joined(folder, path);
      for (const std::string& name : NamesIn(here)) {
        PathFields more = fields;
        if (MatchSegment(segment, name, &more)) add(name, std::move(more));
      }
    }
    found = std::move(next);
  }
  return found;
}

std::string FillIn(std::string_view text, const PathFields& fields) {
  std::string filled;
  ForEachPiece(
      text,
      [&](std::string_view plain) { filled += plain; },
      [&](std::string_view name) {
        const auto found = std::ranges::find(
            fields, name, &std::pair<std::string, std::string>::first);
        if (found == fields.end()) {
          throw std::invalid_argument("no field {" + std::string(name) +
                                      "} in the path of its data");
        }
        filled += found->second;
      });
  return filled;
}

FleetStudy WithPatterns(study_setup::StudyFile study) {
  FleetStudy fleet{.config = std::move(study.config),
                   .file = std::move(study.file)};
  for (std::size_t i = 0; i < study.components.size(); ++i) {
    const study_setup::ComponentInFile& in_file = study.components[i];
    ComponentConfig& component = fleet.config.components[i];
    ComponentSource& source = fleet.sources.emplace_back();
    source.path = in_file.data;
    std::error_code ignored;
    if (!HasFields(in_file.data) || fs::exists(component.data, ignored)) {
      continue;
    }
    try {
      PathFields fields;
      const PathPattern pattern(in_file.data);
      for (const std::string& field : pattern.fields()) {
        fields.emplace_back(field, "");
      }
      FillIn(component.name, fields);
    } catch (const std::invalid_argument& error) {
      throw data::InputError(in_file.place + error.what());
    }
    const bool is_absolute = fs::path(in_file.data).is_absolute();
    source.is_pattern = true;
    if (is_absolute) source.path.erase(0, 1);
    component.data =
        is_absolute ? "/" : fs::path(fleet.file.file).parent_path().string();
  }
  return fleet;
}

FleetStudy Expanded(const FleetStudy& study) {
  FleetStudy expanded = study;
  expanded.config.components.clear();
  expanded.sources.clear();
  const auto add = [&](ComponentConfig component, ComponentSource source) {
    expanded.config.components.push_back(std::move(component));
    expanded.sources.push_back(std::move(source));
  };
  std::map<std::string, std::vector<std::vector<data::ColumnFilter>>> taken;
  for (std::size_t i = 0; i < study.sources.size(); ++i) {
    const ComponentConfig& component = study.config.components[i];
    const ComponentSource& source = study.sources[i];
    if (!source.is_pattern) {
      add(component, source);
      continue;
    }
    std::vector<Sourced> files = ExpandOne(component, source);
    for (Sourced& file : files) {
      auto& rows = taken[file.config.data];
      if (std::ranges::find(rows, file.config.selection.where) != rows.end()) {
        continue;
      }
      rows.push_back(file.config.selection.where);
      add(std::move(file.config), std::move(file.source));
    }
    if (!files.empty()) continue;
    ComponentConfig missing = component;
    missing.data = Joined(component.data, source.path);
    if (missing.name.empty()) missing.name = source.path;
    add(std::move(missing), {.path = source.path, .fields = {}});
  }
  study_setup::NameComponents(&expanded.config);
  return expanded;
}

}  // namespace errmap::fleet
