#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/history/history.h"
#include "models/history/map_log.h"
#include "models/session/read_for_map.h"
#include "models/session/session_offset.h"
#include "stats/eigen.h"

namespace errmap::models {

/// "850 of 1700 rows have direction +, for which the map is made"; "" where it
/// is made for all of them.
std::string MadeForText(const FittedModel& fitted, const data::CsvTable& table);

/// Which measured rows of a table a map is held against: of those that it is
/// made for.
struct MapRowsOptions {
  data::MissingPolicy missing = data::MissingPolicy::kError;
  data::FaultPolicy faults = data::FaultPolicy::kKeep;
  MapDataArguments log = {};
  /// False where the caller knows the rows between: no filters are run.
  bool with_memory = true;
};

/// Rows with the map's inputs and target, in its names and units.
struct MapRows {
  data::CsvTable table;
  data::PreparedDataset prepared;
  /// The rows with what the map's filters run through.
  data::Dataset dataset;
  /// Before any measured row; the start of a session sooner than readings.
  Missing missing = Missing::kNothing;
  std::vector<Missing> missing_before;  // (rows of the data set) likewise
  std::vector<std::string> warnings;    // of the map's memory, one line each
};

/// Of a table that ReadForMap gave. Throws data::InputError as MakeDataset and
/// MakeMapLog do.
MapRows MakeMapRows(const FittedModel& fitted,
                    data::CsvTable table,
                    const MapRowsOptions& options);

/// Session and time of rows of a table, as far as it tells; one session and
/// time 0 where it does not.
struct MomentsOfRows {
  std::vector<Moment> at;      // a row each
  std::string session_column;  // that names the sessions; "" where none does
  std::optional<bool> dated;   // whether times are dates; none without times
};
MomentsOfRows MomentsOf(const FittedModel& fitted,
                        const data::CsvTable& table,
                        const std::vector<Index>& rows,
                        const MapDataArguments& arguments);

/// (rows of the data set) Time since the first row of the session in the
/// table, or in the rows before it; 0 where there are no times.
VectorXd ElapsedSinceStart(const FittedModel& fitted,
                           const MapRows& rows,
                           const MapDataArguments& arguments);

/// (rows of the data set) Positions, as the map's held-out errors have them,
/// from the table: the map itself need not read them. (0) where the table has
/// none, or not for every row.
VectorXd PositionsOf(const FittedModel& fitted, const MapRows& rows);

}  // namespace errmap::models
