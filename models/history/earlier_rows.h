#pragma once

#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/sessions.h"
#include "models/error_model.h"
#include "models/history/map_log.h"
#include "stats/eigen.h"

namespace errmap::models {

struct EarlierRows {
  Index count = 0;
  std::vector<std::string> remarks;  // on the names and units of their columns
};

/// Puts the rows of the file `arguments.after` before those of a table, in
/// `found` and in its `readings` (rows x inputs of the map, NaN if a filter
/// does not read them). The file may have its own clock, order and names. Uses
/// rows before the first row of their session: the session of that name if both
/// files have the same column of sessions, else the next one to begin without a
/// night between. Throws data::InputError if the file is unusable or one clock
/// has dates and the other none.
EarlierRows PrependEarlier(const FittedModel& fitted,
                           const data::CsvTable& table,
                           const MapDataArguments& arguments,
                           data::FoundSessions* found,
                           MatrixXd* readings);

}  // namespace errmap::models
