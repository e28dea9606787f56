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

/// Shares of errors within the stated 90 % intervals, along X, Y and Z; NaN
/// where a map has none.
using SharesRecord = std::array<double, 3>;
inline constexpr SharesRecord kNoShares = {
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
  SharesRecord within_90 = kNoShares;
};
ERRMAP_RECORD(MachineDayRecord, session, points, rms, p95, max, within_90)

/// Figures of ISO 230-2:2014 of an axis on those days.
struct PositioningRecord {
  std::string component;
  double systematic = std::numeric_limits<double>::quiet_NaN();
  double mean_bidirectional = std::numeric_limits<double>::quiet_NaN();
  double reversal = std::numeric_limits<double>::quiet_NaN();
  double repeatability = std::numeric_limits<double>::quiet_NaN();
  double accuracy = std::numeric_limits<double>::quiet_NaN();
};
ERRMAP_RECORD(PositioningRecord,
              component,
              systematic,
              mean_bidirectional,
              reversal,
              repeatability,
              accuracy)

struct MachineMapRecord {
  std::string component;  // of the study: the map's data
  std::string model;
};
ERRMAP_RECORD(MachineMapRecord, component, model)

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
  SharesRecord within_90 = kNoShares;
  std::vector<MachineDayRecord> days;
  std::vector<PositioningRecord> positioning;  // of pairs of displacement maps
};
ERRMAP_RECORD(MachineChoiceRecord,
              name,
              why,
              maps,
              points,
              rms,
              p95,
              max,
              p95_ci95,
              within_90,
              days,
              positioning)

struct MachineRecord {
  std::string name;
  std::string file;
  std::string unit;
  std::string sensitive;           // "XZ"
  std::string points;              // file of poses with their true errors
  std::vector<std::string> later;  // sessions that no fit saw
  std::vector<MachineChoiceRecord> choices;  // uncompensated first
};
ERRMAP_RECORD(
    MachineRecord, name, file, unit, sensitive, points, later, choices)

}  // namespace errmap::models
