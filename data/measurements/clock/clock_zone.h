#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// True if these letters ("CEST", "BST") name the summer time of a zone.
bool IsSummerTime(std::string_view letters);

/// Returns how many seconds the times in these columns are ahead of UTC. Takes
/// the zone from the first cell ("Z", "CET", or "+02:00", which ParseDateTime
/// already applies), else from a name ("Time (CEST)", "GMT+02:00"). Returns
/// nothing if there is no zone, or an unknown one.
std::optional<double> SecondsAheadOfUtc(
    const CsvTable& table, const std::vector<std::ptrdiff_t>& columns);

}  // namespace errmap::data
