#include "data/measurements/column_faults.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>

#include "data/argument_name.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/dataset.h"
#include "data/measurements/faults/row_faults.h"
#include "data/measurements/faults/thermometers.h"
#include "data/text.h"

namespace errmap::data {

using Eigen::Index;

std::string_view ToString(FaultKind kind) {
  constexpr auto kNames = std::to_array<std::string_view>({"impossible",
                                                           "outlying",
                                                           "jump",
                                                           "step",
                                                           "stuck",
                                                           "noisy",
                                                           "drifting",
                                                           "repeated",
                                                           "zero",
                                                           "other-unit"});
  return NameOf(kNames, kind);
}

std::vector<ColumnFault> FindColumnFaults(const MeasuredColumns& measured) {
  if (measured.target_values.size() < kFewestRows) return {};
  auto [faults, thermometers] = FindCellFaults(measured);
  const auto append = [&faults = faults](std::vector<ColumnFault> more) {
    std::ranges::move(more, std::back_inserter(faults));
  };
  append(FindThermometerFaults(measured, thermometers));
  append(FindDrift(measured, thermometers, faults));
  const auto is_of_target = [](const ColumnFault& fault) {
    return fault.input < 0;
  };
  std::vector<ColumnFault> of_target;
  std::ranges::copy_if(faults, std::back_inserter(of_target), is_of_target);
  append(FindTargetFaults(measured, RowsOfCellFaults(of_target)));
  if (std::ranges::none_of(faults, is_of_target)) {
    append(FindSlippedPoints(measured));
  }
  std::ranges::stable_sort(faults, {}, &ColumnFault::input);
  for (ColumnFault& fault : faults) {
    for (Index& row : fault.rows) {
      row = measured.rows[row];
    }
  }
  return faults;
}

std::string DoubtOfRows(const ColumnFault& fault,
                        const MeasuredColumns& measured) {
  if (std::ssize(fault.rows) == measured.target_values.size()) {
    return "";  // its unit is another one: no figure changes
  }
  std::string what;
  if (fault.kind == FaultKind::kRepeated) {
    what = " rows repeat others value for value";
  } else if (fault.kind == FaultKind::kOtherUnit) {
    what = " rows have a target some " + Rounded(fault.value) +
           " times smaller than the others, as if in another unit";
  } else if (fault.kind == FaultKind::kZero) {
    what = " rows have a target of 0 where the others say otherwise";
  } else if (fault.kind == FaultKind::kImpossible ||
             (fault.kind == FaultKind::kOutlying && fault.input < 0)) {
    const ColumnInfo& column =
        fault.input < 0 ? measured.target : measured.inputs[fault.input];
    what = " rows have " + NameInRemark(column.name) + " " +
           Rounded(fault.value) + ", which is not a reading";
  } else {
    return "";
  }
  const bool of_column = fault.input >= 0 && !fault.of_cells;
  return std::to_string(fault.rows.size()) + what + "; " +
         (of_column
              ? ArgumentName(
                    "exclude",
                    measured.inputs[static_cast<std::size_t>(fault.input)]
                        .name) +
                    " leaves the column out."
              : ArgumentName("faults", "drop-rows") + " leaves them out.");
}

std::vector<Index> RowsOfCellFaults(const std::vector<ColumnFault>& faults) {
  std::vector<Index> rows;
  for (const ColumnFault& fault : faults) {
    if (fault.of_cells) {
      rows.insert(rows.end(), fault.rows.begin(), fault.rows.end());
    }
  }
  std::ranges::sort(rows);
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

}  // namespace errmap::data
