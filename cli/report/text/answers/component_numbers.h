#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/report/report_view.h"
#include "models/study/judgement/confidence.h"

namespace errmap::report {

[[noreturn]] void RefuseIncompleteRecord();

/// Returns the value of a pointer or optional of a record. Throws
/// data::InputError if it is empty.
template <typename Held>
const auto& Require(const Held& held) {
  if (!held) RefuseIncompleteRecord();
  return *held;
}

/// Returns an item of a list. Throws data::InputError if the list is too short.
template <typename Held>
const Held& Part(const std::vector<Held>& list, std::size_t i) {
  if (i >= list.size()) RefuseIncompleteRecord();
  return list[i];
}
template <typename Held>
const Held& First(const std::vector<Held>& list) {
  return Part(list, 0);
}

/// The parts of one component's record that its sentences use. The record must
/// outlive it.
struct ComponentNumbers {
  explicit ComponentNumbers(const models::ComponentRecord& of)
      : record(of), error(ErrorTextOf(of)) {}

  const models::ComponentRecord& record;
  ErrorText error;

  // Each must be there, as in every record that this version made; else
  // data::InputError.
  const models::RecommendationRecord& Advice() const {
    return Require(record.recommendation);
  }
  const models::HoldoutRecord& Holdout(const std::string& name) const {
    return Require(models::FindNamed(record.holdouts, name));
  }
  const ModelRecord& Model(const std::string& name) const {
    return Require(models::FindNamed(record.models, name));
  }
  const ResultRecord& Result(const std::string& model,
                             const std::string& holdout) const {
    return Require(ResultOf(Model(model), holdout));
  }
  double Rmse(const std::string& model, const std::string& holdout) const {
    return Result(model, holdout).test.rmse;
  }

  // Under the recommendation's hold-out.
  const models::HoldoutRecord& HoldoutOfAdvice() const {
    return Holdout(Advice().holdout);
  }
  std::string RmseWithUnit(const std::string& model) const {
    return error.WithUnit(Rmse(model, Advice().holdout));
  }
  /// Returns why the data allow no test between models; "" if they do.
  std::optional<models::Obstacle> ObstacleOfAdvice() const;
  /// Returns the evidence that the recommended map differs from another one.
  std::string Certainty(const std::string& other) const;
  /// Returns the number of days or cycles in the data that could be held out
  /// whole, at least the number held out.
  std::int64_t UnitsOfData(const models::HoldoutRecord& holdout) const;
  /// "6 days"; "4 held-out days" if the data have more of them.
  std::string CountOfHeldOut(std::int64_t count,
                             const models::HoldoutRecord& holdout) const;

  /// "0.938 um RMSE (95 % 0.786 to 1.093)"
  std::string RmseWithInterval(const std::string& model,
                               const std::string& holdout) const;
  /// " (95 % 0.4 to 1.1)"; "" if it is unknown.
  std::string In95(const models::IntervalRecord& interval) const;
};

/// Interval of the RMSE of `one`, a model of the pair, minus that of the other;
/// NaN if unknown.
models::IntervalRecord IntervalOfExcess(const models::PairRecord& pair,
                                        const std::string& one);

/// "4.5". A ratio above a thousand is shown without decimals.
std::string RatioText(double ratio);

/// "cycles", "blocks of rows".
std::string PluralOf(std::string unit);
/// Name of the units that the tests count.
std::string PluralOfUnit(const models::HoldoutRecord& holdout);

/// "1 cycle", "20 blocks of rows".
std::string CountOfUnits(std::int64_t count,
                         const models::HoldoutRecord& holdout);

/// Joins the names by commas, leaving out one of them.
std::string ListBesides(const std::vector<std::string>& names,
                        const std::string& besides);

}  // namespace errmap::report
