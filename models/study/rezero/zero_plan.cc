#include "models/study/rezero/zero_plan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "stats/random.h"

namespace errmap::models {
namespace {

using Eigen::Index;

// Times are sums of steps: what is due to the last digit is due.
constexpr double kRounding = 1e-9;

// Box and Muller 1958.
double DrawNormal(stats::Random* random) {
  const double radius = std::sqrt(-2.0 * std::log1p(-random->Uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * random->Uniform());
}

class ZeroPlanner {
 public:
  ZeroPlanner(const HeldOutRows& held,
              const RezeroRule& rule,
              std::uint64_t seed)
      : held_(held), source_(*held.source), rule_(rule), random_(seed) {}

  ZeroPlan Plan() {
    plan_.zero_of.assign(held_.rows.size(), -1);
    plan_.noise.setZero(static_cast<Index>(held_.rows.size()));
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
        return Age(zero, place) >= rule_.interval * (1.0 - kRounding);
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
    Index zero = -1;
    for (const Index place : places) {
      // The interval is infinite where none was given.
      if (zero >= 0 && Age(zero, place) <= rule_.interval * (1.0 + kRounding)) {
        plan_.zero_of[static_cast<std::size_t>(place)] = zero;
      }
      if (zero >= 0 && !IsDue(zero, place)) continue;
      zero = place;
      plan_.noise[place] = rule_.noise * DrawNormal(&random_);
      ++plan_.probes;
    }
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

Eigen::VectorXd Rezeroed(const ZeroPlan& plan, const Eigen::VectorXd& errors) {
  Eigen::VectorXd left(static_cast<Index>(plan.scored.size()));
  for (Index i = 0; i < left.size(); ++i) {
    const Index place = plan.scored[static_cast<std::size_t>(i)];
    const Index zero = plan.zero_of[static_cast<std::size_t>(place)];
    left[i] = errors[place] - errors[zero] - plan.noise[zero];
  }
  return left;
}

}  // namespace errmap::models
