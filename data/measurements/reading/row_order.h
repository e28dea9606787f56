#pragma once

#include "data/measurements/reading/table_in_reading.h"

namespace errmap::data {

/// The purpose for which rows are read.
enum class RowsFor {
  kLearning,   // a map, of which a reading that was saved twice is one
  kAnswering,  // each row, by a map whose axis the selection names
};

/// Finds clock and axis of the base rows. Rows that are not in order of time
/// are sorted by the clock. If rows were sorted or shuffled and no clock tells
/// their order, they have none.
void PutInOrder(TableInReading* in, RowsFor use);

}  // namespace errmap::data
