#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/report/report_view.h"

namespace errmap::report {

/// What the sentences about one component take from its record, which has to
/// outlive it.
struct ComponentNumbers {
  explicit ComponentNumbers(const models::ComponentRecord& of)
      : record(of), error(ErrorTextOf(of)) {}

  const models::ComponentRecord& record;
  ErrorText error;

  // Each must be there.
  const models::RecommendationRecord& Advice() const {
    return *record.recommendation;
  }
  const models::HoldoutRecord& Holdout(const std::string& name) const {
    return *models::FindNamed(record.holdouts, name);
  }
  const ResultRecord& Result(const std::string& model,
                             const std::string& holdout) const {
    return *ResultOf(*models::FindNamed(record.models, model), holdout);
  }
  double Rmse(const std::string& model, const std::string& holdout) const {
    return Result(model, holdout).test.rmse;
  }
  /// "0.938 um RMSE (95 % 0.786 to 1.093)"
  std::string RmseWithInterval(const std::string& model,
                               const std::string& holdout) const;
};

/// "4.5"; a ratio beyond a thousand has no decimals that mean anything.
std::string RatioText(double ratio);

/// "cycles", "blocks of rows": what the tests count.
std::string PluralOfUnit(const models::HoldoutRecord& holdout);

/// "1 cycle", "20 blocks of rows".
std::string CountOfUnits(std::int64_t count,
                         const models::HoldoutRecord& holdout);

/// The names, with commas, less one.
std::string ListBesides(const std::vector<std::string>& names,
                        const std::string& besides);

}  // namespace errmap::report
