#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "models/error_model.h"
#include "models/export/program/routine.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Larger than any reading or error. It is finite in single precision, too,
/// since some compilers of structured text use that for constants.
inline constexpr double kHuge = 1e30;

/// The operations of an instruction; `a`, `b`, `to` are operands, `c`, `d`
/// numbers.
enum class Op {
  kSet,            // to = c
  kCopy,           // to = a
  kSubtract,       // to = a - b
  kShift,          // to = a - c
  kScale,          // to = (a - c) * d
  kTimes,          // to = a * b
  kTimesPlus,      // to = a * b + c
  kTimesPlusTerm,  // to = a * b + (the kTerm after `to`)
  kLinear,         // to = c * a + d
  kAccumulate,     // to = to + c * a
  kMeanDecay,      // to = (1 - exp(-a / c)) / (a / c), 1 where a = 0
  kGain,           // to = a / c * b
  kLag,            // to = to + a * (b - to)
  kAddProduct,     // to = to + a * b
  kSine,           // to = sin(c * a)
  kCosine,         // to = cos(c * a)
  kFloor,          // if to < c: to = c, and clipped if `guards`
  kCeiling,        // if to > c: likewise
  kAffine,         // to, ... = tables[table] * (a, ..., 1)
  kSigmoid,        // `count` from `to` on: to = 1 / (1 + exp(-to))
};

struct Instruction {
  Op op = Op::kSet;
  Operand to;
  Operand a = {};
  Operand b = {};
  double c = 0.0;
  double d = 0.0;
  std::size_t table = 0;
  int count = 1;
  bool guards = false;
};
using Instructions = std::vector<Instruction>;

/// A reading and the range in which it is trusted.
struct ProgramReading {
  data::ColumnInfo column;
  double trained_min = 0.0;
  double trained_max = 0.0;
  double trained_mean = 0.0;
  /// A position comes from the control, not from a sensor that can fail. Beyond
  /// its trained range the end of the range is used, as in tables.
  bool is_position = false;
  /// Beyond these limits, a sensor has probably failed; a position is refused.
  double far_low = 0.0;
  double far_high = 0.0;
  /// The readings of a disconnected sensor, unless they are beyond far_low,
  /// far_high.
  std::vector<double> dead = {};
  /// Its weight in the common movement (per its unit). 0: it is not checked for
  /// standing still.
  double weight = 0.0;
  /// Allowed movement of the others (in shares of their ranges) while it stands
  /// still.
  double others_move = 0.0;
  /// The same if its noise was absent for longer than `quiet` (s).
  double finest = 0.0;
  double quiet = 0.0;
  /// Largest sudden change (its unit), and the further change allowed per
  /// second.
  double jump = kHuge;
  double fastest = 0.0;
  /// It contradicts the others if its kDoubt is above this.
  double believed = 0.0;
  /// For a position: the largest change of the error along it (target's unit
  /// per its unit).
  double slope = 0.0;
};

/// The cells of CellKind::kTable, and the value of a reading in them.
struct ReadingTable {
  Cell cell;
  double ProgramReading::*value;
};
inline constexpr ReadingTable kTables[] = {
    {Cell::kFarLow, &ProgramReading::far_low},
    {Cell::kFarHigh, &ProgramReading::far_high},
    {Cell::kWeight, &ProgramReading::weight},
    {Cell::kOthersMove, &ProgramReading::others_move},
    {Cell::kFinest, &ProgramReading::finest},
    {Cell::kQuiet, &ProgramReading::quiet},
    {Cell::kJump, &ProgramReading::jump},
    {Cell::kFastest, &ProgramReading::fastest},
    {Cell::kBelieved, &ProgramReading::believed}};

/// The limits of the output error, for any readings.
struct ControllerLimits {
  /// Largest size, target's unit; infinite until a controller is added.
  double max_error = std::numeric_limits<double>::infinity();
  double max_rate = 0.0;   // largest change per s, without the axis' own motion
  double hold = 60.0;      // s for which the last good readings are used
  double own_error = 0.0;  // the largest size, derived from the map
  /// Longest time (s) that all sensors may hold their values; 0: no
  /// limit.
  double silence = 0.0;
  /// For two maps: the reversal of the position at which the other one takes
  /// over, and the largest change of the error then.
  double band = 0.0;      // position's unit
  double reversal = 0.0;  // target's unit
};

