#include "models/export/program/controller.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "fitting/least_squares/decompositions.h"
#include "models/export/program/run_program.h"
#include "models/history/view.h"
#include "models/map_experience.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

// What sensors read that are not connected or not ready: an open input, a
// DS18B20 that is gone or has just woken, an open resistance thermometer.
constexpr double kDeadValues[] = {0.0, -127.0, 85.0, 850.0};  // degC
// How far beyond its trained range a sensor is not believed: by half of that
// range, and a thermometer by so much at least. Of ten simulated machines, what
// further days brought beyond two or three days was up to 6 K and 4 ranges.
constexpr double kFar = 0.5;
constexpr double kFarKelvin = 8.0;
// The limits of relations flag days that are merely new, mostly if held-out
// cycles set them; a failed sensor is far beyond. For 20 maps of few sensors
// of four simulated machines, two further days reached 7.8 limits after two
// days, 6.1 after three, and 2.2 after four, from which on whole days are held
// out.
struct Contradiction {
  double limits;
  double kelvin;
};
constexpr Contradiction kByCycles{8.0, 4.0};
constexpr Contradiction kBySessions{3.0, 2.0};

Contradiction ContradictionOf(const FittedModel& fitted) {
  const auto& interval = fitted.interval;
  return interval && interval->of_sessions &&
                 interval->units >= kFewestSessionsToDecide
             ? kBySessions
             : kByCycles;
}

double Range(const ProgramReading& reading) {
  return reading.trained_max - reading.trained_min;
}

bool IsThermometer(const ProgramReading& reading) {
  return reading.column.unit.quantity == data::Quantity::kTemperature;
}

// A difference in K.
double InUnitOf(const ProgramReading& thermometer, double kelvin) {
  const data::Unit from = data::UnitOfSymbol("K");
  const data::Unit& unit = thermometer.column.unit;
  return data::Converted(kelvin, from, unit) - data::Converted(0.0, from, unit);
}

// Where some map was trained, and a little more.
bool IsTrained(const MapProgram& program, Operand place, double value) {
  return std::ranges::any_of(program.forms, [&](const MapForm& form) {
    return std::ranges::any_of(form.ranges, [&](const TrainedRange& range) {
      return range.place == place && value >= range.low && value <= range.high;
    });
  });
}

std::vector<double> DeadValuesOf(const MapProgram& program, int index) {
  const ProgramReading& reading =
      program.readings[static_cast<std::size_t>(index)];
  const data::Unit degrees = data::UnitOfSymbol("degC");
  const data::Unit& unit = reading.column.unit;
  std::vector<double> found;
  const auto add = [&](double value) {
    const bool is_far = value < reading.far_low || value > reading.far_high;
    if (is_far || IsTrained(program, {Space::kReading, index}, value)) return;
    if (std::ranges::find(found, value) == found.end()) found.push_back(value);
  };
  for (const double value : kDeadValues) {
    add(value);
    if (IsThermometer(reading) && data::AreConvertible(degrees, unit)) {
      add(data::Converted(value, degrees, unit));
    }
  }
  return found;
}

// Read by its sine and cosine alone it has no ends.
bool IsPeriodic(const MapProgram& program, int index) {
  const std::vector<const Instructions*> parts = program.parts();
  return std::ranges::any_of(parts, [&](const Instructions* part) {
    return std::ranges::any_of(*part, [&](const Instruction& it) {
      return (it.op == Op::kSine || it.op == Op::kCosine) &&
             it.a == Operand{Space::kReading, index};
    });
  });
}

void SetBounds(const FittedModel& fitted, MapProgram* program) {
  const double margin =
      fitted.guards ? fitted.guards->input_margin : ClampLimits{}.input_margin;
  int index = -1;
  for (ProgramReading& reading : program->readings) {
    ++index;
    const double range = Range(reading);
    const data::Unit& unit = reading.column.unit;
    reading.is_position = data::IsPosition(reading.column) ||
                          unit.quantity == data::Quantity::kAngle;
    reading.far_low = -kHuge;
    reading.far_high = kHuge;
    if (reading.is_position) {
      if (!(range > 0.0) || IsPeriodic(*program, index)) continue;
      reading.far_low = reading.trained_min - range;
      reading.far_high = reading.trained_max + range;
      continue;
    }
    const bool is_count = IsCount(unit);
    double width = (is_count ? margin : kFar) * range;
    if (IsThermometer(reading)) {
      width = std::max(width, InUnitOf(reading, kFarKelvin));
    }
    reading.far_low = reading.trained_min - width;
    reading.far_high = reading.trained_max + width;
    if (!is_count) reading.dead = DeadValuesOf(*program, index);
  }
}

