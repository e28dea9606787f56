#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/column_faults.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// An input that would harm a map.
struct UselessInput {
  Eigen::Index input;
  std::string why;          // "is dead (stuck at 85 from data row 12 on)"
  std::string behind;       // what is said after it
  bool even_named = false;  // left out though somebody asked for it
};

/// Finds components of the error itself, which no control knows beforehand:
/// inputs that together determine the target, by least squares on the rows.
/// Examples are the measured next to the nominal position, or a copy in another
/// unit or in ppm of the position. Others are two halves, the size of the
/// error, or whether it exceeds a limit. Encoder counts are recognised by the
/// axis. Temperatures, times, and positions alone are states of a machine,
/// never parts of its error: a target that is a plain function of them has a
/// good map. Positions or a few settings in such a set are kept.
std::vector<UselessInput> LeakingInputs(const Dataset::Parts& parts);

/// Finds inputs that number the cycles through all sessions (a code for each
/// row), in whatever steps. Also finds those that never fall from the first row
/// to the last (hours, kilometres, energy). These are not thermal states. A
/// count that restarts with each session, such as hours since the start, may be
/// one.
std::vector<UselessInput> CountingInputs(
    const Dataset::Parts& parts, const std::vector<Eigen::Index>& sessions);

/// Finds thermometers that stop changing for the rest of the data.
std::vector<UselessInput> StuckInputs(const Dataset::Parts& parts,
                                      std::span<const ColumnFault> faults);

}  // namespace errmap::data
