#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/study_setup/toml/study_file.h"

namespace errmap::fleet {

/// Fields of a file's path and their values, in order.
using PathFields = std::vector<std::pair<std::string, std::string>>;

/// The data keys of a [[component]], besides its ComponentConfig.
struct ComponentSource {
  /// Path below the study file's folder, or a PathPattern. For a pattern, the
  /// component's `data` is the folder where it starts.
  std::string path;
  bool is_pattern = false;
  PathFields fields;  // of a file that a pattern matched
};

/// A study file whose components may come from files that match a pattern. Each
/// component is a separate study, and a failed one does not stop the others.
struct FleetStudy {
  study_setup::StudyConfig config;
  study_setup::InputFile file;
  std::vector<ComponentSource> sources = {};  // one per component

  bool has_patterns() const {
    return std::ranges::any_of(sources, &ComponentSource::is_pattern);
  }
};

/// A path with fields in it is a pattern, unless a file has exactly that name.
/// Throws data::InputError, naming the place, if a pattern is malformed.
FleetStudy WithPatterns(study_setup::StudyFile study);

/// A path with fields in place of the parts that differ between files:
/// "{machine}/{component}_{direction:down|up}.csv". A field is part of one
/// folder's or file's name. It has at least one character and no leading dot.
/// Words after its colon are its only allowed values. If a name can be split in
/// several ways, earlier fields are as long as possible.
class PathPattern {
 public:
  /// Throws std::invalid_argument if braces do not match, or if a field has no
  /// name, an invalid name or a duplicate one.
  explicit PathPattern(std::string_view text);

  const std::vector<std::string>& fields() const { return fields_; }

  /// Returns the files below `folder` that match, with their fields, sorted by
  /// path. A folder that cannot be read counts as empty.
  std::vector<std::pair<std::string, PathFields>> FilesBelow(
      const std::string& folder) const;

 private:
  struct Piece {
    std::string text;  // as it stands, or the field's name
    bool is_field = false;
    std::vector<std::string> words;  // that the field may be; empty: any
  };
  using Segment = std::vector<Piece>;  // between slashes

  static bool MatchSegment(const Segment& segment,
                           std::string_view name,
                           PathFields* fields);

  std::vector<Segment> segments_;
  std::vector<std::string> fields_;
};

/// Returns `text` with its {fields} filled in. Throws std::invalid_argument
/// naming an unknown field.
std::string FillIn(std::string_view text, const PathFields& fields);

/// Returns the study with its patterns expanded and every component named. A
/// pattern becomes one component for each file that it matches. If several
/// patterns match a file for the same rows, it belongs to the first of them. If
/// names do not distinguish the files, the other fields follow after a comma. A
/// pattern without matches stays one component without a file. Throws
/// data::InputError if two components have one name.
FleetStudy Expanded(const FleetStudy& study);

}  // namespace errmap::fleet
