#include "cli/report/words/answers/component_numbers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "data/input_error.h"
#include "data/text.h"

namespace errmap::report {

void RefuseIncompleteRecord() {
  throw data::InputError("results.json lacks figures that its sentences need");
}

const models::VerdictRecord& ComponentNumbers::Verdict(
    const std::string& holdout) const {
  const auto found = std::ranges::find(
      record.verdict, holdout, &models::VerdictRecord::holdout);
  if (found == record.verdict.end()) RefuseIncompleteRecord();
  return *found;
}

const models::GapModelRecord& ComponentNumbers::Gap(
    const std::string& model) const {
  const auto& rows = There(record.gap).models;
  const auto found =
      std::ranges::find(rows, model, &models::GapModelRecord::model);
  if (found == rows.end()) RefuseIncompleteRecord();
  return *found;
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
                        : fmt::format("{:.2g}", ratio);
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
