#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"

namespace errmap::data {

/// Name of a column of sessions that is derived from another column's labels.
std::string SessionsNamedIn(std::string_view labels);

/// Returns the sessions named in labels of cycles, which also have a number
/// that starts again in each session: "D1" of "D1C1", "X_20240304" of
/// "X_20240304_01.rtl", "1" of 1.1 or 101. Each session has two cycles or more.
/// It is "" outside `rows`, which are in the order of measurement. Returns
/// nothing if the labels give fewer than `least` sessions.
std::optional<CsvColumn> FindSessionsInLabels(
    const CsvTable& table,
    const CsvColumn& labels,
    const std::vector<Eigen::Index>& rows,
    std::size_t least = 2);

}  // namespace errmap::data
