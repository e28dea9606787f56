#include "models/inner_folds.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "stats/holdout.h"

namespace errmap::models {

using Eigen::Index;

InnerFolds MakeInnerFolds(const data::Dataset& training,
                          const FitContext& context) {
  constexpr Index kFolds = 5;
  const bool forward = context.inner_holdout == InnerHoldout::kForward;
  const std::set<Index> groups(training.groups().codes.begin(),
                               training.groups().codes.end());
  const bool by_group =
      groups.size() >= 2 && context.inner_holdout != InnerHoldout::kRows;
  const Index count = std::min(
      kFolds,
      by_group ? static_cast<Index>(groups.size()) : training.num_rows());
  InnerFolds inner;
  // Blocks in order need one more to start from.
  inner.text = forward && count > 1 ? fmt::format("forward:{}", count - 1)
               : by_group           ? fmt::format("groups:{}", count)
                                    : fmt::format("kfold:{}", count);
  const auto made = stats::MakeFolds(
      stats::ParseHoldout(inner.text),
      training.num_rows(),
      by_group ? training.groups().codes : std::vector<Index>(),
      context.seed);
  if (by_group) inner.text += " of " + training.groups().column;
  inner.folds.forward = forward;
  inner.folds.codes.assign(static_cast<std::size_t>(training.num_rows()), 0);
  for (std::size_t fold = 0; fold < made.size(); ++fold) {
    for (const Index row : made[fold].test) {
      inner.folds.codes[static_cast<std::size_t>(row)] =
          static_cast<Index>(fold) + inner.folds.first_judged();
    }
  }
  return inner;
}

}  // namespace errmap::models
