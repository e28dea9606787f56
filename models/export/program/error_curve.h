#pragma once

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "models/export/program/map_program.h"
#include "models/export/program/run_program.h"

namespace errmap::models {

/// A reading held at a value, in the unit of the map's input.
using HeldReading = std::pair<std::string, double>;

/// A map's error as a function of position (and of one other input), all else
/// held: at a thermal state that is given, steady, or left by a session.
class ErrorCurve {
 public:
  /// Steady at the trained means and what of `held` the map reads, the zero
  /// taken there. Throws std::invalid_argument where the map reads no position.
  ErrorCurve(const MapProgram& program,
             const std::vector<TrainedInput>& inputs,
             const std::vector<HeldReading>& held);

  /// Goes on from the state of `run`, after its readings; all else as above.
  ErrorCurve(const MapProgram& program,
             ProgramRun run,
             Eigen::VectorXd readings);

  /// The error at a position (input's unit). Throws std::domain_error where it
  /// is not finite.
  double operator()(double position) const;
  /// The same with the reading `input` moved, and held until every filter has
  /// arrived; the zero stays where it was taken.
  double operator()(double position, int input, double value) const;

  /// Whether this error of the map is the largest that it may give.
  bool IsAtLimit(double error) const;

  const MapProgram& program() const { return *program_; }
  /// The reading that is the position.
  const ProgramReading& position() const;
  int position_index() const { return position_; }
  const Eigen::VectorXd& readings() const { return readings_; }

 private:
  double After(double dt, const Eigen::VectorXd& readings) const;

  const MapProgram* program_;
  ProgramRun run_;
  Eigen::VectorXd readings_;
  int position_ = 0;
};

/// The points of a table at which a map's error is the largest allowed.
struct AtLimit {
  int points = 0;
  double low = std::numeric_limits<double>::infinity();  // position
  double high = -low;

  void Add(double position);
};

/// Index of the reading that is the position; -1 where there is none.
int PositionOf(const MapProgram& program);

/// The number without its last digits, which no table needs: 12 of them.
double Tidied(double value);

/// A function of position that is linear between knots.
using Curve = std::function<double(double)>;

struct Knots {
  std::vector<double> positions;  // ascending
  /// The largest difference between the curves and the lines through them,
  /// over a grid much finer than the knots.
  double interpolation_error = 0.0;
};

/// At least 2 and at most `most` positions from `low` to `high`, shared by the
/// curves, placed so that the largest interpolation error is about as small as
/// it can be: no more of them than make it `enough`.
Knots ChooseKnots(const std::vector<Curve>& curves,
                  double low,
                  double high,
                  int most,
                  double enough);

}  // namespace errmap::models
