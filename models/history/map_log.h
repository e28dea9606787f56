#pragma once

#include <memory>
#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/sessions.h"
#include "models/error_model.h"
#include "models/history/history.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Options for reading the files to which a map is applied.
struct MapDataArguments {
  std::string after;       // file of earlier rows
  bool from_rest = false;  // true: sessions begin where the rows do
  std::string time;
  std::string session;
  std::string target = {};        // column of the error; default: the map's
  std::string with = {};          // log of more columns, joined by time
  std::string clock_offset = {};  // how far that log's clock is ahead
};

/// The columns of times and sessions of a table, as far as they are known.
/// `history` may be null.
data::DatasetSelection SelectionOfRows(const History* history,
                                       const data::CsvTable& table,
                                       const MapDataArguments& arguments);

/// Finds the sessions and times of a table's rows for a map's memory. Throws
/// data::InputError as MakeMapLog does.
data::FoundSessions FindSessionsFor(const History& history,
                                    const data::CsvTable& table,
                                    const MapDataArguments& arguments);

/// Rows for the filters of a map: those of a file, after any earlier rows.
struct MapLog {
  std::shared_ptr<const data::SessionLog> log;  // null: the map has no memory
  Index first_row = 0;                          // of the file, in the log
  std::vector<Missing> missing;                 // (rows of the log)
  std::vector<std::string> warnings;            // one line each
};

/// Returns the map's inputs in every row of a table (rows x inputs); NaN if a
/// cell is not a number. Throws data::InputError if a column is missing.
MatrixXd ReadingsOf(const FittedModel& fitted, const data::CsvTable& table);

/// Returns the same, but throws data::InputError if a cell is not a number.
MatrixXd InputsOf(const FittedModel& fitted, const data::CsvTable& table);

/// Uses every row of the table, with or without a target. Of earlier rows, it
/// uses only the columns that the map filters or zeroes. Throws
/// data::InputError if the tables lack the column of sessions or times that the
/// map needs, or if that is unusable (data/measurements/sessions.h).
MapLog MakeMapLog(const FittedModel& fitted,
                  const data::CsvTable& table,
                  const MapDataArguments& arguments);

}  // namespace errmap::models
