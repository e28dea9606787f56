#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "data/measurements/reading/table_in_reading.h"

namespace errmap::data {

/// Clears the flags of rows that pass but hold totals or remarks, and returns
/// these rows. `group` is the column of cycles. Throws InputError if such a row
/// must not be left out.
std::vector<Eigen::Index> LeaveOutTotals(const CsvTable& table,
                                         std::ptrdiff_t group,
                                         MissingPolicy missing,
                                         std::vector<bool>* passes);

/// Chooses the rows that pass the filters, without totals and remarks. Throws
/// InputError if such a row must not be left out.
void ChooseBaseRows(TableInReading* in);

/// If rows with dates are equal in all columns, they are one reading saved
/// twice: leaves out the later ones. Returns false if there are none.
bool LeaveOutSavedTwice(TableInReading* in);

}  // namespace errmap::data
