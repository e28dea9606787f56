#pragma once

#include <vector>

#include "stats/eigen.h"

namespace errmap::stats {

/// Returns the indices 0 .. count-1.
std::vector<Index> AllIndices(Index count);

/// Returns `most` of the indices 0 .. count-1, ascending, or all if there are
/// no more. One is drawn from each of `most` equal stretches, the same at every
/// call. The first and the last index are always included. Even steps could
/// coincide with patterns in the rows: if positions repeat every 20 rows, every
/// 20th row has the same position, and a hold-out of every fifth row never
/// tests it.
std::vector<Index> SpreadSample(Index count, Index most);

/// Returns the elements of `all` at these indices.
std::vector<Index> SpreadSample(const std::vector<Index>& all, Index most);

/// Renumbers the codes from 0 in their order, without gaps. Returns their
/// number.
Index Renumber(std::vector<Index>* codes);

/// Returns the indices of each code from 0 to the largest, ascending.
std::vector<std::vector<Index>> IndicesByCode(const std::vector<Index>& codes);

}  // namespace errmap::stats
