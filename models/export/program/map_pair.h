#pragma once

#include "models/export/program/map_program.h"

namespace errmap::models {

/// One program of two maps of one axis and error: the first where its position
/// increases, the second where it decreases. Readings of one name are one; the
/// filters of both always run. Throws std::invalid_argument where a map reads
/// no position, they read different ones, or a column or the error has not the
/// same unit in both.
MapProgram JoinedPrograms(const MapProgram& increasing,
                          const MapProgram& decreasing);

/// Readings of the map `form` of a program as those of the program; what only
/// the other map reads is at its mean.
Eigen::VectorXd ReadingsOfProgram(const MapProgram& program,
                                  std::size_t form,
                                  const Eigen::VectorXd& of_map);

}  // namespace errmap::models
