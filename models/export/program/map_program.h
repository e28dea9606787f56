#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "models/error_model.h"
#include "models/export/program/operand.h"
#include "models/export/program/routine.h"

namespace errmap::models {

/// No reading and no error is as large; a real number in single precision too,
/// in which some compilers of structured text fold their constants.
inline constexpr double kHuge = 1e30;

/// What an instruction does; `a`, `b`, `to` are operands, `c`, `d` numbers.
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
  kFloor,          // where to < c: to = c, and clipped if `guards`
  kCeiling,        // where to > c: likewise
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

/// A reading and where it is trusted.
struct ProgramReading {
  data::ColumnInfo column;
  double trained_min = 0.0;
  double trained_max = 0.0;
  double trained_mean = 0.0;
  /// A position comes from the control itself: it is no sensor that can fail.
  /// Beyond its trained range it counts as at the end, as tables have it.
  bool is_position = false;
  /// Beyond these it comes from a failed sensor sooner than from the machine; a
  /// position is refused.
  double far_low = 0.0;
  double far_high = 0.0;
  /// What a sensor that is not connected reads, where that is not far.
  std::vector<double> dead = {};
  /// Its share of the common movement (per its unit); 0: it is not watched for
  /// standing still.
  double weight = 0.0;
  /// By how much of their ranges the others may move while it stands still.
  double others_move = 0.0;
  /// And by how much where its noise left it alone for longer than `quiet` (s).
  double finest = 0.0;
  double quiet = 0.0;
  /// By how much it may change at once (its unit), and more in each second.
  double jump = kHuge;
  double fastest = 0.0;
  /// Its kDoubt above which it contradicts the others.
  double believed = 0.0;
  /// Of a position: what the error may change by along it (target's unit per
  /// its unit).
  double slope = 0.0;
};

/// The cells of CellKind::kTable, and what a reading puts there.
inline constexpr Cell kTables[] = {Cell::kFarLow,
                                   Cell::kFarHigh,
                                   Cell::kWeight,
                                   Cell::kOthersMove,
                                   Cell::kFinest,
                                   Cell::kQuiet,
                                   Cell::kJump,
                                   Cell::kFastest,
                                   Cell::kBelieved};
double TableValue(const ProgramReading& reading, Cell cell);

/// What holds the error given, whatever the readings say.
struct ControllerLimits {
  /// Largest size, target's unit; infinite until a controller is added.
  double max_error = std::numeric_limits<double>::infinity();
  double max_rate = 0.0;   // largest change per s, but for the axis' own motion
  double hold = 60.0;      // s for which the last good readings are held
  double own_error = 0.0;  // the largest size that follows from the map
  /// How long all sensors may hold their values together (s); 0: for ever.
  double silence = 0.0;
  /// Of two maps: how far the position comes back before the other one acts,
  /// and what the error may change by then.
  double band = 0.0;      // position's unit
  double reversal = 0.0;  // target's unit
};

/// Where a number was in training, and a little more (as `predict` lets pass).
struct TrainedRange {
  Operand place;
  double low = 0.0;
  double high = 0.0;
};

/// What a map has for itself where two act, one in each direction of motion.
struct MapForm {
  /// From readings and state to the error.
  Instructions evaluate = {};
  /// From readings to kDoubt, where 1 is as far as `predict` lets pass.
  Instructions judge = {};
  /// After `judge`: to kScore, the whitened coordinates of the thermal state.
  Instructions measure = {};
  /// Thermal states of training (k x coordinates), and how far from all of them
  /// a state may be, and how far from their middle, both squared.
  Eigen::MatrixXd states = {};
  double reach = 0.0;
  double most_spread = 0.0;
  bool has_relations = false;  // `judge` writes kDoubt
  /// Of readings, then of what is derived from them.
  std::vector<TrainedRange> ranges = {};
  /// Of each of its inputs: the program's reading.
  std::vector<int> readings = {};
};

/// A map as the arithmetic that a controller does: what every exported
/// language prints, what `errmap cost` counts. Straight-line code, no choice
/// of which is left to the one who prints it.
struct MapProgram {
  std::string model;  // the SPEC
  /// Which export it is, the same in all its files; 0: none.
  double export_id = 0.0;
  data::ColumnInfo target;
  bool since_first_row = false;          // of the session
  std::string made_for;                  // rows: "direction down"; "": all
  std::vector<ProgramReading> readings;  // in the order of kReading
  /// Longest step that the filters bridge, and what they need to forget where
  /// they began (s); 0: nothing is remembered.
  double longest_bridged = std::numeric_limits<double>::infinity();
  double settles_after = 0.0;
  /// Tables of kAffine (outputs x (inputs + 1)), the last column a bias.
  std::vector<Eigen::MatrixXd> tables;
  /// The state of a session that begins with these readings.
  Instructions begin;
  /// On by dt seconds to these readings.
  Instructions advance;
  /// Takes the zero at these readings.
  Instructions zero;
  /// One map, or that of increasing positions, then that of decreasing ones.
  std::vector<MapForm> forms = std::vector<MapForm>(1);
  ControllerLimits limits;
  /// What a controller does when readings come: believes them or not, and so
  /// sets the error that is wanted.
  Routine read;
  /// What it does in every period: moves the error given towards it.
  Routine move;
  std::array<int, kNumSpaces> sizes = {};  // numbers in each space

  int size(Space space) const { return sizes[static_cast<std::size_t>(space)]; }
  bool has_memory() const { return size(Space::kState) > 0; }
  bool has_directions() const { return forms.size() > 1; }
  const Instructions& part(Part part, int form = 0) const;
  /// All parts, those of the forms last.
  std::vector<const Instructions*> parts() const;
  /// Whether a table is for numbers that are always double.
  bool IsTableDouble(std::size_t table) const;
  /// Whether a routine reads or writes the cell.
  bool Uses(Cell cell) const;
  /// Sets `sizes` from the places that are written.
  void MeasureSpaces();
  /// Whether some part has this instruction.
  bool Uses(Op op) const;
};

/// Of all readings.
Eigen::VectorXd MeanReadings(const MapProgram& program);

/// The arithmetic of a map, without limits (controller.h adds them). Throws
/// std::invalid_argument where a filter of its history runs in another unit of
/// time than seconds: a controller knows no rows.
MapProgram MakeMapProgram(const FittedModel& fitted);

}  // namespace errmap::models