// Limits from training for sensors that hang (models/sensors/standing_still.h).
void WatchForStandingStill(const std::vector<const FittedModel*>& maps,
                           MapProgram* program) {
  constexpr double kFinest = 2.0;  // steps of its resolution
  for (std::size_t k = 0; k < maps.size(); ++k) {
    const Applicability* trained = maps[k]->applicability.get();
    if (trained == nullptr) continue;
    const StandingStill& still = trained->standing;
    program->limits.silence = std::max(program->limits.silence, still.silence);
    for (Index i = 0; i < still.others_move.size(); ++i) {
      const auto column = static_cast<std::size_t>(
          trained->columns[static_cast<std::size_t>(i)]);
      ProgramReading& reading = program->readings[static_cast<std::size_t>(
          program->forms[k].readings[column])];
      reading.others_move = std::max(reading.others_move, still.others_move[i]);
      reading.finest = std::max(reading.finest, kFinest * still.resolution[i]);
      // If one of two maps saw no noise, there is no limit.
      const double quiet = still.quiet[i] > 0.0 ? still.quiet[i] : kHuge;
      reading.quiet = std::max(reading.quiet, quiet);
      if (!(still.jump[i] > 0.0)) continue;
      const double jump = still.jump[i] * Range(reading);
      reading.jump = reading.jump < kHuge ? std::max(reading.jump, jump) : jump;
      reading.fastest =
          std::max(reading.fastest, still.pace[i] * Range(reading));
    }
  }
  const auto watched = std::ranges::count_if(
      program->readings,
      [](const auto& reading) { return reading.others_move > 0.0; });
  const double others = std::max(1.0, static_cast<double>(watched) - 1.0);
  for (ProgramReading& reading : program->readings) {
    if (!(reading.others_move > 0.0)) continue;
    reading.weight = 1.0 / (Range(reading) * others);
  }
}

// `to` = `by` times `from`: a few term by term, or a table.
void Multiply(const MatrixXd& by,
              Space from,
              Space to,
              bool are_few,
              MapProgram* program,
              Instructions* part) {
  if (!are_few) {
    part->push_back({.op = Op::kAffine,
                     .to = {to, 0},
                     .a = {from, 0},
                     .table = program->tables.size(),
                     .count = static_cast<int>(by.rows())});
    MatrixXd& table = program->tables.emplace_back(by.rows(), by.cols() + 1);
    table << by, VectorXd::Zero(by.rows());
    return;
  }
  for (Index row = 0; row < by.rows(); ++row) {
    const Operand sum{to, static_cast<int>(row)};
    if (by.row(row).isZero(0.0)) {
      part->push_back({.op = Op::kSet, .to = sum});
      continue;
    }
    for (Index i = 0; i < by.cols(); ++i) {
      part->push_back({.op = i == 0 ? Op::kLinear : Op::kAccumulate,
                       .to = sum,
                       .a = {from, static_cast<int>(i)},
                       .c = by(row, i)});
    }
  }
}

