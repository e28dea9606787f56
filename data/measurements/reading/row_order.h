#pragma once

#include "data/measurements/reading/table_in_reading.h"

namespace errmap::data {

/// What rows are read for.
enum class RowsFor {
  kLearning,   // a map, of which a reading that was saved twice is one
  kAnswering,  // each row, by a map whose axis the selection names
};

/// Finds clock and axis of the base rows. Rows that stand in another order than
/// that of time are put in it, by the clock; where rows were sorted or shuffled
/// and no clock tells their order, they have none.
void PutInOrder(TableInReading* in, RowsFor use);

}  // namespace errmap::data
