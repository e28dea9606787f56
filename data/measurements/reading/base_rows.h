#pragma once

#include "data/measurements/reading/table_in_reading.h"

namespace errmap::data {

/// Finds the rows that the filters by columns leave, without those of totals
/// and remarks. Throws InputError where such a row is not to be left out.
void ChooseBaseRows(TableInReading* in);

/// With dates, rows that are alike in all else are one reading that was saved
/// twice: leaves the later ones out. False where there are none.
bool LeaveOutSavedTwice(TableInReading* in);

}  // namespace errmap::data
