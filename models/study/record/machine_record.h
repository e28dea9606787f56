#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "models/study/record/record.h"

// What compensation by a machine's maps is worth: the part of results.json on
// the error at the tool. Lengths are in the machine's unit; an error counts by
// its length in the machine's sensitive directions.

namespace errmap::models {

/// One figure of the stated 90 % intervals along each of X, Y and Z; NaN where
/// there are none.
using ByDirectionRecord = std::array<double, 3>;
inline constexpr ByDirectionRecord kNoFigures = {
    std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::quiet_NaN()};

/// The error at the tool on one day that no fit saw.
struct MachineDayRecord {
  std::string session;
  std::int64_t points = 0;
  double rms = std::numeric_limits<double>::quiet_NaN();
  double p95 = std::numeric_limits<double>::quiet_NaN();
  double max = std::numeric_limits<double>::quiet_NaN();
  ByDirectionRecord within_90 = kNoFigures;  // shares of errors
};

/// Figures of ISO 230-2:2014 of an axis on those days.
struct PositioningRecord {
  std::string component;
  double systematic = std::numeric_limits<double>::quiet_NaN();
  double mean_bidirectional = std::numeric_limits<double>::quiet_NaN();
  double reversal = std::numeric_limits<double>::quiet_NaN();
  double repeatability = std::numeric_limits<double>::quiet_NaN();
  double accuracy = std::numeric_limits<double>::quiet_NaN();
};

/// The errors in a cell of the working plane, in the machine's unit: middle,
/// means of both directions, root mean square of the lengths.
struct PlaneCellRecord {
  double across = std::numeric_limits<double>::quiet_NaN();
  double up = std::numeric_limits<double>::quiet_NaN();
  std::int64_t points = 0;
  double mean_across = std::numeric_limits<double>::quiet_NaN();
  double mean_up = std::numeric_limits<double>::quiet_NaN();
  double rms = std::numeric_limits<double>::quiet_NaN();
};

/// What a component leaves at the tool: root mean square of its readings less
/// its map on those days, times that of its sensitivities.
struct MachinePartRecord {
  std::string error;  // "EXX"
  double rms = std::numeric_limits<double>::quiet_NaN();
};

struct MachineMapRecord {
  std::string component;  // of the study: the map's data
  std::string model;
};

/// The machine with one way of choosing its maps, or without any.
struct MachineChoiceRecord {
  std::string name;  // "uncompensated", "polynomial", "neural", "recommended"
  std::optional<std::string> why;  // there are no figures
  std::vector<MachineMapRecord> maps;
  std::int64_t points = 0;  // of all days
  double rms = std::numeric_limits<double>::quiet_NaN();
  double p95 = std::numeric_limits<double>::quiet_NaN();
  double max = std::numeric_limits<double>::quiet_NaN();
  /// Of the geometric mean of the days' p95: t of logarithms; NaN for one.
  std::array<double, 2> p95_ci95 = {std::numeric_limits<double>::quiet_NaN(),
                                    std::numeric_limits<double>::quiet_NaN()};
  ByDirectionRecord within_90 = kNoFigures;      // shares of errors
  ByDirectionRecord half_width_90 = kNoFigures;  // mean over the points
  /// Sessions that the half-widths are from, each held out in its turn; none:
  /// they are from the components alone, taken as independent.
  std::vector<std::string> held_out;
  std::vector<MachineDayRecord> days;
  std::vector<PositioningRecord> positioning;  // of pairs of displacement maps
  /// ISO 230-6: the same figures along diagonals, named by their signs: "p0n".
  std::vector<PositioningRecord> diagonals;
  std::vector<MachinePartRecord> parts;  // the largest first
  std::vector<PlaneCellRecord> cells;    // only those that have points
};

/// The working plane in which cells lie: where the tool is less where the
/// work's origin is, in the machine's unit.
struct PlaneRecord {
  std::string across;  // "Z"
  std::string up;      // "X"
  double cell_width = std::numeric_limits<double>::quiet_NaN();
  double cell_height = std::numeric_limits<double>::quiet_NaN();
};

struct MachineRecord {
  std::string name;
  std::string file;
  std::string unit;
  std::string sensitive;             // "XZ"
  std::string points;                // file of poses with their true errors
  std::vector<std::string> later;    // sessions that no fit saw
  std::optional<PlaneRecord> plane;  // nothing: one direction is sensitive
  std::vector<MachineChoiceRecord> choices;  // uncompensated first
};

}  // namespace errmap::models
