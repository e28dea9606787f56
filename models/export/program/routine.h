#pragma once

#include <cstddef>
#include <utility>
#include <vector>

// A small language of numbers, conditions and loops over the readings. It
// describes once what a controller does around a map's arithmetic
// (controller_routines.cc). C, Python and structured text print it;
// ControllerRun runs it.

namespace errmap::models {

/// Where a program stores a value.
enum class Space {
  kReading,   // an input as the sensor gives it
  kTime,      // seconds since the step before
  kState,     // kept from step to step: filters and zeros
  kGain,      // of the filters of one time constant, in this step: two each
  kDerived,   // computed from readings and state
  kForm,      // an input of the form, clipped
  kScaled,    // the same, scaled for a member
  kHidden,    // hidden nodes of a net
  kTerm,      // partial sums of a polynomial, output of a net
  kError,     // the predicted error
  kStanding,  // sensors minus their trained means
  kScore,     // coordinates of their joint thermal state
  kDoubt,     // how far each reading is from what the others suggest
};
inline constexpr std::size_t kNumSpaces = 13;

/// Time, gains, states and values derived from them stay double even in a
/// single-precision program, where a slow filter would stop moving. The checks
/// stay double, too, since they must not depend on the precision.
constexpr bool IsAlwaysDouble(Space space) {
  return space == Space::kTime || space == Space::kState ||
         space == Space::kGain || space == Space::kDerived ||
         space == Space::kStanding || space == Space::kScore ||
         space == Space::kDoubt;
}

struct Operand {
  Space space = Space::kError;
  int index = 0;

  bool operator==(const Operand&) const = default;
};

/// The variables of a routine.
enum class Cell {
  kDt,       // s since the call before
  kCommon,   // the common position of the watched readings
  kAway,     // squared distance between thermal states
  kTarget,   // kWanted within the limit
  kBound,    // kMostError if that is a valid limit
  kPace,     // kMostRate if that is a valid limit
  kChanged,  // 1: a watched reading changed in this step
  kReading,  // array
  kDoubt,    // array
  kError,    // of the map, before any limit
  // Kept from step to step.
  kBegun,      // 1 after the first step taken
  kZeroDue,    // 1: the next step taken takes the zero
  kWaited,     // s since the last step taken
  kMissed,     // s since the last good error
  kWanted,     // the error that kGiven moves to
  kGiven,      // the error given
  kRoom,       // how far it may still change
  kMostError,  // limits
  kMostRate,
  kFresh,     // 1: started inside a session, or unknown
  kSettling,  // s until the filters have settled again
  kPending,   // fraction of the next second that has passed
  kStood,     // s since one of the watched readings changed
  kLeapt,     // kWaited when a reading last jumped; 0: it is back
  kKnown,     // map whose state kNear is, from 1; 0: none
  kDown,      // 1: the map for decreasing positions acts
  kTurn,      // the furthest position in the direction of motion
  kLast,      // array: each reading when last trusted
  kSince,     // array: kCommon at each reading's last change
  kAlike,     // array: steps since then
  kHeld,      // array: s since then
  kNear,      // array: a trained thermal state close by
  // Constants of each reading (ProgramReading), arrays.
  kFarLow,
  kFarHigh,
  kWeight,
  kOthersMove,
  kFinest,
  kQuiet,
  kJump,
  kFastest,
  kBelieved,
};
inline constexpr int kNumCells = static_cast<int>(Cell::kBelieved) + 1;

/// The storage of a cell.
enum class CellKind { kLocal, kKept, kTable };

struct CellInfo {
  Cell cell;
  const char* name;  // in C and Python
  CellKind kind;
  bool is_array;
};
const CellInfo& InfoOf(Cell cell);

/// The parts of a map's program that a routine runs.
enum class Part { kBegin, kAdvance, kZero, kEvaluate, kJudge, kMeasure };

struct Expression {
  enum class Kind {
    kNumber,
    kCell,
    kPlace,    // a value of the program
    kTrained,  // a coordinate, `index`, of the loop's trained state of `form`
    kAny,      // true if the status has a bit of `mask`
    kNot,
    kNegative,
    kAbsolute,
    kAnd,
    kOr,
    kLess,
    kMore,
    kAtLeast,
    kAtMost,
    kEqual,
    kPlus,
    kMinus,
    kTimes,
  };
  /// Index of an array's cell: the loop's index.
  static constexpr int kLoop = -1;

