#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// Whether letters ("CEST", "BST") name the summer time of a zone.
bool IsSummerTime(std::string_view letters);

/// By how many seconds the times read from these columns are ahead of UTC: by
/// the zone behind the first cell ("Z", "+02:00", of which ParseDateTime takes
/// account, "CET"), else by the one in a name ("Time (CEST)", "GMT+02:00").
/// Nothing where no zone is written down, or one that is not known.
std::optional<double> SecondsAheadOfUtc(
    const CsvTable& table, const std::vector<std::ptrdiff_t>& columns);

}  // namespace errmap::data
