#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/axis/motion.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/reading.h"

namespace errmap::data {

/// The axis of a table: the commanded positions.
struct Axis {
  std::ptrdiff_t column = -1;  // index into the table; -1: none found
  Levels levels;               // of the rows asked for
  Motion motion;
  Evidence evidence = Evidence::kNone;
  bool sure = true;
  std::optional<std::string> alternative;
  std::vector<std::size_t> positions;  // all columns of positions, it included
  std::vector<std::size_t> measured;   // positions as read beside it
  std::vector<std::size_t> held;       // other axes, as read where they stand
  std::vector<std::size_t> numbers;    // whole numbers that go with it
};

/// Returns the column that `selection` names. Otherwise the one whose values
/// recur like commanded ones, confirmed by its name or unit, else one with the
/// name of a position. `target` is an index into the table.
Axis FindAxis(const CsvTable& table,
              const DatasetSelection& selection,
              std::size_t target,
              const std::vector<Eigen::Index>& rows);

}  // namespace errmap::data
