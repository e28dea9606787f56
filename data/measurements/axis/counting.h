#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/axis/motion.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// The quantity that a column of whole numbers counts.
enum class Counted {
  kNothing,
  kRows,     // of a pass, or of all
  kPasses,   // along the axis
  kElapsed,  // passes, by a name that may be a state ("elapsed_cycles")
  kTurns,    // which of two things each pass has, by turns
  kWays,     // up and down
  kBlocks,   // of several passes each: days, warm-ups, files
};
/// "counts the passes along the axis", and so on.
std::string_view ToString(Counted counted);

struct Counter {
  std::size_t column;  // index into the table
  Counted counts;
};

/// Finds the columns that count, whatever their names. They are whole numbers
/// without a unit that change only where a pass or a direction begins, mostly
/// by the same step, or words in order of appearance. Recurring words
/// (programs, fixtures) count no passes, nor do two alternating numbers. Block
/// numbers increase by one and never decrease. If the name does not confirm it,
/// numbers must begin at 1 (three of them or more at 0). Without passes, a
/// block has at least 8 rows. Excludes positions, the target and columns that
/// `selection` names. `motion` is that of `rows`, which are in the order of
/// measurement.
std::vector<Counter> FindCounters(const CsvTable& table,
                                  const DatasetSelection& selection,
                                  std::size_t target,
                                  const std::vector<Eigen::Index>& rows,
                                  const Motion& motion);

}  // namespace errmap::data
