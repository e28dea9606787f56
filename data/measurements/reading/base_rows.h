#pragma once

#include "data/measurements/reading/table_in_reading.h"

namespace errmap::data {

/// Chooses the rows that pass the filters, without those of totals and remarks.
/// Throws InputError if such a row must not be left out.
void ChooseBaseRows(TableInReading* in);

/// If rows with dates are equal in all columns, they are one reading saved
/// twice: leaves out the later ones. Returns false if there are none.
bool LeaveOutSavedTwice(TableInReading* in);

}  // namespace errmap::data
