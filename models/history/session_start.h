#pragma once

#include <vector>

#include "data/measurements/dataset.h"
#include "models/history/history.h"
#include "stats/eigen.h"

namespace errmap::models {

// A log that begins inside a session looks like one that begins with it, but
// the filters of a map then start wrong. At the start of a session,
// thermometers differ as the machine at rest leaves them; later some have
// warmed. The readings of a row, each less the mean of all, d, are compared
// with both: z = sum w (d - mean at the starts). The weights w are those of
// Fisher (1936), the change within sessions over the covariance of their
// starts, scaled so that the mean row of training has z = 1. Starts left out of
// w and mean give the limit. The second indicator is the time of day.

/// Returns the log rows of each session that occurs in these rows, which have a
/// log.
std::vector<std::vector<Index>> RowsOfSessions(const data::Dataset& training);

/// Fills start_readings, start_limit, start_clock and start_clock_late of a
/// history whose other members are set, from the sessions of these rows. Leaves
/// them unset for fewer than four sessions, or if starts vary as much as rows
/// within a session.
void LearnStarts(const data::Dataset& training, History* history);

/// Returns true if a session whose first known row is `row` of the log begins
/// unlike all training sessions: later by its clock, or with temperatures
/// typical of later rows. The log's inputs are columns() of the history.
bool BeginsInside(const data::SessionLog& log,
                  Index row,
                  const History& history);

}  // namespace errmap::models
