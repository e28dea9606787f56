#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"

namespace errmap::data {

/// What a column of sessions is called that another column's labels tell.
std::string SessionsNamedIn(std::string_view labels);

/// The sessions that labels of cycles name beside their number, which begins
/// anew with each: "D1" of "D1C1", "X_20240304" of "X_20240304_01.rtl", "1" of
/// 1.1 or 101; each of two cycles or more. "" in rows other than these `rows`,
/// which are in the order of measurement. Nothing where labels tell fewer than
/// `least` sessions.
std::optional<CsvColumn> FindSessionsInLabels(
    const CsvTable& table,
    const CsvColumn& labels,
    const std::vector<Eigen::Index>& rows,
    std::size_t least = 2);

}  // namespace errmap::data