  Expression(double value) : number(value) {}  // NOLINT: reads as a number
  Expression(Cell of, int at = kLoop)
      : kind(Kind::kCell), cell(of), index(at) {}
  Expression(Operand of) : kind(Kind::kPlace), place(of) {}  // NOLINT
  Expression(Kind of, std::vector<Expression> from)
      : kind(of), parts(std::move(from)) {}

  Kind kind = Kind::kNumber;
  double number = 0.0;
  Cell cell = Cell::kDt;
  int index = kLoop;
  int mask = 0;
  Operand place = {};
  int form = 0;
  std::vector<Expression> parts = {};
};

struct Statement {
  enum class Kind { kAssign, kIf, kEach, kFlag, kRun };

  Kind kind = Kind::kAssign;
  std::vector<Expression> sides = {};     // kAssign: to, value; kIf: condition
  int flag = 0;                           // kFlag: a bit of the status
  Part part = Part::kEvaluate;            // kRun
  int count = 0;                          // kEach; 0: as many as readings
  int form = 0;                           // kRun: of MapProgram::forms
  std::vector<Statement> body = {};       // kIf, loops
  std::vector<Statement> otherwise = {};  // kIf
};
using Routine = std::vector<Statement>;

/// True if some statement reads or writes the cell.
bool Uses(const Routine& routine, Cell cell);

// ---- To write routines with ----

/// These operators apply only if at least one side is an Expression.
inline Expression Read(Cell cell) { return {cell}; }
inline Expression Any(int mask) {
  Expression any(Expression::Kind::kAny, {});
  any.mask = mask;
  return any;
}
inline Expression Trained(int form, int coordinate) {
  Expression trained(Expression::Kind::kTrained, {});
  trained.form = form;
  trained.index = coordinate;
  return trained;
}
inline Expression Absolute(Expression a) {
  return {Expression::Kind::kAbsolute, {std::move(a)}};
}
inline Expression operator!(Expression a) {
  return {Expression::Kind::kNot, {std::move(a)}};
}
inline Expression operator-(Expression a) {
  return {Expression::Kind::kNegative, {std::move(a)}};
}
inline Expression operator&&(Expression a, Expression b) {
  return {Expression::Kind::kAnd, {std::move(a), std::move(b)}};
}
inline Expression operator||(Expression a, Expression b) {
  return {Expression::Kind::kOr, {std::move(a), std::move(b)}};
}
inline Expression operator<(Expression a, Expression b) {
  return {Expression::Kind::kLess, {std::move(a), std::move(b)}};
}
inline Expression operator>(Expression a, Expression b) {
  return {Expression::Kind::kMore, {std::move(a), std::move(b)}};
}
inline Expression operator>=(Expression a, Expression b) {
  return {Expression::Kind::kAtLeast, {std::move(a), std::move(b)}};
}
inline Expression operator<=(Expression a, Expression b) {
  return {Expression::Kind::kAtMost, {std::move(a), std::move(b)}};
}
inline Expression operator==(Expression a, Expression b) {
  return {Expression::Kind::kEqual, {std::move(a), std::move(b)}};
}
inline Expression operator+(Expression a, Expression b) {
  return {Expression::Kind::kPlus, {std::move(a), std::move(b)}};
}
inline Expression operator-(Expression a, Expression b) {
  return {Expression::Kind::kMinus, {std::move(a), std::move(b)}};
}
inline Expression operator*(Expression a, Expression b) {
  return {Expression::Kind::kTimes, {std::move(a), std::move(b)}};
}

inline Statement Set(Cell to, Expression value) {
  return {.kind = Statement::Kind::kAssign, .sides = {to, std::move(value)}};
}
inline Statement SetAt(Cell to, int index, Expression value) {
  return {.kind = Statement::Kind::kAssign,
          .sides = {Expression{to, index}, std::move(value)}};
}
inline Statement If(Expression condition,
                    Routine body,
                    Routine otherwise = {}) {
  return {.kind = Statement::Kind::kIf,
          .sides = {std::move(condition)},
          .body = std::move(body),
          .otherwise = std::move(otherwise)};
}
inline Statement EachReading(Routine body) {
  return {.kind = Statement::Kind::kEach, .body = std::move(body)};
}
inline Statement Each(int count, Routine body) {
  return {
      .kind = Statement::Kind::kEach, .count = count, .body = std::move(body)};
}
inline Statement Flag(int bit) {
  return {.kind = Statement::Kind::kFlag, .flag = bit};
}
inline Statement Do(Part part, int form = 0) {
  return {.kind = Statement::Kind::kRun, .part = part, .form = form};
}

}  // namespace errmap::models
