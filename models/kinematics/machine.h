#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "data/units.h"
#include "models/error_model.h"
#include "models/kinematics/kinematic_chain.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Source of an error's size: a map or a constant.
struct ErrorSource {
  double constant = 0.0;                   // the chain's length unit, or rad
  std::shared_ptr<const FittedModel> map;  // null: `constant`
  std::string file;                        // of the map, for messages
};

/// An error of a machine's chain.
struct MachineError {
  std::string name;  // ISO 230-1: "EXX"
  /// One source, or one each for forward and reverse motion of its link.
  std::vector<ErrorSource> sources;
};

/// A machine's chain with a source for each of its errors.
struct Machine {
  std::string name;
  data::Unit length;  // of the chain
  KinematicChain chain;
  std::vector<std::string> columns;  // of the chain's coordinates
  std::vector<MachineError> errors;  // as chain.errors()
  /// Directions X, Y and Z of the base in which an error affects the work.
  std::array<bool, 3> sensitive = {true, true, true};
};

/// Unit of an error's values: the machine's length, or rad.
data::Unit UnitOf(const Machine& machine, ErrorDirection direction);

/// Lengths (m) of errors (m x 3) in the sensitive directions.
VectorXd SensitiveLengths(const Machine& machine,
                          const Eigen::MatrixX3d& errors);

/// "X" ... "C".
std::string_view LetterOf(ErrorDirection direction);

/// Returns the column with a link's direction of motion: "x_direction" for
/// "x_mm".
std::string DirectionColumn(std::string_view coordinate);

}  // namespace errmap::models
