#pragma once

#include <string>
#include <vector>

#include "cli/study_file/memory/map_log.h"
#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/promise/applicability.h"
#include "models/promise/session_offset.h"

namespace errmap::cli {

/// --missing of files of probes: rows without a target are readings between
/// them.
inline constexpr const char* kProbesOnly = "drop-rows";

/// Which measured rows a map is held against.
struct MapRowsArguments {
  std::string file;
  std::string missing = "error";
  std::string faults = "keep";
  MapLogArguments log;
  /// False where the caller knows the rows between: no filters are run.
  bool with_memory = true;
};

/// Rows with the map's inputs and target, in its names and units.
struct MapRows {
  data::CsvTable table;
  data::PreparedDataset prepared;
  /// The rows with what the map's filters run through.
  data::Dataset dataset;
  /// Whether the first rows of a session with measured rows are missing.
  bool begins_inside = false;
};

/// Reads them; remarks and warnings go to stderr unless quiet. Throws
/// data::InputError as MakeDataset and MakeMapLog do.
MapRows ReadMapRows(const models::FittedModel& fitted,
                    const MapRowsArguments& arguments,
                    bool quiet);

/// Says where `rows` are unlike training, unless quiet.
struct RowsJudged {
  Eigen::MatrixXd form_inputs;  // (rows x inputs of the form)
  std::vector<models::RowFlag> flags;
};
RowsJudged JudgeMapRows(const models::FittedModel& fitted,
                        const MapRows& rows,
                        bool quiet);

/// Session and time of these rows of a table, as far as it tells; one session
/// and time 0 where it does not.
std::vector<models::Moment> MomentsOf(const models::FittedModel& fitted,
                                      const data::CsvTable& table,
                                      const std::vector<Eigen::Index>& rows,
                                      const MapLogArguments& arguments);

/// (rows of the data set) Time since the first row of the session in the file,
/// or in that of --after; 0 where there are no times.
Eigen::VectorXd ElapsedSinceStart(const models::FittedModel& fitted,
                                  const MapRows& rows,
                                  const MapLogArguments& arguments);

}  // namespace errmap::cli
