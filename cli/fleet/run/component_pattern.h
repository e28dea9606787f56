#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/desk/toml/study_file.h"

namespace errmap::fleet {

/// Fields of a file's path and what stands there, in order.
using PathFields = std::vector<std::pair<std::string, std::string>>;

/// What a [[component]] says of its data, besides its ComponentConfig.
struct ComponentSource {
  /// Path below the study file's folder, or a PathPattern: the component's
  /// `data` is then the folder that it starts from.
  std::string path;
  bool is_pattern = false;
  PathFields fields;  // of a file that a pattern matched
};

/// A study file some of whose components may come from files by pattern: each
/// is a study by itself, and one that fails stops no other.
struct FleetStudy {
  desk::StudyConfig config;
  desk::InputFile file;
  std::vector<ComponentSource> sources;  // one per component

  bool has_patterns() const {
    return std::ranges::any_of(sources, &ComponentSource::is_pattern);
  }
};

/// A path with fields in it is a pattern, unless a file has that very name.
/// Throws data::InputError naming the place of one that is none.
FleetStudy WithPatterns(desk::StudyFile study);

/// A path in which fields stand for what differs from file to file:
/// "{machine}/{component}_{direction:down|up}.csv". A field is a part of one
/// folder's or file's name, at least a character and never a leading dot; words
/// after its colon are all that it may be. Where a name can be cut in more than
/// one way the earlier field is the longer one.
class PathPattern {
 public:
  /// Throws std::invalid_argument on braces that do not pair, a field without a
  /// name, of an odd one, or that is there twice.
  explicit PathPattern(std::string_view text);

  const std::vector<std::string>& fields() const { return fields_; }

  /// Files below `folder` that match, with their fields, in order of their
  /// paths. A folder that cannot be looked into has none.
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

/// `text` with its {fields} filled in. Throws std::invalid_argument naming a
/// field that is not there.
std::string FillIn(std::string_view text, const PathFields& fields);

/// The study with its patterns filled in, every component named: each that is a
/// pattern becomes those of the files it matches; a
/// file belongs to the first pattern that matches it for the same rows. Names
/// that do not tell the files apart get the other fields after a comma. A
/// pattern that matches nothing stays one component, without a file. Throws
/// data::InputError where two have one name.
FleetStudy Expanded(const FleetStudy& study);

}  // namespace errmap::fleet
