#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/report/report_view.h"
#include "models/study/judgement/confidence.h"

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
  /// What keeps the tests between models from an answer there, if anything
  /// does.
  std::optional<models::Obstacle> ObstacleOfAdvice() const;
  /// How sure it is that the recommended map and another differ.
  std::string Certainty(const std::string& other) const;
  /// Days or cycles of the data that a hold-out of whole ones could hold out;
  /// at least those that it does.
  std::int64_t UnitsOfData(const models::HoldoutRecord& holdout) const;
  /// "6 days"; "4 held-out days" where the data have more of them.
  std::string CountOfHeldOut(std::int64_t count,
                             const models::HoldoutRecord& holdout) const;

  /// "0.938 um RMSE (95 % 0.786 to 1.093)"
  std::string RmseWithInterval(const std::string& model,
                               const std::string& holdout) const;
  /// " (95 % 0.4 to 1.1)", "" where it is not known.
  std::string In95(const models::IntervalRecord& interval) const;
};

/// Of the RMSE of `one`, a model of the pair, minus that of the other; NaN if
/// unknown.
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

/// The names, with commas, without one of them.
std::string ListBesides(const std::vector<std::string>& names,
                        const std::string& besides);

}  // namespace errmap::report