// As MeasureStates in models/sensors/applicability.cc: x_j less its mean given
// the others is (P x)_j / P_jj with variance 1 / P_jj. The inverse of
// diag(rest) + W W' is taken by way of the few directions (Woodbury), so that a
// step costs sensors times directions.
void AddJudgement(const FittedModel& fitted,
                  MapProgram* program,
                  MapForm* form) {
  const Applicability& trained = *fitted.applicability;
  const Contradiction contradicts = ContradictionOf(fitted);
  const Index sensors = trained.mean.size();
  const Index directions = trained.directions.cols();
  const MatrixXd weighted =
      trained.rest.cwiseInverse().asDiagonal() * trained.directions;
  const MatrixXd inner =
      fitting::CholeskyInverse(MatrixXd::Identity(directions, directions) +
                               trained.directions.transpose() * weighted);
  const VectorXd own =
      trained.rest.cwiseInverse() -
      (weighted * inner).cwiseProduct(weighted).rowwise().sum();
  // (P x)_j / sqrt(P_jj) over its limit, that is 1 / rest_j (x_j - w_j v) of
  // it.
  const VectorXd per_limit = (trained.rest.array() * own.array().sqrt() *
                              trained.relation_limit.array())
                                 .inverse();

  const auto reading_of = [&](Index sensor) {
    return form->readings[static_cast<std::size_t>(
        trained.columns[static_cast<std::size_t>(sensor)])];
  };
  const MatrixXd scores =
      inner * weighted.transpose() * trained.scale.cwiseInverse().asDiagonal();
  const VectorXd of_itself = per_limit.cwiseQuotient(trained.scale);

  Instructions& judge = form->judge;
  for (Index i = 0; i < sensors; ++i) {
    judge.push_back({.op = Op::kShift,
                     .to = {Space::kStanding, static_cast<int>(i)},
                     .a = {Space::kReading, reading_of(i)},
                     .c = trained.mean[i]});
  }
  // Scores as in MeasureStates: the columns of W are orthogonal.
  const MatrixXd whitened =
      trained.directions.colwise().squaredNorm().cwiseInverse().asDiagonal() *
      trained.directions.transpose() *
      trained.scale.cwiseInverse().asDiagonal();
  const bool are_few = sensors <= kFewSensors;
  Multiply(whitened,
           Space::kStanding,
           Space::kScore,
           are_few,
           program,
           &form->measure);
  const auto rows = static_cast<double>(trained.rows);
  form->states = trained.states;
  form->reach = trained.distance_limit * trained.distance_limit;
  form->most_spread = (trained.leverage_limit - 1.0 / rows) * (rows - 1.0);
  form->has_relations = sensors > 1;  // one alone has no others to go with
  if (!form->has_relations) return;
  // Readings that are not sensors, such as positions, have no doubt.
  MatrixXd told = MatrixXd::Zero(std::ssize(program->readings), directions);
  for (Index i = 0; i < sensors; ++i) {
    told.row(reading_of(i)) = -per_limit[i] * trained.directions.row(i);
  }
  if (are_few) {
    MatrixXd all = told * scores;
    for (Index i = 0; i < sensors; ++i) all(reading_of(i), i) += of_itself[i];
    Multiply(all, Space::kStanding, Space::kDoubt, true, program, &judge);
  } else {
    Multiply(scores, Space::kStanding, Space::kScore, false, program, &judge);
    Multiply(told, Space::kScore, Space::kDoubt, false, program, &judge);
  }
  for (Index i = 0; i < sensors; ++i) {
    const int column = reading_of(i);
    ProgramReading& reading =
        program->readings[static_cast<std::size_t>(column)];
    reading.believed = std::max(reading.believed, contradicts.limits);
    if (IsThermometer(reading)) {
      const double limit =
          trained.relation_limit[i] * trained.scale[i] / std::sqrt(own[i]);
      reading.believed = std::max(
          reading.believed, InUnitOf(reading, contradicts.kelvin) / limit);
    }
    if (are_few) continue;
    judge.push_back({.op = Op::kAccumulate,
                     .to = {Space::kDoubt, column},
                     .a = {Space::kStanding, static_cast<int>(i)},
                     .c = of_itself[i]});
  }
}

// ---- Limits ----

// Readings of thermal states like those of training; positions at their mean.
std::vector<VectorXd> TrainedStates(const FittedModel& fitted,
                                    const MapProgram& program,
                                    const MapForm& form) {
  const VectorXd mean = MeanReadings(program);
  std::vector<VectorXd> states{mean};
  if (const Applicability* trained = fitted.applicability.get()) {
    for (Index k = 0; k < trained->states.rows(); ++k) {
      const VectorXd scaled =
          trained->directions * trained->states.row(k).transpose();
      VectorXd& state = states.emplace_back(mean);
      for (std::size_t i = 0; i < trained->columns.size(); ++i) {
        const auto at = static_cast<Index>(i);
        state[form.readings[static_cast<std::size_t>(trained->columns[i])]] =
            trained->mean[at] + trained->scale[at] * scaled[at];
      }
    }
  } else {
    for (const double ProgramReading::*end :
         {&ProgramReading::trained_min, &ProgramReading::trained_max}) {
      VectorXd& state = states.emplace_back(mean);
      for (std::size_t i = 0; i < program.readings.size(); ++i) {
        if (program.readings[i].is_position) continue;
        state[static_cast<Index>(i)] = program.readings[i].*end;
      }
    }
  }
  for (VectorXd& state : states) {
    for (std::size_t i = 0; i < program.readings.size(); ++i) {
      double& value = state[static_cast<Index>(i)];
      value = std::clamp(value,
                         program.readings[i].trained_min,
                         program.readings[i].trained_max);
    }
  }
  return states;
}

// Errors along one position, in one thermal state, at even steps; NaN if not
// finite.
using Profile = std::vector<double>;
constexpr int kProfileSteps = 64;

