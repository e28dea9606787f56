#pragma once

#include <string>
#include <vector>

#include "cli/study_setup/plan/study_plan.h"
#include "cli/study_setup/provenance.h"
#include "cli/study_setup/study_config.h"
#include "data/csv.h"

namespace errmap::study_setup {

/// Keys of a [[component]] besides its ComponentConfig.
struct ComponentInFile {
  std::string data;  // as written in the file
  std::string
      place;  // begins a message on it: "study.toml:3:1: [[component]]: "
};

/// A study file as read: its configuration and its own hash.
struct StudyFile {
  StudyConfig config;
  InputFile file;
  std::vector<ComponentInFile> components;  // as config.components
};

/// Reads a study file (TOML). Paths in it are relative to its folder; the
/// paths returned can be opened from the working folder.
///
/// Each of `set` is KEY=VALUE and replaces the value in the file. KEY is dotted
/// (`seed`, `component.0.target`, `component."x, down".goal`,
/// `model.2.degree`); components have a number from 0 or a name. VALUE is TOML;
/// otherwise it is text (`component.0.target=error_mm`).
///
/// Throws data::InputError "FILE:LINE:COLUMN: ..." if the file is not TOML, a
/// key is unknown, or a value has the wrong type or is not allowed. Throws
/// std::invalid_argument if one of `set` is wrong.
StudyFile ReadStudyFile(const std::string& path,
                        const std::vector<std::string>& set = {});

/// Reads a study file from text in memory. `path` is its name in messages; the
/// result has no hash.
StudyFile ParseStudyFile(const std::string& text,
                         const std::string& path,
                         const std::vector<std::string>& set = {});

/// Plans the study of a file. The study file is the first of the plan's inputs.
/// Throws as PlanStudy does.
StudyPlan PlanStudy(const StudyFile& file,
                    const Remark& remark = {},
                    const MakeOwnRecipes& own = {});

/// Proposes a study of one data file: one component, or one for each value of a
/// column that names directions, slides or components (`direction`, `axis`, ...
/// with few distinct values).
StudyConfig ProposeStudy(const data::CsvTable& table);

/// Returns a study file for the plan, with comments on the findings and on
/// every key. `data` is the data file as seen from the study file's folder.
/// `usage` is the command for such a study, shown in the first line. Reading
/// the file gives the same study as the plan.
std::string StudyFileText(const StudyPlan& plan,
                          const std::string& data,
                          const std::string& usage);

}  // namespace errmap::study_setup
