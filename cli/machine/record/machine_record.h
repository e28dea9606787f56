#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/report/figures/figures.h"
#include "cli/report/table.h"
#include "models/kinematics/plane_cells.h"
#include "models/study/record/study_record.h"

// The benefit of compensation by a machine's maps: the part of results.json on
// the error at the tool. Lengths are in the machine's unit; an error counts by
// its length in the machine's sensitive directions.

namespace errmap::machine {

using models::kNotKnown;

/// A statistic of the stated 90 % intervals along each of X, Y and Z; NaN
/// without intervals.
using ByDirectionRecord = std::array<double, 3>;
inline constexpr ByDirectionRecord kNoFigures = {
    kNotKnown, kNotKnown, kNotKnown};

/// The error at the tool on one day that no fit used.
struct MachineDayRecord {
  std::string session;
  std::int64_t points = 0;
  double rms = kNotKnown;
  double p95 = kNotKnown;
  double max = kNotKnown;
  ByDirectionRecord within_90 = kNoFigures;  // shares of errors
};

/// Figures of ISO 230-2:2014 of an axis on those days.
struct PositioningRecord {
  std::string component;
  double systematic = kNotKnown;
  double mean_bidirectional = kNotKnown;
  double reversal = kNotKnown;
  double repeatability = kNotKnown;
  double accuracy = kNotKnown;
};

/// The contribution of a component to the remaining error at the tool: the RMS
/// of its readings minus its map on those days, times the RMS of its
/// sensitivities.
struct MachinePartRecord {
  std::string error;  // "EXX"
  double rms = kNotKnown;
};

struct MachineMapRecord {
  std::string component;  // of the study: the map's data
  std::string model;
};

/// The machine's results for one choice of maps, or without a map.
struct MachineChoiceRecord {
  std::string name;  // "uncompensated", "polynomial", "neural", "recommended"
  std::optional<std::string> why;  // why there are no figures
  std::vector<MachineMapRecord> maps;
  std::int64_t points = 0;  // of all days
  double rms = kNotKnown;
  double p95 = kNotKnown;
  double max = kNotKnown;
  /// Interval of the geometric mean of the days' p95, by a t test of
  /// logarithms; NaN for one day.
  std::array<double, 2> p95_ci95 = {kNotKnown, kNotKnown};
  ByDirectionRecord within_90 = kNoFigures;      // shares of errors
  ByDirectionRecord half_width_90 = kNoFigures;  // mean over the points
  /// Sessions used for the half-widths, each held out in turn. Empty: these
  /// come from the components alone, assumed independent.
  std::vector<std::string> held_out;
  std::vector<MachineDayRecord> days;
  std::vector<PositioningRecord> positioning;  // of pairs of displacement maps
  /// ISO 230-6: the same figures along diagonals, named by their signs: "p0n".
  std::vector<PositioningRecord> diagonals;
  std::vector<MachinePartRecord> parts;  // the largest first
  std::vector<models::PlaneCell> cells;  // only those that have points
};

/// The working plane of the cells: the tool's position relative to the work's
/// origin, in the machine's unit.
struct PlaneRecord {
  std::string across;  // "Z"
  std::string up;      // "X"
  double cell_width = kNotKnown;
  double cell_height = kNotKnown;
};

struct MachineRecord {
  std::string name;
  std::string file;
  std::string unit;
  std::string sensitive = {};      // "XZ"
  std::string points;              // file of poses with their true errors
  std::vector<std::string> later;  // sessions that no fit saw
  std::optional<PlaneRecord> plane = {};  // empty: one direction is sensitive
  std::vector<MachineChoiceRecord> choices = {};  // uncompensated first
};

inline constexpr const char* kMachineKey = "machine";

/// Adds the judgement to the study's record under the key "machine".
void AddMachine(const MachineRecord& machine, models::StudyRecord* record);

/// The error at the tool over the working plane, before and after compensation
/// by the recommended maps. Arrows show mean errors on one scale, and after
/// compensation also on a larger one. Colours show the RMS on one scale.
/// Returns nothing if the record has no plane.
std::vector<report::Figure> MachineFigures(const MachineRecord& machine);

/// Says how far off the tool is at worst, mostly along which axis, and how much
/// of that the recommended maps remove.
std::string MachineAnswer(const MachineRecord& machine);

/// Returns these tables, some possibly empty: the error at the tool on days
/// that no fit used, one row per choice of maps; the same by day; the stated
/// intervals; ISO 230-2 and, along diagonals, ISO 230-6; the contribution of
/// each component; the maps.
std::vector<report::Table> MachineTables(const MachineRecord& machine);

/// Returns the tables that fit a terminal.
std::vector<report::Table> ScreenTables(const MachineRecord& machine);

}  // namespace errmap::machine
