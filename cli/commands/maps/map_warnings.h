#pragma once

#include <string>
#include <vector>

#include "data/csv.h"
#include "models/error_model.h"
#include "models/promise/applicability.h"

namespace errmap::cli {

enum class MapColumns { kInputs, kInputsAndTarget };

/// Reads a file in the names and units of the map (InMapUnits) and says what
/// was converted, unless quiet.
data::CsvTable ReadForMap(const models::FittedModel& fitted,
                          const std::string& file,
                          MapColumns columns,
                          bool quiet);

/// The map's inputs in every row of such a table (rows x inputs). Throws
/// data::InputError where a column is missing or a cell is no number.
Eigen::MatrixXd InputsOf(const models::FittedModel& fitted,
                         const data::CsvTable& table);

/// Says on stderr which inputs leave their trained range, in how many rows and
/// how far; `values` (m x p) in the map's units. Says nothing where none does.
void SayOutside(const std::vector<models::TrainedInput>& inputs,
                const Eigen::MatrixXd& values);

/// Says which rows are unlike training though each input may lie within its
/// range, and names the worst; `rows` (m) are the data rows of the file.
void SayUnlike(const std::vector<models::RowFlag>& flags,
               const std::vector<Eigen::Index>& rows);

/// "t12_degC is 38.2 degC, the other inputs tell 33.1 to 33.7".
std::string FlagText(const models::RowFlag& flag);

/// Says how many of `predicted` (m) are not finite and where, `rows` (m) being
/// the data rows of `file`; false, and nothing said, where all are finite.
bool SayNotFinite(const Eigen::VectorXd& predicted,
                  const std::vector<Eigen::Index>& rows,
                  const std::string& file);

}  // namespace errmap::cli
