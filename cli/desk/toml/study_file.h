#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "cli/desk/plan/study_plan.h"
#include "cli/desk/provenance.h"
#include "cli/desk/study_config.h"
#include "cli/desk/toml/component_pattern.h"

namespace errmap::desk {

/// A study file as read: what it asks for, and its own hash.
struct StudyFile {
  StudyConfig config;
  InputFile file;
  std::vector<ComponentSource> sources;  // one per component

  /// Components come from files by pattern: each is a study by itself, and one
  /// that fails stops no other.
  bool has_patterns() const {
    return std::ranges::any_of(sources, &ComponentSource::is_pattern);
  }
};

/// Reads a study file (TOML). Paths in it are relative to its folder; the
/// paths returned can be opened from the working folder.
///
/// Each of `set` is KEY=VALUE, put in place of what the file says: KEY is
/// dotted (`seed`, `component.0.target`, `component."x, down".goal`,
/// `model.2.degree`; components by number from 0 or by name), VALUE is TOML or
/// else taken as text (`component.0.target=error_mm`).
///
/// Throws data::InputError "FILE:LINE:COLUMN: ..." where the file is no TOML, a
/// key is unknown, or a value has the wrong type or cannot be;
/// std::invalid_argument where one of `set` is at fault.
StudyFile ReadStudyFile(const std::string& path,
                        const std::vector<std::string>& set = {});

/// The same from text in memory; `path` stands for the file, which has no hash.
StudyFile ParseStudyFile(const std::string& text,
                         const std::string& path,
                         const std::vector<std::string>& set = {});

/// The plan of a study as its file has it, every file that a pattern matches a
/// component; the file is the first of its inputs. Throws as PlanStudy does.
StudyPlan PlanStudy(const StudyFile& file,
                    const Remark& remark = {},
                    const MakeOwnRecipes& own = {});

}  // namespace errmap::desk