/// The trained range of a value, slightly widened (as `predict` allows).
struct TrainedRange {
  Operand place;
  double low = 0.0;
  double high = 0.0;
};

/// The parts of each map if there are two, one for each direction of motion.
struct MapForm {
  /// Computes the error from readings and state.
  Instructions evaluate = {};
  /// Computes kDoubt from readings; `predict` accepts up to 1.
  Instructions judge = {};
  /// After `judge`: computes kScore, the whitened coordinates of the thermal
  /// state.
  Instructions measure = {};
  /// Trained thermal states (k x coordinates), and the limits of the squared
  /// distance to the nearest of them and to their mean.
  MatrixXd states = {};
  double reach = 0.0;
  double most_spread = 0.0;
  bool has_relations = false;  // `judge` writes kDoubt
  /// Ranges of the readings, then of the values derived from them.
  std::vector<TrainedRange> ranges = {};
  /// For each of its inputs: the index of the program's reading.
  std::vector<int> readings = {};
};

/// A map as the arithmetic of a controller: every exported language prints it,
/// and `errmap cost` counts it. The code is straight-line, so every language
/// computes the same.
struct MapProgram {
  std::string model;  // the SPEC
  /// Identifies an export, in all its files; 0: none.
  double export_id = 0.0;
  data::ColumnInfo target;
  bool since_first_row = false;          // of the session
  std::string made_for;                  // rows: "direction down"; "": all
  std::vector<ProgramReading> readings;  // in the order of kReading
  /// Longest step that the filters bridge, and the time in which they forget
  /// their start (s); 0: the map has no memory.
  double longest_bridged = std::numeric_limits<double>::infinity();
  double settles_after = 0.0;
  /// Tables of kAffine (outputs x (inputs + 1)); the last column is the bias.
  std::vector<MatrixXd> tables;
  /// Starts a session with these readings.
  Instructions begin;
  /// Advances by dt seconds to these readings.
  Instructions advance;
  /// Takes the zero at these readings.
  Instructions zero;
  /// One map, or those of increasing and decreasing positions, in this order.
  std::vector<MapForm> forms = std::vector<MapForm>(1);
  ControllerLimits limits;
  /// Runs when readings arrive: decides whether to trust them, and sets the
  /// target of the output error.
  Routine read;
  /// Runs in every period: moves the output error towards its target.
  Routine move;
  std::array<int, kNumSpaces> sizes = {};  // number of values in each space

  int size(Space space) const { return sizes[static_cast<std::size_t>(space)]; }
  bool has_memory() const { return size(Space::kState) > 0; }
  bool has_directions() const { return forms.size() > 1; }
  const Instructions& part(Part part, int form = 0) const;
  /// Returns all parts; parts that belong to a form come last.
  std::vector<const Instructions*> parts() const;
  /// True if the values of a table are always double.
  bool IsTableDouble(std::size_t table) const;
  /// True if a routine reads or writes the cell.
  bool Uses(Cell cell) const;
  /// Sets `sizes` from the operands that are written.
  void MeasureSpaces();
  /// True if some part has this instruction.
  bool Uses(Op op) const;
};

/// Returns the value of each reading in a table.
std::vector<double> TableValues(const MapProgram& program,
                                const ReadingTable& table);

/// Returns the trained means of all readings.
VectorXd MeanReadings(const MapProgram& program);

/// Makes the arithmetic of a map, without limits (controller.h adds them).
/// Throws std::invalid_argument if a filter of its history uses another unit of
/// time than seconds: a controller does not count rows.
MapProgram MakeMapProgram(const FittedModel& fitted);

/// Returns instructions that compute the polynomial in kTerm 0 from its scaled
/// inputs in kScaled 0, 1, .... They nest it (Horner's scheme) by the input
/// that most terms contain, then recursively, so that no power is computed.
Instructions NestedPolynomial(const PolynomialForm& form);

/// Joins two maps of one axis and error into one program: the first acts while
/// its position increases, the second while it decreases. Readings of the same
/// name are shared; the filters of both always run. Throws
/// std::invalid_argument if a map reads no position, if they read different
/// ones, or if a column or the error differs in unit.
MapProgram JoinedPrograms(const MapProgram& increasing,
                          const MapProgram& decreasing);

/// Converts readings of the map `form` to those of the program; readings that
/// only the other map uses are at their means.
VectorXd ReadingsOfProgram(const MapProgram& program,
                           std::size_t form,
                           const VectorXd& of_map);

}  // namespace errmap::models
