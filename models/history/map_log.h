#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/sessions.h"
#include "models/error_model.h"
#include "models/history/history.h"

namespace errmap::models {

/// What is told of the sessions of rows that a map is to predict.
struct MapLogArguments {
  std::string after;       // file of earlier rows
  bool from_rest = false;  // sessions begin where the rows do
  std::string time;
  std::string session;
};

/// Sessions and times of a table's rows as a map's memory needs them. Throws
/// data::InputError as MakeMapLog does.
data::FoundSessions FindSessionsFor(const History& history,
                                    const data::CsvTable& table,
                                    const MapLogArguments& arguments);

/// What the filters of a map run through: a file's rows, those before it first.
struct MapLog {
  std::shared_ptr<const data::SessionLog> log;  // null: the map has no memory
  Eigen::Index first_row = 0;                   // of the file, in the log
  std::vector<Missing> missing;                 // (rows of the log)
  std::vector<std::string> warnings;            // one line each
};

/// The map's inputs in every row of a table (rows x inputs); NaN where a cell
/// is no number. Throws data::InputError where a column is missing.
Eigen::MatrixXd ReadingsOf(const FittedModel& fitted,
                           const data::CsvTable& table);

/// The same where every cell must be a number; else data::InputError.
Eigen::MatrixXd InputsOf(const FittedModel& fitted,
                         const data::CsvTable& table);

/// Of every row of the table, whether it has a target or not; of earlier rows
/// what the map remembers. Throws data::InputError where the tables lack the
/// column of sessions or times that the map needs, or where those will not do
/// (data/measurements/sessions.h).
MapLog MakeMapLog(const FittedModel& fitted,
                  const data::CsvTable& table,
                  const MapLogArguments& arguments);

}  // namespace errmap::models
