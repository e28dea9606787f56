#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/report/report_view.h"

namespace errmap::report {

[[noreturn]] void RefuseIncompleteRecord();

/// What a sentence needs of a record, a pointer or an optional; throws
/// data::InputError where it is not there.
template <typename Held>
const auto& There(const Held& held) {
  if (!held) RefuseIncompleteRecord();
  return *held;
}

/// Of a list; throws alike where it is shorter.
template <typename Held>
const Held& Part(const std::vector<Held>& list, std::size_t i) {
  if (i >= list.size()) RefuseIncompleteRecord();
  return list[i];
}
template <typename Held>
const Held& First(const std::vector<Held>& list) {
  return Part(list, 0);
}

/// What the sentences about one component take from its record, which has to
/// outlive it.
struct ComponentNumbers {
  explicit ComponentNumbers(const models::ComponentRecord& of)
      : record(of), error(ErrorTextOf(of)) {}

  const models::ComponentRecord& record;
  ErrorText error;

  // Each must be there, as in every record that this version made; else
  // data::InputError.
  const models::RecommendationRecord& Advice() const {
    return There(record.recommendation);
  }
  const models::HoldoutRecord& Holdout(const std::string& name) const {
    return There(models::FindNamed(record.holdouts, name));
  }
  const ModelRecord& Model(const std::string& name) const {
    return There(models::FindNamed(record.models, name));
  }
  const ResultRecord& Result(const std::string& model,
                             const std::string& holdout) const {
    return There(ResultOf(Model(model), holdout));
  }
  const models::VerdictRecord& Verdict(const std::string& holdout) const;
  /// Of a model between neighbours and on units never seen.
  const models::GapModelRecord& Gap(const std::string& model) const;
  double Rmse(const std::string& model, const std::string& holdout) const {
    return Result(model, holdout).test.rmse;
  }
  /// Whether whole groups are held out, all of one run: the headline says so.
  bool IsOfOneRun(const models::HoldoutRecord& holdout) const {
    return holdout.whole_groups && !holdout.whole_sessions &&
           record.data.sessions == 1;
  }
  /// "0.938 um RMSE (95 % 0.786 to 1.093)"
  std::string RmseWithInterval(const std::string& model,
                               const std::string& holdout) const;
  /// " (95 % 0.4 to 1.1)", "" where it is not known.
  std::string In95(const models::IntervalRecord& interval) const;
};

/// Of the RMSE of `one`, a model of the pair, less that of the other; NaN where
/// it is not known.
models::IntervalRecord IntervalOfExcess(const models::PairRecord& pair,
                                        const std::string& one);

/// "4.5"; a ratio beyond a thousand has no decimals that mean anything.
std::string RatioText(double ratio);

/// "cycles", "blocks of rows".
std::string PluralOf(std::string unit);
/// Of what the tests count.
std::string PluralOfUnit(const models::HoldoutRecord& holdout);

/// "1 cycle", "20 blocks of rows".
std::string CountOfUnits(std::int64_t count,
                         const models::HoldoutRecord& holdout);

/// The names, with commas, less one.
std::string ListBesides(const std::vector<std::string>& names,
                        const std::string& besides);

}  // namespace errmap::report
