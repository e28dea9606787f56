#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "models/kinematics/iso230.h"
#include "models/kinematics/machine.h"
#include "stats/eigen.h"

namespace errmap::machine {

/// Poses of a machine with their true errors at the tool, session by session.
struct TruePoses {
  data::CsvTable table;
  Eigen::MatrixX3d errors = {};  // (m x 3) machine's unit; error_x_mm ...
  data::Grouping sessions = {};  // of the rows
  MatrixXd coordinates = {};     // (m x coordinates of the chain)
  Eigen::MatrixX3d places = {};  // (m x 3) KinematicChain::NominalReach

  /// Selects the rows of these sessions, in their order.
  std::vector<Index> RowsOf(const std::vector<std::string>& labels) const;
};

/// Returns the columns error_x_mm, error_y_mm and error_z_mm (m x 3), in any
/// unit of length, converted to the machine's unit. Throws data::InputError if
/// one is missing or holds no numbers.
Eigen::MatrixX3d TrueErrors(const data::CsvTable& table,
                            const models::Machine& machine);

/// True if the table has the column error_x_mm, in any unit of length.
bool HasTrueErrors(const data::CsvTable& table);

/// Throws data::InputError if a column is missing, holds no numbers, or has a
/// unit of another quantity.
TruePoses MakeTruePoses(data::CsvTable table,
                        const models::Machine& machine,
                        const std::string& session);

/// The poses on each diagonal, from the columns `diagonal` ("p0n") and
/// `diagonal_direction`.
struct DiagonalRuns {
  data::Grouping diagonals;
  std::vector<bool> upwards = {};  // along the name's signs
};

/// Returns nothing if the table has no column `diagonal`. Throws
/// data::InputError, naming the row, if a diagonal or its direction is invalid.
std::optional<DiagonalRuns> ReadDiagonalRuns(const data::CsvTable& table);

struct DiagonalFigures {
  std::string name;
  models::PositioningFigures figures;
};

/// Returns the figures along each diagonal, in the order of its first row, from
/// the rows of `rows` alone. `places` and `errors` (m x 3) are those of all
/// rows. A diagonal without rows is left out. Throws data::InputError if all
/// rows of a diagonal have the same place.
std::vector<DiagonalFigures> DiagonalFiguresOf(const data::CsvTable& table,
                                               const DiagonalRuns& runs,
                                               const std::vector<Index>& rows,
                                               const Eigen::MatrixX3d& places,
                                               const Eigen::MatrixX3d& errors);

/// Returns KinematicChain::NominalReach of every row of coordinates (m x 3).
Eigen::MatrixX3d PlacesOf(const models::KinematicChain& chain,
                          const MatrixXd& coordinates);

}  // namespace errmap::machine
