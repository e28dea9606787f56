#pragma once

#include <string>
#include <vector>

#include "cli/report/number_text.h"
#include "models/study/record/study_record.h"

namespace errmap::report {

using models::ComponentRecord;
using models::ModelRecord;
using models::ResultRecord;

/// What all parts of a report take from one component; it refers to the
/// record, which must outlive it.
struct ReportView {
  const ComponentRecord* component = nullptr;
  std::string name;
  std::string shown_unit;  // of the target as people read it: "µm"
  double scale = 1.0;      // shown value = value * scale
  std::vector<std::string> holdouts;
  /// The hold-out that the recommendation follows; "" = none.
  std::string decisive;
  bool decisive_is_unseen = false;  // it holds out whole groups
  std::string neighbours;           // the one beside it, "" = none
  std::string later;  // later sessions foretold from earlier ones, "" = none
  std::string recommended;  // model, "" = none
  /// By the test RMSE under `decisive`, failed ones last.
  std::vector<const ModelRecord*> models;
};

ReportView ViewOf(const ComponentRecord& component);

/// A hold-out by its name, or null.
const models::HoldoutRecord* HoldoutOf(const ReportView& view,
                                       const std::string& holdout);
/// A model by its name, or null.
const ModelRecord* ModelOf(const ReportView& view, const std::string& model);

/// Its place in view.models, of which it is one.
std::size_t PlaceOf(const ReportView& view, const ModelRecord& model);

/// Figures of a model under a hold-out, or null.
const ResultRecord* ResultOf(const ModelRecord& model,
                             const std::string& holdout);
const ResultRecord* ResultOf(const ReportView& view,
                             const std::string& model,
                             const std::string& holdout);
/// Its test RMSE in the target's unit, or NaN.
double TestRmse(const ModelRecord& model, const std::string& holdout);

/// Errors as the report shows them.
ErrorText ErrorTextOf(const ReportView& view);
/// Errors as a terminal shows them.
ErrorText ErrorTextOf(const ComponentRecord& component);

/// A unit's symbol as people write it: "um" -> "µm", "degC" -> "°C".
std::string PrettyUnit(const std::string& symbol);

}  // namespace errmap::report
