#pragma once

#include <limits>
#include <string>
#include <vector>

#include "cli/report/json_access.h"
#include "cli/report/plot.h"
#include "cli/shell/number_text.h"
#include "models/study/goal.h"

namespace errmap::cli {

/// What reads as nothing.
constexpr double kNotThere = std::numeric_limits<double>::quiet_NaN();

/// A model as the report orders them.
struct ViewedModel {
  std::string name;
  std::string kind;
  bool ok = false;
  const Json* json = nullptr;
};

/// What all parts of a report take from one component of results.json; it
/// refers to the document, which must outlive it.
struct ReportView {
  const Json* component = nullptr;
  std::string name;
  std::string unit;         // of the target in the file, "" = none
  std::string shown_unit;   // of the target as people read it: "µm"
  double scale = 1.0;       // shown value = value * scale
  double goal = kNotThere;  // target's unit
  std::vector<std::string> holdouts;
  /// The hold-out that the recommendation follows: whole groups where there
  /// are some; "" = none.
  std::string decisive;
  bool decisive_is_unseen = false;  // it holds out whole groups
  std::string neighbours;           // the one beside it, "" = none
  std::string recommended;          // model, "" = none
  std::string rival;  // best other kind under `decisive`, else next best
  /// By the test RMSE under `decisive`, failed ones last.
  std::vector<ViewedModel> models;
};

ReportView ViewOf(const Json& component);

/// Test figures of a model under a hold-out, or null.
const Json& ResultOf(const ReportView& view,
                     const std::string& model,
                     const std::string& holdout);
/// Its test RMSE in the target's unit, or NaN.
double TestRmse(const ReportView& view,
                const std::string& model,
                const std::string& holdout);

/// How `model` stands to the goal under the decisive hold-out.
models::GoalJudgement GoalOf(const ReportView& view, const std::string& model);

/// Errors as the report shows them.
ErrorText ErrorTextOf(const ReportView& view);

/// Values scaled to the shown unit.
std::vector<double> Shown(const ReportView& view, std::vector<double> values);

/// A unit's symbol as people write it: "um" -> "µm", "degC" -> "°C".
std::string PrettyUnit(const std::string& symbol);

}  // namespace errmap::cli
