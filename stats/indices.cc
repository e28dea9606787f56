#include "stats/indices.h"

#include <algorithm>
#include <numeric>

#include "stats/random.h"

namespace errmap::stats {

std::vector<Index> AllIndices(Index count) {
  std::vector<Index> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

std::vector<Index> SpreadSample(Index count, Index most) {
  const Index kept = std::min(count, most);
  std::vector<Index> places;
  Random random(1);
  for (Index i = 0; i < kept; ++i) {
    const Index begin = i * count / kept;
    const auto size =
        static_cast<std::uint64_t>((i + 1) * count / kept - begin);
    places.push_back(begin + static_cast<Index>(random.Below(size)));
  }
  if (kept > 1) places.back() = count - 1;
  if (kept > 0) places.front() = 0;
  return places;
}

std::vector<Index> SpreadSample(const std::vector<Index>& all, Index most) {
  std::vector<Index> chosen;
  for (const Index i : SpreadSample(std::ssize(all), most)) {
    chosen.push_back(all[static_cast<std::size_t>(i)]);
  }
  return chosen;
}

Index Renumber(std::vector<Index>* codes) {
  std::vector<Index> present = *codes;
  std::sort(present.begin(), present.end());
  present.erase(std::unique(present.begin(), present.end()), present.end());
  for (Index& code : *codes) {
    code = std::lower_bound(present.begin(), present.end(), code) -
           present.begin();
  }
  return std::ssize(present);
}

std::vector<std::vector<Index>> IndicesByCode(const std::vector<Index>& codes) {
  std::vector<std::vector<Index>> indices;
  Index i = 0;
  for (const Index code : codes) {
    const auto at = static_cast<std::size_t>(code);
    if (at >= indices.size()) indices.resize(at + 1);
    indices[at].push_back(i++);
  }
  return indices;
}

}  // namespace errmap::stats
