#pragma once

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "models/history/history.h"

namespace errmap::models {

// A log that begins inside a session looks like one that begins with
// it, but the filters of a map begin wrong. Where sessions begin, thermometers
// stand to each other as the machine at rest leaves them; later some have
// warmed. The readings of a row are held against both: d, each less the mean of
// them all, gives z = sum w (d - mean at the starts), where w weighs a column
// by what it changes within sessions over how its starts differ, scaled so that
// the mean row of training has z = 1. Starts that had no part in w and mean
// give the limit. The second sign is the time of the day.

/// Fills start_readings, start_limit, start_clock and start_clock_late of a
/// history whose other members stand, from the sessions of these rows. Fewer
/// than four sessions tell nothing, nor do starts that differ as much as rows
/// within a session.
void LearnStarts(const data::Dataset& training, History* history);

/// Whether a session whose first known row is `row` of the log begins like none
/// of training: later by its clock, or with thermometers as they stand later.
/// The log's inputs are columns() of the history.
bool BeginsInside(const data::SessionLog& log,
                  Eigen::Index row,
                  const History& history);

}  // namespace errmap::models
