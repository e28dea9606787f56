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

/// "850 of 1700 rows have direction +, for which the map is made"; "" if it is
/// made for all of them.
std::string MadeForText(const FittedModel& fitted, const data::CsvTable& table);

/// Options for the measured rows with which a map is compared, out of its own
/// rows.
struct MapRowsOptions {
  data::MissingPolicy missing = data::MissingPolicy::kError;
  data::FaultPolicy faults = data::FaultPolicy::kKeep;
  MapDataArguments log = {};
  /// False if the caller has the rows in between: then no filters run.
  bool with_memory = true;
};

/// Rows with the map's inputs and target, in its names and units.
struct MapRows {
  data::CsvTable table;
  data::PreparedDataset prepared;
  /// The rows with the log through which the map's filters run.
  data::Dataset dataset;
  /// What the log lacks before some measured row. A missing start of a session
  /// takes precedence over missing readings.
  Missing missing = Missing::kNothing;
  std::vector<Missing> missing_before;  // (rows of the data set) likewise
  std::vector<std::string> warnings;    // of the map's memory, one line each
};

/// Makes the rows from a table that ReadForMap returned. Throws
/// data::InputError as MakeDataset and MakeMapLog do.
MapRows MakeMapRows(const FittedModel& fitted,
                    data::CsvTable table,
                    const MapRowsOptions& options);

/// Session and time of a table's rows; if unknown, one session and time 0.
struct MomentsOfRows {
  std::vector<Moment> at;      // a row each
  std::string session_column;  // that names the sessions; "" where none does
  std::optional<bool> dated;   // whether times are dates; none without times
};
MomentsOfRows MomentsOf(const FittedModel& fitted,
                        const data::CsvTable& table,
                        const std::vector<Index>& rows,
                        const MapDataArguments& arguments);

/// (rows of the data set) Time since the first row of the session in the table,
/// or in earlier rows; 0 if there are no times.
VectorXd ElapsedSinceStart(const FittedModel& fitted,
                           const MapRows& rows,
                           const MapDataArguments& arguments);

/// (rows of the data set) Positions from the table, in the unit of the map's
/// held-out errors, even if the map does not read them. (0) if the table lacks
/// them, or lacks one in some row.
VectorXd PositionsOf(const FittedModel& fitted, const MapRows& rows);

}  // namespace errmap::models