Profile ProfileOf(const MapProgram& program,
                  int form,
                  VectorXd state,
                  std::size_t position) {
  constexpr double kForEver = 1e8;  // s
  const ProgramReading& reading = program.readings[position];
  ProgramRun run(program, Precision::kDouble, form);
  run.Begin(MeanReadings(program));
  double error = 0.0;
  run.Step(kForEver, state, &error);
  Profile profile;
  for (int k = 0; k <= kProfileSteps; ++k) {
    state[static_cast<Index>(position)] =
        reading.trained_min + Range(reading) * k / kProfileSteps;
    const bool is_number = (run.Step(0.0, state, &error) & kMapInvalid) == 0;
    profile.push_back(is_number ? error : stats::kNaN);
  }
  return profile;
}

double LargestStep(const Profile& profile, double most) {
  double largest = 0.0;
  for (std::size_t k = 1; k < profile.size(); ++k) {
    const double from = std::clamp(profile[k - 1], -most, most);
    const double to = std::clamp(profile[k], -most, most);
    largest = std::max(largest, std::fabs(to - from));
  }
  return largest;
}

double LargestDifference(const Profile& a, const Profile& b, double most) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    largest = std::max(largest,
                       std::fabs(std::clamp(a[k], -most, most) -
                                 std::clamp(b[k], -most, most)));
  }
  return largest;
}

// The profiles of all maps in one state along one reading.
struct Profiles {
  std::size_t reading = 0;
  std::vector<Profile> of_forms;
};

std::vector<Profiles> AllProfiles(const std::vector<const FittedModel*>& maps,
                                  const MapProgram& program) {
  std::vector<Profiles> all;
  for (std::size_t k = 0; k < maps.size(); ++k) {
    for (const VectorXd& state :
         TrainedStates(*maps[k], program, program.forms[k])) {
      for (std::size_t i = 0; i < program.readings.size(); ++i) {
        // Without a position any reading will do: the states alone tell.
        const bool stands_for_all =
            i == 0 && std::ranges::none_of(program.readings,
                                           &ProgramReading::is_position);
        if (!program.readings[i].is_position && !stands_for_all) continue;
        Profiles& profiles = all.emplace_back(Profiles{i, {}});
        for (std::size_t form = 0; form < maps.size(); ++form) {
          profiles.of_forms.push_back(
              ProfileOf(program, static_cast<int>(form), state, i));
        }
      }
    }
  }
  return all;
}

// The range of the errors, 0 with them, times what a day beyond may add.
double DefaultMaxError(const std::vector<const FittedModel*>& maps,
                       const MapProgram& program,
                       const std::vector<Profiles>& all) {
  constexpr double kBeyond = 1.3;
  double low = 0.0;
  double high = 0.0;
  for (std::size_t k = 0; k < maps.size(); ++k) {
    // A map that reads nothing has no profile.
    double steady = 0.0;
    ProgramRun run(program, Precision::kDouble, static_cast<int>(k));
    run.Begin(MeanReadings(program));
    run.Step(0.0, MeanReadings(program), &steady);
    low = std::min(low, steady);
    high = std::max(high, steady);
    if (const auto& guards = maps[k]->guards) {
      low = std::min(low, guards->error_min);
      high = std::max(high, guards->error_max);
      continue;
    }
    for (const Profiles& profiles : all) {
      for (const double error : profiles.of_forms[k]) {
        low = std::min(low, error);
        high = std::max(high, error);
      }
    }
  }
  return kBeyond * (high - low);
}

double Limit(const std::optional<double>& given,
             double otherwise,
             const char* what) {
  const double value = given.value_or(otherwise);
  if (!std::isfinite(value) || !(value >= 0.0) || (given && value == 0.0)) {
    throw std::invalid_argument(
        fmt::format("the largest {} must be above 0 and finite", what));
  }
  return value;
}

void SetLimits(const std::vector<const FittedModel*>& maps,
               const LimitOptions& options,
               MapProgram* program) {
  // Slopes between grid points, and of states in between, are somewhat larger.
  constexpr double kSteeper = 1.5;
  // Of its range, how far a position comes back by itself: noise, overshoot.
  constexpr double kBand = 1e-4;
  const std::vector<Profiles> all = AllProfiles(maps, *program);
  ControllerLimits& limits = program->limits;
  limits.own_error = DefaultMaxError(maps, *program, all);
  limits.max_error = Limit(options.max_error, limits.own_error, "error");
  limits.max_rate =
      Limit(options.max_rate,
            DefaultMaxRate(program->target.unit, limits.max_error),
            "rate");
  for (const Profiles& profiles : all) {
    ProgramReading& reading = program->readings[profiles.reading];
    if (!reading.is_position || !(Range(reading) > 0.0)) continue;
    for (const Profile& profile : profiles.of_forms) {
      reading.slope =
          std::max(reading.slope,
                   kSteeper * LargestStep(profile, limits.max_error) *
                       kProfileSteps / Range(reading));
    }
    if (!program->has_directions()) continue;
    limits.reversal =
        std::max(limits.reversal,
                 kSteeper * LargestDifference(profiles.of_forms[0],
                                              profiles.of_forms[1],
                                              limits.max_error));
    limits.band = kBand * Range(reading);
  }
}

