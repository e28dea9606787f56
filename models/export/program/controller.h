#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/units.h"
#include "models/error_model.h"
#include "models/export/program/map_program.h"

namespace errmap::models {

/// What is to be said of a step beside its error; the exported maps return the
/// same bits.
enum MapStatus : int {
  kMapOutside = 1,       // a reading left its trained range
  kMapFar = 2,           // a sensor reads what this machine cannot be at
  kMapClipped = 4,       // a guard clipped an input of the form, or the error
  kMapInvalid = 8,       // a reading, the time or the error is no number
  kMapDead = 16,         // a sensor reads as one that is not connected does
  kMapFrozen = 32,       // a sensor stands still while the others move
  kMapContradicts = 64,  // a sensor is not where the others tell
  kMapFaded = 128,       // no good step for so long that the error goes to 0
  kMapLimited = 256,     // the error is the largest allowed
  kMapRamping = 512,     // the error is on its way, at the largest rate
  // As `predict` says, beside kMapOutside, why a row is unlike training.
  kMapRelation = 1024,    // a sensor does not go with the others as in training
  kMapDistance = 2048,    // a thermal state far from every trained one
  kMapLeverage = 4096,    // far from the middle of them
  kMapSettling = 8192,    // begun inside a session
  kMapGap = 16384,        // readings were missing not long ago
  kMapParameter = 32768,  // a limit was set to what is none
  kMapUnhealthy = 65536,  // what a control must not go on with
  kMapJumped = 131072,    // a sensor changed faster than it can, and stays so
};
/// `predict` says inside = 0.
inline constexpr int kMapUnlike = kMapOutside | kMapRelation | kMapDistance |
                                  kMapLeverage | kMapSettling | kMapGap;
/// A step with one of these is not taken: the filters keep their state, and the
/// last good readings are held, where the axis is now.
inline constexpr int kMapNotTaken = kMapFar | kMapInvalid | kMapDead |
                                    kMapFrozen | kMapContradicts | kMapJumped;
/// Each of these makes it kMapUnhealthy; so does kMapRelation together with one
/// of the others, since then a sensor is wrong sooner than the day is new.
inline constexpr int kMapAlarms =
    kMapNotTaken | kMapFaded | kMapSettling | kMapGap | kMapParameter;
inline constexpr int kMapBesideRelation = kMapOutside | kMapClipped;

/// A bit of the status as languages name and explain it.
struct StatusBit {
  int bit;
  const char* name;  // "OUTSIDE"
  const char* what;
};
std::span<const StatusBit> StatusBits();

/// What a user sets of a controller's limits (target's unit); what he does not
/// set follows from the map.
struct LimitOptions {
  std::optional<double> max_error = std::nullopt;
  std::optional<double> max_rate = std::nullopt;  // per s
};

/// Adds to a program of `maps`, as many as its forms, what a controller needs
/// around its arithmetic: limits, which readings are not to be believed, and
/// the routines that see to it. Throws std::invalid_argument where a limit is
/// not above 0 and finite.
void AddController(const std::vector<const FittedModel*>& maps,
                   const LimitOptions& options,
                   MapProgram* program);

/// What a cell that is kept holds before all steps.
double InitialValue(const MapProgram& program, Cell cell);
/// The cells that are 0 where a session is known to begin.
inline constexpr Cell kOfSession[] = {
    Cell::kBegun, Cell::kFresh, Cell::kSettling, Cell::kLeapt};
constexpr bool IsOfSession(Cell cell) {
  return cell == Cell::kBegun || cell == Cell::kFresh ||
         cell == Cell::kSettling || cell == Cell::kLeapt;
}
/// A largest error set while it runs is one up to so many times the map's own.
inline constexpr double kMostTimesOwn = 10.0;

/// Counts and times have no sensor, and go on beyond what was trained.
bool IsCount(const data::Unit& unit);

/// Heat moves no machine so fast: 10 um/s, 10 urad/s; of an error in another
/// unit, `max_error` in 10 s.
double DefaultMaxRate(const data::Unit& unit, double max_error);

}  // namespace errmap::models
