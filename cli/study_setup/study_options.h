#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/study_setup/study_config.h"
#include "data/measurements/dataset.h"
#include "models/record.h"

namespace errmap::study_setup {

/// The number of components of a study to which a flag may apply.
enum class Reach {
  kOne,
  kAlike,  // one, or several that a slice makes alike
  kAll,
};

/// An option of a study, wherever it is given.
struct StudyOption {
  /// The key in study files and results.json. The flag has - for _.
  const char* key;
  const char* value = "";  // placeholder in help; a choice needs none
  const char* help;
  Reach reach = Reach::kAll;
  bool seldom = false;       // shown only by help with --all
  bool may_be_zero = false;  // for a size of errors
  const char* example = "";  // line of errmap init if nothing was found
  /// Throws std::invalid_argument if a text (or a list item) is invalid for any
  /// data; may be null.
  void (*check)(const std::string& text) = nullptr;
};

/// Visits the options for reading a file's rows and columns. Calls
/// visit(option, member), or for a choice visit(option, member, values), where
/// ToString names the values. Everything else is made from this list: flags,
/// help, completion, keys of study files, --set, what errmap init writes, the
/// printed next command, and the configuration in results.json. `selection` is
/// a data::DatasetSelection, const or not.
template <typename Selection, typename Visit>
void ForSelectionOptions(Selection& selection, const Visit& visit) {
  visit(StudyOption{.key = "target",
                    .value = "COL",
                    .help = "Column of the error to map (default: by its name)",
                    .reach = Reach::kOne},
        selection.target);
  visit(StudyOption{.key = "inputs",
                    .value = "A,B,...",
                    .help = "Input columns (default: all other numeric ones)",
                    .reach = Reach::kOne},
        selection.inputs);
  visit(StudyOption{.key = "exclude",
                    .value = "A,B,...",
                    .help = "Columns that are never inputs",
                    .reach = Reach::kAlike,
                    .example = "exclude = [\"humidity\"]"},
        selection.exclude);
  visit(StudyOption{.key = "group",
                    .value = "COL",
                    .help = "Column of cycles (default: by name and values)\n"
                            "Or any groups of rows",
                    .reach = Reach::kAlike,
                    .example = "group = \"cycle\""},
        selection.group);
  visit(StudyOption{.key = "time",
                    .value = "COL",
                    .help = "Column of times or dates (default: by name and "
                            "values)\nnone: count rows instead",
                    .reach = Reach::kAlike,
                    .example = "time = \"time_s\""},
        selection.time);
  visit(
      StudyOption{
          .key = "session",
          .value = "COL",
          .help = "Column of sessions (default: by name, else nights)\nA "
                  "session is an uninterrupted run. none: cut at gaps in time",
          .reach = Reach::kAlike,
          .example = "session = \"day\""},
      selection.session);
  visit(StudyOption{.key = "position",
                    .value = "COL",
                    .help = "Column of the axis position (default: the one "
                            "whose values\nrepeat as commanded ones do)",
                    .reach = Reach::kAlike,
                    .seldom = true,
                    .example = "position = \"x_pos_mm\""},
        selection.position);
  visit(StudyOption{.key = "direction",
                    .value = "up|down|COL",
                    .help = "Rows of one direction of motion, or its column",
                    .reach = Reach::kAlike,
                    .seldom = true,
                    .example = "direction = \"up\""},
        selection.direction);
  visit(StudyOption{.key = "gap",
                    .value = "2h",
                    .help = "A longer pause ends a session (default: one far "
                            "longer than those between cycles)",
                    .reach = Reach::kAlike,
                    .seldom = true,
                    .example = "gap = \"2h\""},
        selection.gap);
  visit(StudyOption{.key = "time_unit",
                    .value = "s|ms|min|h|days",
                    .help = "Unit of a time column of numbers (default: by its "
                            "name, else by its steps)",
                    .reach = Reach::kAlike,
                    .seldom = true,
                    .example = "time_unit = \"s\""},
        selection.time_unit);
  visit(StudyOption{.key = "with",
                    .value = "LOG.csv",
                    .help = "Thermometer log, joined to the rows by time",
                    .reach = Reach::kOne,
                    .seldom = true,
                    .example = "with = \"thermometers.csv\""},
        selection.with);
  visit(StudyOption{.key = "clock_offset",
                    .value = "S",
                    .help = "How far the clock of that log is ahead: 3s, -2min",
                    .reach = Reach::kOne,
                    .seldom = true,
                    .example = "clock_offset = \"3s\""},
        selection.clock_offset);
  visit(
      StudyOption{
          .key = "align",
          .help = "first: subtract each session's first value",
          .seldom = true,
          .example =
              "align = \"first\"   # subtract each session's first value"},
      selection.align,
      std::vector{data::Alignment::kFirst, data::Alignment::kNone});
  visit(StudyOption{.key = "weight",
                    .value = "COL",
                    .help = "Column of row weights > 0",
                    .reach = Reach::kOne,
                    .seldom = true,
                    .example = "weight = \"weight\""},
        selection.weight);
  visit(
      StudyOption{.key = "missing",
                  .help =
                      "Cells without a number (empty, NA, OPEN, ---), and rows "
                      "with too few or too many cells: error or drop-rows",
                  .seldom = true,
                  .example = "missing = \"error\"   # or \"drop-rows\""},
      selection.missing,
      std::vector{data::MissingPolicy::kError, data::MissingPolicy::kDropRows});
  visit(
      StudyOption{
          .key = "faults",
          .help = "Repeated rows, and rows with failed readings (9999, jumps "
                  "of a thermometer, zeros of a lost beam): keep or drop-rows",
          .seldom = true,
          .example = "faults = \"keep\"   # or \"drop-rows\": 9999, "
                     "jumps of sensors"},
      selection.faults,
      std::vector{data::FaultPolicy::kKeep, data::FaultPolicy::kDropRows});
  visit(StudyOption{.key = "keep_dead",
                    .help = "Keep inputs that hold one value only (failed "
                            "sensors)",
                    .seldom = true,
                    .example = "keep_dead = false   # true keeps sensors that "
                               "hold one value"},
        selection.keep_dead);
}

/// Visits the options that are errors (goal, indifference) of a component, or
/// of a study for components without their own.
template <typename Config, typename Visit>
void ForErrorOptions(Config& config, const Visit& visit) {
  visit(
      StudyOption{
          .key = "goal",
          .value = "X",
          .help = "RMSE wanted: 2um (default: no goal)\nIt applies to held-out "
                  "rows. A bare number is in the unit of the target"},
      config.goal);
  visit(StudyOption{.key = "indifference",
                    .value = "X",
                    .help = "Difference in RMSE that never matters, written "
                            "like the goal (default for lengths: 0.02 um)",
                    .seldom = true,
                    .may_be_zero = true},
        config.indifference);
}

/// Visits all options of one component of a study.
template <typename Component, typename Visit>
void ForComponentOptions(Component& component, const Visit& visit) {
  ForSelectionOptions(component.selection, visit);
  ForErrorOptions(component, visit);
}

/// Visits the options that apply to all components of a study. Its seed
/// (AddSeedOption, Keys::TakeSeed) and its models are given separately.
template <typename Config, typename Visit>
void ForStudyOptions(Config& config, const Visit& visit) {
  ForErrorOptions(config, visit);
  visit(
      StudyOption{
          .key = "choose",
          .help =
              "The map to recommend\nbest: the lowest error. auto: the blend, "
              "unless a baseline is better or days prove a single map better",
          .seldom = true},
      config.choose,
      std::vector{models::Choose::kAuto,
                  models::Choose::kBest,
                  models::Choose::kBlend});
  visit(StudyOption{.key = "prefer",
                    .help = "small: fewest sensors, at most 5 % more error",
                    .seldom = true},
        config.prefer,
        std::vector{models::Prefer::kLeastError, models::Prefer::kSmall});
  visit(
      StudyOption{
          .key = "rezero",
          .value = "2h|session|probe",
          .help =
              "Judge maps that are re-zeroed this often\nAn interval is 2h "
              "or 90min, or 5 where time counts cycles. session: at its start. "
              "probe: every cycle, or every row without cycles. "
              "2h:noise=0.5um: with probes of this noise. The error without "
              "a map is re-zeroed, too",
          .check = [](const std::string& text) { CheckRezero(text); }},
      config.rezero);
}

/// Returns the options with which compare, fit and learn read measurements like
/// `selection`: those that differ from the defaults, by the keys of a study
/// file. A flag has an empty value. There is no option for `where`.
models::ByName<std::string> DataOptions(const data::DatasetSelection& selection,
                                        std::uint64_t seed);

/// Joins names as --inputs takes them.
std::string NameList(const std::vector<std::string>& names);

}  // namespace errmap::study_setup
