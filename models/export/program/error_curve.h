#pragma once

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "models/export/program/map_program.h"
#include "models/export/program/run_program.h"
#include "stats/eigen.h"

namespace errmap::models {

/// A reading held at a value, in the unit of the map's input.
using HeldReading = std::pair<std::string, double>;

/// A map's error as a function of position (and of one other input), with all
/// other readings fixed. The thermal state is steady at given values, or that
/// after a session.
class ErrorCurve {
 public:
  /// A steady state at the trained means and the values `held`; the zero is
  /// taken there. Throws std::invalid_argument if the map reads no position.
  ErrorCurve(const MapProgram& program,
             const std::vector<TrainedInput>& inputs,
             const std::vector<HeldReading>& held);

  /// Continues from the state of `run`, after its readings; otherwise as above.
  ErrorCurve(const MapProgram& program, ProgramRun run, VectorXd readings);

  /// Returns the error at a position (input's unit). Throws std::domain_error
  /// if it is not finite.
  double operator()(double position) const;
  /// As above, with the reading `input` changed and held until every filter has
  /// settled. The zero is unchanged.
  double operator()(double position, int input, double value) const;

  /// True if this error equals the map's limit.
  bool IsAtLimit(double error) const;

  const MapProgram& program() const { return *program_; }
  /// Returns the reading that is the position.
  const ProgramReading& position() const;
  int position_index() const { return position_; }
  const VectorXd& readings() const { return readings_; }

 private:
  double After(double dt, const VectorXd& readings) const;

  const MapProgram* program_;
  ProgramRun run_;
  VectorXd readings_;
  int position_ = 0;
};

/// The points of a table at which a map's error is at its limit.
struct AtLimit {
  int points = 0;
  double low = std::numeric_limits<double>::infinity();  // position
  double high = -low;

  void Add(double position);
};

/// Index of the reading that is the position; -1 if there is none.
int PositionOf(const MapProgram& program);

/// Rounds to 12 significant digits, which are enough for any table.
double Tidied(double value);

/// A function of position, to be interpolated linearly between knots.
using Curve = std::function<double(double)>;

struct Knots {
  std::vector<double> positions;  // ascending
  /// Largest difference between the curves and their interpolants, on a grid
  /// much finer than the knots.
  double interpolation_error = 0.0;
};

/// Chooses from 2 to `most` positions in `low` .. `high`, shared by the curves,
/// so that the largest interpolation error is nearly minimal. Uses only as many
/// as reduce the error to `enough`.
Knots ChooseKnots(const std::vector<Curve>& curves,
                  double low,
                  double high,
                  int most,
                  double enough);

}  // namespace errmap::models
