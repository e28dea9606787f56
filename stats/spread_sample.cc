#include "stats/spread_sample.h"

#include <algorithm>

#include "stats/random.h"

namespace errmap::stats {

using Eigen::Index;

std::vector<Index> SpreadSample(Index count, Index most) {
  const Index kept = std::min(count, most);
  std::vector<Index> places;
  places.reserve(static_cast<std::size_t>(std::max(kept, Index{0})));
  Random random(1);
  for (Index i = 0; i < kept; ++i) {
    const Index begin = i * count / kept;
    const Index size = (i + 1) * count / kept - begin;
    const auto drawn =
        static_cast<Index>(random.Below(static_cast<std::uint64_t>(size)));
    if (i == 0) {
      places.push_back(0);
    } else {
      places.push_back(i == kept - 1 ? count - 1 : begin + drawn);
    }
  }
  return places;
}

}  // namespace errmap::stats
