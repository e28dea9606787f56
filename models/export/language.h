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

/// Words of a language for what routines do; "{}" is what they are about.
struct Syntax {
  const char* conjunction;
  const char* disjunction;
  const char* negation;
  const char* equal;
  const char* absolute;  // a function
  const char* when;      // "if ({}) {{"
  const char* otherwise;
  const char* end_when;  // "" where indentation ends it
  const char* loop;      // over the index from 0 to below "{0}", last "{1}"
  const char* end_loop;
  const char* index;
  const char* indent;
};

/// How a language writes the instructions and routines of a program. What is
/// computed, and in which order, is the program's; a language says how it
/// looks.
class Language {
 public:
  Language(Precision precision, const Syntax& syntax)
      : precision_(precision), syntax_(syntax) {}
  virtual ~Language() = default;

  Lines Write(const MapProgram& program,
              const Instructions& instructions) const;
  Lines Write(const MapProgram& program, const Routine& routine) const;

  /// The double that reads back the same.
  virtual std::string Number(double value, bool single) const;
  /// Where the number of a cell is, in the language's own way of naming.
  virtual std::string CellName(Cell cell) const = 0;
  /// The loop's trained state of a form, at one coordinate.
  virtual std::string TrainedState(int form, int coordinate) const = 0;
  /// Whether the status has one of these bits.
  virtual std::string HasAny(int mask) const = 0;

 protected:
  enum class Function { kMeanDecay, kSine, kCosine, kSigmoid };

  /// Arrays named as in C: "x[2]", "dt_s", "s[0]", "e".
  virtual std::string Place(Operand operand) const;
  /// A bit of the status is set.
  virtual std::string Flag(int bit) const = 0;
  /// `narrows`: a double value for a single place.
  virtual std::string Assign(const std::string& to,
                             const std::string& value,
                             bool narrows) const = 0;
  /// To a place, a value of its own or what it grows by.
  virtual Lines Set(Operand to, const std::string& value, bool narrows) const;
  virtual Lines Grow(Operand to, const std::string& by, bool narrows) const;
  virtual std::string Call(Function function,
                           const std::string& argument,
                           bool single) const = 0;
  /// Where `condition` holds, `to` becomes `value`, and clipped where `guards`.
  virtual Lines Bound(const std::string& condition,
                      const std::string& to,
                      const std::string& value,
                      bool guards) const = 0;
  virtual Lines Affine(const Instruction& instruction,
                       const Eigen::MatrixXd& table) const = 0;
  /// kSigmoid of more than one number.
  virtual Lines Sigmoids(const Instruction& instruction) const = 0;

  /// The place `index` after `first` in its array: "u[j]", "s[3 + j]".
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

/// The arrays that a step computes, in the order of their declarations.
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

/// What the routines of a program keep from step to step.
std::vector<CellInfo> KeptCells(const MapProgram& program);

/// How many numbers a saved state has: which map it is of, the filters' and
/// those of KeptCells, and the sum of these, so that a changed one is refused.
int NumSaved(const MapProgram& program);

/// The names of the bits in `mask`, with `between` them.
std::string StatusNames(int mask,
                        const std::string& before,
                        const std::string& between);

/// What whoever opens an exported file must know, for a comment: what it
/// computes, the sign, units, inputs in order with their trained range, the
/// state. `single` as it was written.
Lines AboutMap(const MapProgram& program,
               const std::string& name,
               Precision precision);

/// The series of MeanDecay in `u`, nested, for languages without expm1.
std::string MeanDecaySeries(const std::string& u);

/// `items` with commas between them, in lines of at most 78 characters, each
/// after `indent`.
Lines Wrapped(const std::vector<std::string>& items, const std::string& indent);

/// Each line after `indent`, ended.
std::string Joined(const Lines& lines, const std::string& indent);

}  // namespace errmap::models
