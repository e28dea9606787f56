#include "models/study/judgement/telling_holdout.h"

#include <utility>

namespace errmap::models {

namespace {

// Ranks how much a hold-out tells of another day, from 0: whole sessions,
// whole groups, another file, whole blocks, few sessions, rows, a file that
// holds training rows. Within a kind, one that judges all sessions comes
// before one that judges only later ones. Sessions count as such from `fewest`
// on.
std::pair<int, bool> RankOf(const Holdout& holdout,
                            const HoldoutComparison& comparison,
                            Index fewest) {
  const auto kind = [&] {
    if (holdout.rows_of_training > 0) return 6;
    if (comparison.units.are_sessions &&
        std::ssize(comparison.units.labels) >= fewest) {
      return 0;
    }
    if (holdout.whole_groups && holdout.test_data == nullptr) return 1;
    if (holdout.test_data != nullptr) return 2;
    if (holdout.inner == InnerHoldout::kBlocks) return 3;
    if (holdout.whole_sessions) return 4;
    return 5;
  };
  return {kind(), holdout.forward};
}

// The first of the hold-outs that tell most.
std::optional<std::size_t> HoldoutThatTellsMost(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons,
    Index fewest_sessions) {
  std::optional<std::size_t> most;
  for (std::size_t h = 0; h < holdouts.size(); ++h) {
    if (comparisons[h].models.empty()) continue;
    if (!most ||
        RankOf(holdouts[h], comparisons[h], fewest_sessions) <
            RankOf(holdouts[*most], comparisons[*most], fewest_sessions)) {
      most = h;
    }
  }
  return most;
}

}  // namespace

std::optional<std::size_t> StrictestHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons) {
  constexpr Index kFewestSessions = 2;
  return HoldoutThatTellsMost(holdouts, comparisons, kFewestSessions);
}

std::optional<std::size_t> DecisiveHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons) {
  return HoldoutThatTellsMost(holdouts, comparisons, kFewestSessionsToDecide);
}

const HoldoutComparison* ForwardOverSessions(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons) {
  for (std::size_t h = 0; h < holdouts.size(); ++h) {
    if (holdouts[h].forward && comparisons[h].units.are_sessions &&
        !comparisons[h].models.empty()) {
      return &comparisons[h];
    }
  }
  return nullptr;
}

}  // namespace errmap::models
