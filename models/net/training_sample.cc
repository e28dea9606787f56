#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "models/net/net_fit.h"
#include "stats/indices.h"
#include "stats/random.h"

namespace errmap::models {
namespace {

constexpr std::uint64_t kSeed = 1;

// One of 0..count-1 out of each of `draws` stretches of equal length.
std::vector<Index> OneOfEachStretch(Index count, Index draws) {
  stats::Random random(kSeed);
  std::vector<Index> drawn;
  for (Index k = 0; k < draws; ++k) {
    const Index begin = k * count / draws;
    const Index end = (k + 1) * count / draws;
    drawn.push_back(begin + static_cast<Index>(random.Below(
                                static_cast<std::uint64_t>(end - begin))));
  }
  return drawn;
}

// The rows of each group that has any, by the first of them.
std::vector<std::vector<Index>> RowsByGroup(const data::Grouping& groups) {
  constexpr std::size_t kNotSeen = static_cast<std::size_t>(-1);
  std::vector<std::size_t> place(groups.labels.size(), kNotSeen);
  std::vector<std::vector<Index>> rows;
  for (std::size_t row = 0; row < groups.codes.size(); ++row) {
    std::size_t& at = place[static_cast<std::size_t>(groups.codes[row])];
    if (at == kNotSeen) {
      at = rows.size();
      rows.emplace_back();
    }
    rows[at].push_back(static_cast<Index>(row));
  }
  return rows;
}

}  // namespace

std::vector<Index> StratifiedRows(Index count, Index most) {
  if (most < 1) throw std::invalid_argument("StratifiedRows: no row is wanted");
  if (count > most) return OneOfEachStretch(count, most);
  return stats::AllIndices(count);
}

std::vector<Index> StratifiedRows(const data::Dataset& training, Index most) {
  // Fewer groups than this would stand for few thermal states.
  constexpr Index kFewestGroups = 100;
  const Index count = training.num_rows();
  if (most > 0 && count > most && training.has_groups()) {
    std::vector<Index> rows;
    const auto groups = RowsByGroup(training.groups());
    const auto num_groups = std::ssize(groups);
    for (Index draws = num_groups * most / count; draws >= kFewestGroups;
         --draws) {
      rows.clear();
      for (const Index group : OneOfEachStretch(num_groups, draws)) {
        const auto& all = groups[static_cast<std::size_t>(group)];
        rows.insert(rows.end(), all.begin(), all.end());
      }
      if (std::ssize(rows) > most) continue;
      std::ranges::sort(rows);
      return rows;
    }
  }
  return StratifiedRows(count, most);
}

}  // namespace errmap::models
