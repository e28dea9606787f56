#pragma once

#include <string>
#include <vector>

#include "models/export/program/map_program.h"
#include "models/export/program/run_program.h"

namespace errmap::models {

using Lines = std::vector<std::string>;

/// A file of an export.
struct ExportedFile {
  std::string name;
  std::string content;
};

/// A language's syntax for routines; "{}" stands for the operand.
struct Syntax {
  const char* conjunction;
  const char* disjunction;
  const char* negation;
  const char* equal;
  const char* absolute;  // a function
  const char* when;      // "if ({}) {{"
  const char* otherwise;
  const char* end_when;  // "" if indentation ends it
  const char* loop;      // over the index from 0 to below "{0}", last "{1}"
  const char* end_loop;
  const char* index;
  const char* indent;
  const char* sine;  // functions
  const char* cosine;
  const char* of_single;  // end of their names in single precision
};

/// A function that an exported file defines for its own use.
struct Helper {
  const char* name;
  const char* argument;  // in structured text
};
inline constexpr Helper kMeanDecayHelper{"mean_decay", "U"};
inline constexpr Helper kSigmoidHelper{"sigmoid", "A"};

/// Writes the instructions and routines of a program in one language. The
/// program determines the arithmetic and its order; a language determines only
/// the notation.
class Language {
 public:
  Language(Precision precision, const Syntax& syntax)
      : precision_(precision), syntax_(syntax) {}
  virtual ~Language() = default;

  Lines Write(const MapProgram& program,
              const Instructions& instructions) const;
  Lines Write(const MapProgram& program, const Routine& routine) const;

  /// Returns the shortest text that reads back as the same double.
  virtual std::string Number(double value, bool single) const;
  /// Returns the numbers with commas, in lines that each begin with `indent`.
  std::string List(const std::vector<double>& values,
                   const std::string& indent,
                   bool single = false) const;
  /// Returns the language's expression for a cell's value.
  virtual std::string CellName(Cell cell) const = 0;
  /// Returns a coordinate of a form's trained state, inside the loop over them.
  virtual std::string TrainedState(int form, int coordinate) const = 0;
  /// Returns the condition that the status has one of these bits.
  virtual std::string HasAny(int mask) const = 0;

 protected:
  /// Returns the operand with arrays named as in C: "x[2]", "dt_s", "s[0]",
  /// "e".
  virtual std::string Place(Operand operand) const;
  /// Returns the statement that sets a bit of the status.
  virtual std::string Flag(int bit) const = 0;
  /// `narrows`: a double value is assigned to a single-precision place.
  virtual std::string Assign(const std::string& to,
                             const std::string& value,
                             bool narrows) const = 0;
  /// Assigns a value to a place (Set), or adds to it (Grow).
  virtual Lines Set(Operand to, const std::string& value, bool narrows) const;
  virtual Lines Grow(Operand to, const std::string& by, bool narrows) const;
  virtual std::string Call(const Helper& helper,
                           const std::string& argument) const = 0;
  /// If `condition` holds, sets `to` to `value`, and `clipped` if `guards`.
  virtual Lines Bound(const std::string& condition,
                      const std::string& to,
                      const std::string& value,
                      bool guards) const;
  virtual Lines Affine(const Instruction& instruction,
                       const MatrixXd& table) const = 0;
  /// kSigmoid of more than one value.
  virtual Lines Sigmoids(const Instruction& instruction) const = 0;

  /// Returns the element `index` after `first` in its array: "u[j]", "s[3 +
  /// j]".
  std::string ArrayAt(Operand first, const char* index) const;

  bool IsSingle(Space space) const {
    return precision_ == Precision::kSingle && !IsAlwaysDouble(space);
  }
  Precision precision() const { return precision_; }

 private:
  Lines WriteOne(const MapProgram& program,
                 const Instruction& instruction) const;
  std::string ValueText(const Instruction& instruction, bool single) const;
  std::string Plus(double value, bool single) const;
  Lines WriteOne(const MapProgram& program, const Statement& statement) const;
  Lines Block(const MapProgram& program,
              const std::string& first,
              const Routine& body) const;
  std::string Text(const Expression& expression) const;
  std::string Inner(const Expression& expression) const;

  Precision precision_;
  const Syntax& syntax_;
};

/// The arrays that a step computes, in declaration order.
struct LocalArray {
  Space space;
  char name;
};
inline constexpr LocalArray kLocalArrays[] = {{Space::kGain, 'g'},
                                              {Space::kDerived, 'v'},
                                              {Space::kForm, 'u'},
                                              {Space::kScaled, 'z'},
                                              {Space::kHidden, 'h'},
                                              {Space::kTerm, 't'},
                                              {Space::kStanding, 'p'},
                                              {Space::kScore, 'q'},
                                              {Space::kDoubt, 'r'}};

/// Returns the cells that a program's routines keep from step to step.
std::vector<CellInfo> KeptCells(const MapProgram& program);

/// Number of values in a saved state: the map's identity, the filters, the
/// cells of KeptCells, and their sum. The sum detects a changed state.
int NumSaved(const MapProgram& program);

/// Returns the names of the bits in `mask`, with `between` between them.
std::string StatusNames(int mask,
                        const std::string& before,
                        const std::string& between);

/// A comment for readers of an exported file: its purpose, the sign, the units,
/// the inputs in order with their trained ranges, and the state. `single`
/// precision is stated if it was used.
Lines AboutMap(const MapProgram& program,
               const std::string& name,
               Precision precision);

/// Returns the series of MeanDecay in `u` in nested form, for languages without
/// expm1.
std::string MeanDecaySeries(const std::string& u);

/// Joins `items` with commas, in lines of at most 78 characters, each after
/// `indent`.
Lines Wrapped(const std::vector<std::string>& items, const std::string& indent);

/// Joins the lines, each after `indent` and ended by a newline.
std::string Joined(const Lines& lines, const std::string& indent);

}  // namespace errmap::models