constexpr StatusBit kStatusBits[] = {
    {kMapOutside, "OUTSIDE", "an input left its trained range: extrapolated"},
    {kMapFar, "FAR", "... by more than this machine can: not taken"},
    {kMapClipped, "CLIPPED", "a guard clipped an input or the error"},
    {kMapInvalid,
     "INVALID",
     "an input, the time or the error is not a number: not taken"},
    {kMapDead, "DEAD", "a sensor reads as if not connected: not taken"},
    {kMapFrozen,
     "FROZEN",
     "a sensor stands still while the others move: not taken"},
    {kMapContradicts,
     "CONTRADICTS",
     "a sensor is not where the others tell: not taken"},
    {kMapFaded, "FADED", "nothing taken for too long: the error goes to 0"},
    {kMapLimited, "LIMITED", "the error is the largest allowed"},
    {kMapRamping, "RAMPING", "the error is on its way, at the largest rate"},
    {kMapRelation,
     "RELATION",
     "a sensor does not go with the others as in training"},
    {kMapDistance, "DISTANCE", "a thermal state far from every trained one"},
    {kMapLeverage, "LEVERAGE", "a thermal state far from the middle of them"},
    {kMapSettling,
     "SETTLING",
     "begun inside a session: filters settle, the zero is not known"},
    {kMapGap, "GAP", "readings were missing not long ago: filters settle"},
    {kMapParameter,
     "PARAMETER",
     "a limit is set to what is none: the map's own holds"},
    {kMapUnhealthy,
     "UNHEALTHY",
     "not taken, FADED, SETTLING, GAP, PARAMETER, or RELATION with another"},
    {kMapJumped,
     "JUMPED",
     "a sensor changed faster than it ever did: not taken until it is back"},
};

}  // namespace

std::span<const StatusBit> StatusBits() { return kStatusBits; }

bool IsCount(const data::Unit& unit) {
  return unit.symbol.empty() || unit.quantity == data::Quantity::kTime;
}

double InitialValue(const MapProgram& program, Cell cell) {
  switch (cell) {
    case Cell::kMostError:
      return program.limits.max_error;
    case Cell::kMostRate:
      return program.limits.max_rate;
    case Cell::kFresh:
      return 1.0;
    case Cell::kSettling:
      return program.settles_after;
    default:
      return 0.0;
  }
}

double DefaultMaxRate(const data::Unit& unit, double max_error) {
  for (const char* symbol : {"um", "urad"}) {
    const data::Unit known = data::UnitOfSymbol(symbol);
    if (data::AreConvertible(known, unit)) {
      return data::Converted(10.0, known, unit);
    }
  }
  constexpr double kSeconds = 10.0;
  return max_error / kSeconds;
}

void AddController(const std::vector<const FittedModel*>& maps,
                   const LimitOptions& options,
                   MapProgram* program) {
  SetBounds(*maps.front(), program);
  WatchForStandingStill(maps, program);
  for (std::size_t k = 0; k < maps.size(); ++k) {
    if (maps[k]->applicability == nullptr) continue;
    AddJudgement(*maps[k], program, &program->forms[k]);
  }
  SetLimits(maps, options, program);
  program->read = ReadRoutine(*program);
  program->move = MoveRoutine(program->limits);
  program->MeasureSpaces();
}

void DropIdleGuards(MapProgram* program) {
  const auto is_idle = [&](const Instruction& clip, const Instruction& copy) {
    if (copy.to != clip.to || copy.a.space != Space::kReading) return false;
    const ProgramReading& reading =
        program->readings[static_cast<std::size_t>(copy.a.index)];
    const bool is_held = reading.is_position && reading.far_high < kHuge;
    return clip.op == Op::kFloor
               ? clip.c <= (is_held ? reading.trained_min : reading.far_low)
               : clip.c >= (is_held ? reading.trained_max : reading.far_high);
  };
  for (MapForm& form : program->forms) {
    const Instructions all = form.evaluate;
    std::erase_if(form.evaluate, [&](const Instruction& clip) {
      return clip.guards && clip.to.space == Space::kForm &&
             std::ranges::any_of(all, [&](const Instruction& copy) {
               return copy.op == Op::kCopy && is_idle(clip, copy);
             });
    });
  }
}

}  // namespace errmap::models
