#include "models/study/study_defaults.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace errmap::models {

std::vector<std::string> DefaultHoldouts(const data::Dataset& dataset) {
  constexpr Index kFolds = 5;
  std::vector<std::string> specs{"every:3"};
  const auto groups = std::ssize(dataset.groups().labels);
  const Index sessions = dataset.num_sessions();
  if (groups >= 2) {
    std::string spec = fmt::format("groups:{}", std::min(groups, kFolds));
    constexpr std::uint64_t kAnySeed = 1;  // nothing is shuffled
    if (!IsOfSessions(MakeHoldout(stats::ParseHoldout(spec), dataset, kAnySeed),
                      dataset)) {
      specs.push_back(std::move(spec));
    }
  }
  if (sessions >= 2) {
    specs.push_back(fmt::format("sessions:{}", std::min(sessions, kFolds)));
  }
  if (groups < 2 && sessions < kFewestSessionsToDecide) {
    specs.push_back(
        fmt::format("blocks:{}", std::min(dataset.num_rows(), kFolds)));
  }
  if (sessions >= kFewestSessionsToDecide) {
    constexpr Index kForwardFolds = 3;
    specs.push_back(fmt::format("forward:{}", kForwardFolds));
  }
  return specs;
}

std::vector<std::string> HoldoutsBeside(const std::vector<Holdout>& holdouts,
                                        const data::Dataset& dataset) {
  const bool all_learnt = std::ranges::all_of(
      holdouts,
      [](const Holdout& holdout) { return holdout.rows_of_training > 0; });
  return all_learnt ? DefaultHoldouts(dataset) : std::vector<std::string>();
}

std::string StrictestDefaultHoldout(const data::Dataset& dataset) {
  const std::vector<std::string> specs = DefaultHoldouts(dataset);
  // The last of them asks most, but for looking forward.
  for (const std::string_view kind : {"sessions:", "groups:"}) {
    const auto found = std::ranges::find_if(
        specs, [&](const std::string& spec) { return spec.starts_with(kind); });
    if (found != specs.end()) return *found;
  }
  return specs.back();
}

double DefaultIndifference(const data::Unit& unit) {
  constexpr double kIndifferenceUm = 0.02;
  return unit.quantity == data::Quantity::kLength
             ? kIndifferenceUm / unit.display_scale
             : 0.0;
}

}  // namespace errmap::models
