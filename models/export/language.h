#pragma once

#include <string>
#include <vector>

#include "models/export/map_program.h"
#include "models/export/run_program.h"

namespace errmap::models {

using Lines = std::vector<std::string>;

/// A file of an export.
struct ExportedFile {
  std::string name;
  std::string content;
};

/// How a language writes the instructions of a program. What is computed, and
/// in which order, is the program's; a language says how it looks.
class Language {
 public:
  explicit Language(Precision precision) : precision_(precision) {}
  virtual ~Language() = default;

  Lines Write(const MapProgram& program,
              const Instructions& instructions) const;

 protected:
  enum class Function { kMeanDecay, kSine, kCosine, kSigmoid };

  /// Arrays named as in C: "x[2]", "dt_s", "s[0]", "e".
  virtual std::string Place(Operand operand) const;
  /// The double that reads back the same.
  virtual std::string Number(double value, bool single) const;
  /// `narrows`: a double value for a single place.
  virtual std::string Assign(const std::string& to,
                             const std::string& value,
                             bool narrows) const = 0;
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

  Precision precision_;
};

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
