#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/units.h"
#include "models/error_model.h"
#include "models/export/program/map_program.h"

namespace errmap::models {

/// Status bits of a step. The exported maps return the same bits.
enum MapStatus : int {
  kMapOutside = 1,       // a reading left its trained range
  kMapFar = 2,           // a sensor reads what this machine cannot reach
  kMapClipped = 4,       // a guard clipped an input of the form, or the error
  kMapInvalid = 8,       // a reading, the time or the error is not finite
  kMapDead = 16,         // a sensor reads like a disconnected one
  kMapFrozen = 32,       // a sensor stands still while the others move
  kMapContradicts = 64,  // a sensor differs from what the others suggest
  kMapFaded = 128,       // the error goes to 0: no good step for too long
  kMapLimited = 256,     // the error is the largest allowed
  kMapRamping = 512,     // the error moves to its value at the largest rate
  // The reasons that `predict` gives, besides kMapOutside, why a row is unlike
  // training.
  kMapRelation = 1024,    // a sensor does not fit the others as in training
  kMapDistance = 2048,    // a thermal state far from every trained one
  kMapLeverage = 4096,    // far from the mean of the trained states
  kMapSettling = 8192,    // started in the middle of a session
  kMapGap = 16384,        // readings were missing a short time ago
  kMapParameter = 32768,  // a limit was set to an invalid value
  kMapUnhealthy = 65536,  // a control must not continue with this
  kMapJumped = 131072,    // a sensor changed too fast, and has not come back
};
/// A step with one of these bits is skipped. The filters keep their state, and
/// the last good readings are used with the current position.
inline constexpr int kMapNotTaken = kMapFar | kMapInvalid | kMapDead |
                                    kMapFrozen | kMapContradicts | kMapJumped;
/// Each of these sets kMapUnhealthy. So does kMapRelation together with a bit
/// of kMapBesideRelation: a faulty sensor is then more likely than a new state.
inline constexpr int kMapAlarms =
    kMapNotTaken | kMapFaded | kMapSettling | kMapGap | kMapParameter;
inline constexpr int kMapBesideRelation = kMapOutside | kMapClipped;

/// A status bit with the name and explanation used in exported code.
struct StatusBit {
  int bit;
  const char* name;  // "OUTSIDE"
  const char* what;
};
std::span<const StatusBit> StatusBits();

/// Limits set by the user (target's unit); the others are derived from the
/// map.
struct LimitOptions {
  std::optional<double> max_error = std::nullopt;
  std::optional<double> max_rate = std::nullopt;  // per s
};

/// Adds a controller to a program of `maps` (one for each of its
/// forms): limits, checks of readings, and the routines that enforce
/// them. Throws std::invalid_argument if a limit is not finite and
/// above 0.
void AddController(const std::vector<const FittedModel*>& maps,
                   const LimitOptions& options,
                   MapProgram* program);

/// Removes guards that no reading can reach after a controller's checks.
/// Compare the program with the map first, since the map has these guards.
void DropIdleGuards(MapProgram* program);

/// Returns the value of a kept cell before the first step.
double InitialValue(const MapProgram& program, Cell cell);
/// The cells that are 0 at the known start of a session.
inline constexpr Cell kOfSession[] = {
    Cell::kBegun, Cell::kFresh, Cell::kSettling, Cell::kLeapt};
constexpr bool IsOfSession(Cell cell) {
  return std::ranges::find(kOfSession, cell) != std::end(kOfSession);
}
/// Up to this number, the code for sensors is written out, which is faster than
/// a loop.
inline constexpr int kFewSensors = 4;
/// A limit set at run time may be up to this multiple of the map's own limit.
inline constexpr double kMostTimesOwn = 10.0;

/// True for counts and times. They are not sensors, and grow beyond the trained
/// range.
bool IsCount(const data::Unit& unit);

/// Returns the fastest plausible change by heat: 10 um/s or 10 urad/s. In any
/// other unit: `max_error` in 10 s.
double DefaultMaxRate(const data::Unit& unit, double max_error);

/// Return MapProgram::read and MapProgram::move. The bounds and slopes of the
/// program's readings, and its judgement, must already be set.
Routine ReadRoutine(const MapProgram& program);
Routine MoveRoutine(const ControllerLimits& limits);

/// Largest effect of a failed sensor on the output error, once every filter has
/// settled; target's unit. The search starts from positions and sensors at the
/// ends and in the middle of their trained range. MeasureSensitivity
/// (models/sensors/sensitivity.h) uses the training rows instead.
struct FailingSensor {
  std::string name;
  double zero = 0.0;     // it reads 0, without any checks
  double without = 0.0;  // it reads anything, without any checks
  /// The sensor may read any value, with checks and limits in effect. Includes
  /// the loss of the compensation if the reading is not trusted.
  double with = 0.0;
};

/// Returns all sensors, sorted by falling `zero`. `program` has its controller.
std::vector<FailingSensor> WorstOfFailing(const MapProgram& program);

}  // namespace errmap::models
