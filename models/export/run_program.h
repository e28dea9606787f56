#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "models/export/map_program.h"

namespace errmap::models {

enum class Precision { kDouble, kSingle };

/// What is to be said of an error beside its value; the exported maps return
/// the same bits.
enum MapStatus : int {
  kMapOutside = 1,  // a reading left its trained range: extrapolated
  kMapFar = 2,      // ... by more than the guard's margin (ProgramReading)
  kMapClipped = 4,  // a guard clipped an input of the form, or the error
  kMapInvalid = 8,  // a reading or the error is not finite: no error given
};

/// The status of readings: of the bits all but kMapClipped, or kMapInvalid.
int StatusOfReadings(const MapProgram& program,
                     const Eigen::VectorXd& readings);

/// Runs a program as the exported map does, so that an export is checked
/// against the map before anything is written.
class ProgramRun {
 public:
  /// `program` must outlive the run.
  ProgramRun(const MapProgram& program, Precision precision);

  /// Begins a session; status bits, with kMapInvalid and nothing begun where
  /// a reading is not finite.
  int Begin(const Eigen::VectorXd& readings);
  /// On by `dt` seconds (at least 0; without meaning where the map has no
  /// memory). `error` is left alone where the status says kMapInvalid.
  int Step(double dt, const Eigen::VectorXd& readings, double* error);
  /// Takes the zero at these readings.
  int Zero(const Eigen::VectorXd& readings);

 private:
  void Load(const Eigen::VectorXd& readings);
  void Execute(const Instructions& instructions);
  void Apply(const Instruction& instruction);
  double& At(Operand operand);
  double Rounded(double value, Space to) const;

  const MapProgram& program_;
  Precision precision_;
  std::array<std::vector<double>, kNumSpaces> values_;
  bool clipped_ = false;
};

}  // namespace errmap::models
