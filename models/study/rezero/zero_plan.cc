#include "models/study/rezero/zero_plan.h"

#include <algorithm>
#include <map>
#include <utility>

#include "models/zero_walk.h"
#include "stats/random.h"

namespace errmap::models {
namespace {

class ZeroPlanner {
 public:
  ZeroPlanner(const HeldOutRows& held,
              const RezeroRule& rule,
              std::uint64_t seed)
      : held_(held), source_(*held.source), rule_(rule), random_(seed) {}

  ZeroPlan Plan() {
    plan_.zero_of.assign(held_.rows.size(), -1);
    plan_.noise.setZero(std::ssize(held_.rows));
    const std::vector<Index> sessions = source_.session_codes();
    std::map<std::pair<std::size_t, Index>, std::vector<Index>> runs;
    for (std::size_t i = 0; i < held_.rows.size(); ++i) {
      const auto row = static_cast<std::size_t>(held_.rows[i]);
      runs[{held_.fold_of[i], sessions[row]}].push_back(static_cast<Index>(i));
    }
    for (auto& [fold_and_session, places] : runs) {
      std::ranges::stable_sort(
          places, {}, [&](Index place) { return TimeOf(place); });
      PlanRun(places);
    }
    for (std::size_t i = 0; i < plan_.zero_of.size(); ++i) {
      if (plan_.zero_of[i] >= 0) plan_.scored.push_back(static_cast<Index>(i));
    }
    return std::move(plan_);
  }

 private:
  std::size_t RowOf(Index place) const {
    return static_cast<std::size_t>(
        held_.rows[static_cast<std::size_t>(place)]);
  }
  double TimeOf(Index place) const {
    return source_.log()->time[source_.log_rows()[RowOf(place)]];
  }
  double Age(Index zero, Index place) const {
    return TimeOf(place) - TimeOf(zero);
  }

  bool IsDue(Index zero, Index place) const {
    switch (rule_.kind) {
      case RezeroKind::kEvery:
        return Age(zero, place) >= rule_.interval * (1.0 - kTimeRounding);
      case RezeroKind::kSession:
        return false;
      case RezeroKind::kProbe:
        return !source_.has_groups() ||
               source_.groups().codes[RowOf(zero)] !=
                   source_.groups().codes[RowOf(place)];
    }
    return false;
  }

  void PlanRun(const std::vector<Index>& places) {
    const auto place_of = [&](Index row) {
      return places[static_cast<std::size_t>(row)];
    };
    // The interval is infinite where none was given.
    const double longest = rule_.interval * (1.0 + kTimeRounding);
    const std::vector<Index> zeros = ForZeros(
        std::ssize(places),
        [&](Index row, Index zero) {
          return IsDue(place_of(zero), place_of(row));
        },
        [&](Index row, Index zero) {
          if (Age(place_of(zero), place_of(row)) > longest) return;
          plan_.zero_of[static_cast<std::size_t>(place_of(row))] =
              place_of(zero);
        });
    for (const Index zero : zeros) {
      plan_.noise[place_of(zero)] = rule_.noise * random_.Normal();
    }
    plan_.probes += std::ssize(zeros);
  }

  const HeldOutRows& held_;
  const data::Dataset& source_;
  const RezeroRule& rule_;
  stats::Random random_;
  ZeroPlan plan_;
};

}  // namespace

ZeroPlan PlanZeros(const HeldOutRows& held,
                   const RezeroRule& rule,
                   std::uint64_t seed) {
  RequireTimes(rule, *held.source);
  return ZeroPlanner(held, rule, seed).Plan();
}

VectorXd Rezeroed(const ZeroPlan& plan, const VectorXd& errors) {
  VectorXd left(std::ssize(plan.scored));
  for (Index i = 0; i < left.size(); ++i) {
    const Index place = plan.scored[static_cast<std::size_t>(i)];
    const Index zero = plan.zero_of[static_cast<std::size_t>(place)];
    left[i] = errors[place] - errors[zero] - plan.noise[zero];
  }
  return left;
}

}  // namespace errmap::models
