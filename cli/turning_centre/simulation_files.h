#pragma once

#include <string>
#include <vector>

#include "cli/turning_centre/simulation.h"

namespace errmap::turning_centre {

struct FileOptions {
  /// Adds truth_mm or truth_urad: the error without reading noise.
  bool truth = false;
};

/// Names of the files of a simulation, in the order in which they are written.
std::vector<std::string> SimulationFileNames();

/// Returns the content of one of these files:
/// - a component's readings, one CSV file per direction if it matters, with
///   the columns record, day, cycle, position_mm (if there is a position),
///   t00_degC ... t39_degC and error_mm or error_urad. A component of a slide
///   has a row per stop (of the forward sweep, where direction does not
///   matter); one of temperature alone a row at the end of each sweep;
/// - tool_tip.csv: random poses with the true error of the tool tip;
/// - diagonals.csv: the same along both diagonals of the measured face, forth
///   and back at the state of the machine after five cycles of each day, with
///   the columns diagonal (p0p, p0n: the signs of X, Y and Z along it) and
///   diagonal_direction;
/// - temperatures.csv: record, day, time_s and all channels, every kLogSeconds;
/// - machine.toml: the kinematic chain, naming a map STEM.json per CSV file;
/// - README.md: what was simulated. The same simulation gives the same bytes on
///   every machine; numbers have 7 significant digits. Throws
///   std::invalid_argument for any other name.
std::string SimulationFile(const Simulation& simulation,
                           const FileOptions& options,
                           const std::string& name);

/// Returns the shortest text of `value` with 7 significant digits.
std::string SevenDigits(double value);

}  // namespace errmap::turning_centre
