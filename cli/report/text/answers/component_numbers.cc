#include "cli/report/text/answers/component_numbers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "data/input_error.h"
#include "data/text.h"

namespace errmap::report {

void RefuseIncompleteRecord() {
  throw data::InputError("results.json lacks figures that its sentences need");
}

std::optional<models::Obstacle> ComponentNumbers::ObstacleOfAdvice() const {
  const auto found = std::ranges::find(
      record.verdict, Advice().holdout, &models::VerdictRecord::holdout);
  return found == record.verdict.end() ? std::nullopt : found->obstacle;
}

std::string ComponentNumbers::Certainty(const std::string& other) const {
  using Kind = models::Obstacle::Kind;
  const models::PairRecord* const pair =
      models::FindPair(record, Advice().holdout, Advice().model, other);
  const auto obstacle = ObstacleOfAdvice();
  // An interval of so few units establishes nothing, so it calls nothing likely
  // either.
  const bool too_few = obstacle && (obstacle->kind == Kind::kTooFewUnits ||
                                    obstacle->kind == Kind::kPerhapsOneSession);
  if (too_few || pair == nullptr || !std::isfinite(pair->ci95[0])) {
    const models::HoldoutRecord& holdout = HoldoutOfAdvice();
    return CountOfHeldOut(holdout.units, holdout) + " are too few to tell";
  }
  if (pair->established) return "the gap is proven";
  const auto [low, high] = pair->ci95;
  return low > 0.0 || high < 0.0 ? "the gap is likely real"
                                 : "the gap may be chance";
}

std::int64_t ComponentNumbers::UnitsOfData(
    const models::HoldoutRecord& holdout) const {
  const std::int64_t all = holdout.another_file     ? 0
                           : holdout.whole_sessions ? record.data.sessions
                           : holdout.whole_groups   ? record.data.groups
                                                    : 0;
  return std::max(all, holdout.units);
}

std::string ComponentNumbers::CountOfHeldOut(
    std::int64_t count, const models::HoldoutRecord& holdout) const {
  if (UnitsOfData(holdout) == holdout.units) {
    return CountOfUnits(count, holdout);
  }
  return fmt::format(
      "{} held-out {}",
      count,
      count == 1 ? holdout.unit_of_analysis : PluralOfUnit(holdout));
}

std::string ComponentNumbers::RmseWithInterval(
    const std::string& model, const std::string& holdout) const {
  const ResultRecord& result = Result(model, holdout);
  return error.WithUnit(result.test.rmse) + " RMSE" + In95(result.ci95);
}

std::string ComponentNumbers::In95(
    const models::IntervalRecord& interval) const {
  return std::isfinite(interval[0])
             ? fmt::format(
                   " (95 % {} to {})", error(interval[0]), error(interval[1]))
             : "";
}

models::IntervalRecord IntervalOfExcess(const models::PairRecord& pair,
                                        const std::string& one) {
  const auto& [low, high] = pair.ci95;
  return pair.a == one ? pair.ci95 : models::IntervalRecord{-high, -low};
}

std::string RatioText(double ratio) {
  constexpr double kLarge = 1000.0;
  return ratio < kLarge ? fmt::format("{:.1f}", ratio)
                        : fmt::format("{:.0f}", ratio);
}

std::string PluralOf(std::string unit) {
  const std::size_t end = std::min(unit.find(' '), unit.size());
  const bool is_plural = end > 0 && unit[end - 1] == 's';  // "Zyklus", "series"
  return is_plural ? unit : unit.insert(end, "s");
}

std::string PluralOfUnit(const models::HoldoutRecord& holdout) {
  return PluralOf(holdout.unit_of_analysis);
}

std::string CountOfUnits(std::int64_t count,
                         const models::HoldoutRecord& holdout) {
  return count == 1 ? "1 " + holdout.unit_of_analysis
                    : fmt::format("{} {}", count, PluralOfUnit(holdout));
}

std::string ListBesides(const std::vector<std::string>& names,
                        const std::string& besides) {
  std::vector<std::string> others = names;
  std::erase(others, besides);
  return data::JoinWords(others, ", ");
}

}  // namespace errmap::report
