#pragma once

#include "data/measurements/reading/table_in_reading.h"

namespace errmap::data {

/// The purpose for which rows are read.
enum class RowsFor {
  kLearning,   // a map, of which a reading that was saved twice is one
  kAnswering,  // each row, by a map whose axis the selection names
};

/// Finds clock and axis of the base rows. If the clock shows that rows are not
/// in order of time, they are sorted by it. Rows that were rearranged and have
/// no clock get no order.
void PutInOrder(TableInReading* in, RowsFor use);

}  // namespace errmap::data
