#pragma once

#include "models/export/program/map_program.h"

namespace errmap::models {

/// Joins two maps of one axis and error into one program: the first acts while
/// its position increases, the second while it decreases. Readings of the same
/// name are shared; the filters of both always run. Throws
/// std::invalid_argument if a map reads no position, if they read different
/// ones, or if a column or the error differs in unit.
MapProgram JoinedPrograms(const MapProgram& increasing,
                          const MapProgram& decreasing);

/// Converts readings of the map `form` to those of the program; readings that
/// only the other map uses are at their means.
Eigen::VectorXd ReadingsOfProgram(const MapProgram& program,
                                  std::size_t form,
                                  const Eigen::VectorXd& of_map);

}  // namespace errmap::models
