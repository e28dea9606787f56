#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "models/export/program/controller.h"
#include "models/export/program/map_program.h"
#include "stats/eigen.h"

namespace errmap::models {

enum class Precision { kDouble, kSingle };

/// Runs the arithmetic of a program as the exported map does, without the
/// controller around it.
class ProgramRun {
 public:
  /// `program` must outlive the run.
  ProgramRun(const MapProgram& program, Precision precision, int form = 0);

  /// Starts a session. If a reading is not finite, returns kMapInvalid and does
  /// not start.
  int Begin(const VectorXd& readings);
  /// Advances by `dt` seconds (at least 0; ignored if the map has no memory).
  /// Leaves `error` unchanged if the returned status is kMapInvalid; the other
  /// possible bit is kMapClipped.
  int Step(double dt, const VectorXd& readings, double* error);
  /// Takes the zero at these readings.
  int Zero(const VectorXd& readings);

  // The steps of the machine, one by one.
  void Load(const VectorXd& readings);
  void Execute(const Instructions& instructions);
  double& At(Operand operand);
  bool clipped() const { return clipped_; }
  void ClearClipped() { clipped_ = false; }
  double Rounded(double value, Space to) const;

 private:
  void Apply(const Instruction& instruction);

  const MapProgram* program_;
  Precision precision_;
  int form_;  // the program's form that gives the error
  std::array<std::vector<double>, kNumSpaces> values_;
  bool clipped_ = false;
};

/// Runs the routines of a program. This checks an export, and computes its
/// expected results, before a file is written.
class ControllerRun {
 public:
  /// `program` must outlive the run.
  ControllerRun(const MapProgram& program, Precision precision);

  /// The next step taken starts a session; the output error continues from its
  /// value.
  void Begin() {
    for (const Cell cell : kOfSession) Value(cell) = 0.0;
  }
  /// The next step taken takes the zero.
  void Zero() { Value(Cell::kZeroDue) = 1.0; }
  /// Sets new limits.
  void SetLimits(double max_error, double max_rate) {
    Value(Cell::kMostError) = max_error;
    Value(Cell::kMostRate) = max_rate;
  }
  /// Reads and moves, `dt` seconds after the previous call. Sets the output
  /// error and returns the status.
  int Step(double dt, const VectorXd& readings, double* error);

 private:
  double& Value(Cell cell, int index = 0) {
    return values_[static_cast<std::size_t>(cell)]
                  [static_cast<std::size_t>(index)];
  }
  int Status() const { return status_ | (run_.clipped() ? kMapClipped : 0); }
  void Run(const Routine& routine);
  void RunOne(const Statement& statement);
  double Of(const Expression& expression);
  double& Place(const Expression& cell);

  const MapProgram* program_;
  ProgramRun run_;
  std::array<std::vector<double>, kNumCells> values_;
  int loop_ = 0;
  int status_ = 0;
};

/// Returns a number that identifies the program of a map, also in saved states.
/// It is small enough to be exact in single precision.
double Fingerprint(const MapProgram& program);

/// The same for an export: depends on the content of its files, its `name`, the
/// version of errmap and the `precision`.
double ExportId(const MapProgram& program,
                std::string_view name,
                Precision precision);

/// Returns the largest age (s) of a saved state from which a map may continue:
/// an hour, or the memory of its filters if longer.
double LongestAge(const MapProgram& program);

}  // namespace errmap::models
