#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/column_faults.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// An input of a data set that a map is better without.
struct UselessInput {
  Eigen::Index input;
  std::string why;          // "is dead (stuck at 85 from data row 12 on)"
  std::string behind;       // what is said after it
  bool even_named = false;  // left out though somebody asked for it
};

/// Those that together give the target: no control knows it beforehand.
std::vector<UselessInput> LeakingInputs(const Dataset::Parts& parts);

/// What numbers the cycles on through the sessions (a code for each row, of
/// `num_sessions`), or never falls in any of them (hours, kilometres, energy):
/// it is a thermal state in none.
std::vector<UselessInput> CountingInputs(
    const Dataset::Parts& parts,
    const std::vector<Eigen::Index>& sessions,
    Eigen::Index num_sessions);

/// Thermometers that were alive and end stuck.
std::vector<UselessInput> StuckInputs(const Dataset::Parts& parts,
                                      std::span<const ColumnFault> faults);

}  // namespace errmap::data
